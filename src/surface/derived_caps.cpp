#include "surface/derived_caps.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace geovor {
namespace {

// The square around a disk reaches so far beyond it.
constexpr double kCorner = std::numbers::sqrt2;

Frame mirrored(const Frame& f) { return {f.origin, f.x, -f.y, -f.z}; }

// The side in the parameters of `surface` that is `side` in those of its base.
PoleSide side_of(const Reparameterized& surface, const PoleSide& side) {
  const UvBox box = surface.base().domain();
  const double along =
      std::isfinite((side.along_u ? box.u : box.v).length()) ? (side.along_u ? box.u : box.v).middle() : 0.0;
  const Uv at = surface.from_base(side.point(along, 0.0));
  const bool along_u = side.along_u != surface.swapped();
  const bool turned = (along_u ? surface.v_turned() : surface.u_turned());
  return {along_u, along_u ? at.v : at.u, side.low != turned};
}

class ReparameterizedCap final : public PoleChart {
 public:
  ReparameterizedCap(const Reparameterized& surface, std::shared_ptr<const PoleChart> base, bool mirror)
      : PoleChart(mirror ? mirrored(base->frame()) : base->frame(), side_of(surface, base->side()), base->radius(),
                  std::numeric_limits<double>::infinity()),
        surface_(surface),
        base_(std::move(base)),
        mirror_(mirror) {}

  Uv to_base(Uv ab) const override { return surface_.from_base(base_->to_base(turned(ab))); }
  Uv from_base(Uv p) const override { return turned(base_->from_base(surface_.to_base(p))); }
  bool holds(Uv p) const override { return base_->holds(surface_.to_base(p)); }
  Xyz side_direction(Uv p) const override {
    const bool back = side().along_u ? surface_.u_turned() : surface_.v_turned();
    return (back ? -1.0 : 1.0) * base_->side_direction(surface_.to_base(p));
  }

  HeightJet height(Uv ab) const override {
    const HeightJet h = base_->height(turned(ab));
    return mirror_ ? HeightJet{-h.f, -h.fu, h.fv, -h.fuu, h.fuv, -h.fvv} : h;
  }

 private:
  Uv turned(Uv ab) const { return mirror_ ? Uv{ab.u, -ab.v} : ab; }

  Reparameterized surface_;
  std::shared_ptr<const PoleChart> base_;
  bool mirror_;
};

// The offset of a graph at (x, y) in the basis' chart: projection on the tangent plane, its Jacobian, height, slopes
// and second form.
struct OffsetPlace {
  Eigen::Vector2d foot, slope;
  Eigen::Matrix2d J, second;
  double height, w;  // w = |(-h_a, -h_b, 1)|
};

// With v = (-h_a, -h_b, 1) and n = v / w: S + d n, and -n_i . S_j, i.e. the second form minus d times the third.
OffsetPlace offset_at(const HeightJet& h, Uv q, double d) {
  using Vector = Eigen::Vector3d;
  const Vector v(-h.fu, -h.fv, 1.0);
  const double w = v.norm();
  const Vector n = v / w, va(-h.fuu, -h.fuv, 0.0), vb(-h.fuv, -h.fvv, 0.0);
  const Vector na = (va - n.dot(va) * n) / w, nb = (vb - n.dot(vb) * n) / w;
  const Vector Sa = Vector(1.0, 0.0, h.fu) + d * na, Sb = Vector(0.0, 1.0, h.fv) + d * nb;
  OffsetPlace p;
  p.foot = {q.u + d * n.x(), q.v + d * n.y()};
  p.slope = {h.fu, h.fv};
  p.J << Sa.x(), Sb.x(), Sa.y(), Sb.y();
  p.second << -na.dot(Sa), -na.dot(Sb), -nb.dot(Sa), -nb.dot(Sb);
  // The height over the moved pole: d (1 / w - 1), without the difference.
  p.height = h.f - d * p.slope.squaredNorm() / (w * (1.0 + w));
  p.w = w;
  return p;
}

class OffsetCap final : public PoleChart {
 public:
  OffsetCap(std::shared_ptr<const PoleChart> basis, double distance, double radius)
      : PoleChart(moved(basis->frame(), distance), basis->side(), radius, std::numeric_limits<double>::infinity()),
        basis_(std::move(basis)),
        distance_(distance),
        to_basis_(place({0.0, 0.0}).J.inverse()) {}

  Uv to_base(Uv ab) const override { return basis_->to_base(foot(ab)); }
  Uv from_base(Uv p) const override {
    const OffsetPlace at = place(basis_->from_base(p));
    return {at.foot.x(), at.foot.y()};
  }
  bool holds(Uv p) const override {
    if (!basis_->holds(p)) return false;
    const Uv ab = from_base(p);
    return std::hypot(ab.u, ab.v) <= radius();
  }
  // Both maps have the same lines, but their tangents differ by n_u: side_direction of the basis through the Jacobian.
  Xyz side_direction(Uv p) const override {
    const Xyz d = basis_->side_direction(p);
    const Frame& f = frame();
    const OffsetPlace at = place(basis_->from_base(p));
    const Eigen::Vector2d moved_direction = at.J * Eigen::Vector2d(d.dot(f.x), d.dot(f.y));
    const double up = at.slope.dot(moved_direction);
    return (moved_direction.x() * f.x + moved_direction.y() * f.y + up * f.z).normalized();
  }

  bool regular_at(Uv ab) const {
    const Uv q = foot(ab);
    if (!is_finite(q) || !(std::hypot(q.u, q.v) <= kCorner * basis_->radius())) return false;
    // The Jacobian stays near that at the pole, so that Newton's method has no choice between feet.
    const double change = (to_basis_ * place(q).J - Eigen::Matrix2d::Identity()).norm();
    return change < 0.5;
  }

  HeightJet height(Uv ab) const override {
    const OffsetPlace at = place(foot(ab));
    const Eigen::Matrix2d inverse = at.J.inverse();
    const Eigen::Matrix2d second = at.w * inverse.transpose() * at.second * inverse;
    const double f = at.height + at.slope.dot(Eigen::Vector2d(ab.u, ab.v) - at.foot);
    return {f, at.slope.x(), at.slope.y(), second(0, 0), second(0, 1), second(1, 1)};
  }

 private:
  static Frame moved(Frame f, double distance) {
    f.origin += distance * f.z;
    return f;
  }
  OffsetPlace place(Uv q) const { return offset_at(basis_->height(q), q, distance_); }

  // The place in the basis' chart whose offset projects to (a, b); NaN where the iteration runs away.
  Uv foot(Uv ab) const {
    constexpr int kSteps = 30;
    constexpr double kSettled = 4.0 * std::numeric_limits<double>::epsilon();
    const Eigen::Vector2d goal(ab.u, ab.v);
    Eigen::Vector2d q = to_basis_ * goal;
    double last = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kSteps; ++i) {
      const OffsetPlace at = place({q.x(), q.y()});
      const Eigen::Vector2d miss = goal - at.foot;
      const double size = miss.norm();
      if (!(size > kSettled * goal.norm()) || (size < 1e3 * kSettled * goal.norm() && !(size < 0.5 * last))) break;
      last = size;
      q += at.J.inverse() * miss;
    }
    return {q.x(), q.y()};
  }

  std::shared_ptr<const PoleChart> basis_;
  double distance_;
  Eigen::Matrix2d to_basis_;  // inverse Jacobian at the pole
};

std::shared_ptr<const PoleChart> offset_cap(const std::shared_ptr<const PoleChart>& basis, double distance) {
  constexpr int kDirections = 16, kHalvings = 8;
  const Eigen::Matrix2d J = offset_at(basis->height({0.0, 0.0}), {0.0, 0.0}, distance).J;
  // Eigenvalues of J at the pole are 1 - d k: a negative product turns the normal round, a small one is a focal point.
  constexpr double kFocal = 1e-6;
  const double smaller = J.inverse().norm();
  if (!(J.determinant() > 0.0) || !(smaller < 1.0 / kFocal)) return nullptr;
  double radius = basis->radius() / smaller;
  for (int i = 0; i < kHalvings; ++i, radius *= 0.5) {
    auto cap = std::make_shared<const OffsetCap>(basis, distance, radius);
    bool regular = true;
    for (int k = 0; k < kDirections && regular; ++k) {
      const double t = 2.0 * std::numbers::pi * k / kDirections;
      regular = cap->regular_at({kCorner * radius * std::cos(t), kCorner * radius * std::sin(t)});
    }
    if (regular) return cap;
  }
  return nullptr;
}

}  // namespace

PoleCharts reparameterized_poles(const Reparameterized& surface) {
  const bool mirror = (surface.u_turned() != surface.v_turned()) != surface.swapped();
  PoleCharts charts;
  for (const auto& base : surface.base().poles())
    charts.push_back(std::make_shared<const ReparameterizedCap>(surface, base, mirror));
  return charts;
}

PoleCharts offset_poles(const OffsetSurface& surface) {
  PoleCharts charts;
  for (const auto& basis : surface.basis().poles())
    if (auto cap = offset_cap(basis, surface.distance())) charts.push_back(std::move(cap));
  return charts;
}

}  // namespace geovor
