#include "voronoi/edge_on_border.h"

#include <algorithm>
#include <cmath>

#include "surface/forms.h"

namespace geovor {
namespace {

// Part of the first chord of an edge that starts on the border in which the start itself would be met.
constexpr double kOffBorder = 1e-3;

// How often a chord near the border is halved: to a thousandth.
constexpr int kDeepest = 10;

// Chords of one cubic: as many make what sags by a part of the face's size as fine as the default tolerance.
constexpr double kMostPieces = 256;

// The parameters of a side where the metric vanishes are farther off than the metric says: with the third power of them
// by a factor of three, with the n-th by n.
constexpr double kBeyondSide = 10.0;

// Chords are shorter than the way, and the border is measured to first order only.
constexpr double kBorderMargin = 2.0;

constexpr int kBorderIterations = 30;

// A last step along the border, in radii: so short that rays are moved by it to all digits.
constexpr double kLastStep = 1e-9;

/// The cubic of the parameter plane with the edge's directions at two of its points.
class ParameterCubic {
 public:
  /// `from`: the copy of a's parameters where it starts.
  ParameterCubic(const Surface& surface, const BisectorPoint& a, const BisectorPoint& b, Uv from)
      : from_(from),
        way_(nearest_copy(surface, a.left.uv, b.left.uv)),
        leaves_(tangent_components(surface.jet(a.left.uv), chord(a, b) * a.tangent())),
        arrives_(tangent_components(surface.jet(b.left.uv), chord(a, b) * b.tangent())) {}

  Uv at(double k) const {
    const double r = 1.0 - k;
    return from_ + k * k * (3.0 - 2.0 * k) * way_ + k * r * (r * leaves_ + -k * arrives_);
  }

 private:
  Uv from_;
  UvVec way_, leaves_, arrives_;
};

}  // namespace

std::optional<EdgeOnBorder::Crossing> EdgeOnBorder::first_crossing(const BisectorPoint& a, const BisectorPoint& b,
                                                                   bool starts_on_border) const {
  return leaves_face(a, b, starts_on_border ? kOffBorder : 0.0, 0);
}

std::optional<EdgeOnBorder::Crossing> EdgeOnBorder::straight_on(const BisectorPoint& a, double h,
                                                                bool starts_on_border) const {
  if (border_.cycle_count() == 0 || !border_.near_border(a.position(), h)) return std::nullopt;
  const SurfaceJet j = rays_.surface().jet(a.left.uv);
  const Uv from = domain_.to_principal(a.left.uv);
  const UvVec step = tangent_components(j, kBeyondSide * h * a.tangent());
  if (!is_finite(step)) return std::nullopt;
  const auto crossing = border_.first_crossing(from, from + step, starts_on_border ? kOffBorder : 0.0);
  if (!crossing) return std::nullopt;
  return Crossing{a, a, *crossing};
}

// Near the border a chord is halved until the cubic of the parameter plane, of which half way tells how good it is,
// lies as near to the edge as the border's own chords to the border.
std::optional<EdgeOnBorder::Crossing> EdgeOnBorder::leaves_face(const BisectorPoint& a, const BisectorPoint& b,
                                                                double skip, int depth) const {
  if (border_.cycle_count() == 0) return std::nullopt;
  const double reach = kBorderMargin * chord(a, b);
  if (depth > 0 && !border_.near_border(a.position(), reach)) return std::nullopt;
  const Uv from = domain_.to_principal(a.left.uv);
  if (depth == 0 && domain_.contains(from) && domain_.distance_to_border(from) > reach) return std::nullopt;
  if (depth < kDeepest && sag_of(a, b) > sag_) {
    if (const auto middle = halfway(rays_, a, b)) {
      const ParameterCubic whole(rays_.surface(), a, b, from);
      const Xyz guess = rays_.surface().position(whole.at(0.5));
      const bool good = (guess - middle->position()).norm() <= sag_;
      const auto look = [&](const BisectorPoint& p, const BisectorPoint& q, double part) {
        return good ? cubic_leaves_face(p, q, part) : leaves_face(p, q, part, depth + 1);
      };
      if (const auto first = look(a, *middle, 2.0 * skip)) return first;
      return look(*middle, b, 0.0);
    }
  }
  const Uv to = from + nearest_copy(rays_.surface(), a.left.uv, b.left.uv);
  if (const auto crossing = chord_leaves_face(from, to, skip)) return Crossing{a, b, *crossing};
  return std::nullopt;
}

std::optional<FaceBorder::Crossing> EdgeOnBorder::chord_leaves_face(Uv from, Uv to, double skip) const {
  if (const auto crossing = border_.first_crossing(from, to, skip)) return crossing;
  if (domain_.contains(to)) return std::nullopt;
  const auto place = border_.nearest(to);
  if (!place) return std::nullopt;
  return FaceBorder::Crossing{*place, 1.0};
}

// The chords of the cubic lie as near to it as it does to the edge.
std::optional<EdgeOnBorder::Crossing> EdgeOnBorder::cubic_leaves_face(const BisectorPoint& a, const BisectorPoint& b,
                                                                      double skip) const {
  const ParameterCubic cubic(rays_.surface(), a, b, domain_.to_principal(a.left.uv));
  const int pieces = static_cast<int>(std::clamp(std::ceil(std::sqrt(sag_of(a, b) / sag_)), 1.0, kMostPieces));
  for (int i = 0; i < pieces; ++i) {
    const double k = 1.0 * i / pieces, next = (i + 1.0) / pieces;
    auto crossing = chord_leaves_face(cubic.at(k), cubic.at(next), i == 0 ? skip * pieces : 0.0);
    if (!crossing) continue;
    crossing->fraction = k + crossing->fraction * (next - k);
    return Crossing{a, b, *crossing};
  }
  return std::nullopt;
}

// Newton's method for d_left = d_right along the border.
std::optional<BisectorPoint> EdgeOnBorder::point(const Crossing& crossing, BorderPlace& place) const {
  place = crossing.at.place;
  BisectorPoint m = crossing.at.fraction < 0.5 ? crossing.from : crossing.to;
  const double n = border_.segment_count(place.cycle);
  for (int i = 0; i < kBorderIterations; ++i) {
    const Uv uv = border_.uv(place);
    const SurfaceJet j = rays_.surface().jet(uv);
    const auto left = rays_.to(m.left.site, uv, carry(m.left, j.S));
    const auto right = rays_.to(m.right.site, uv, carry(m.right, j.S));
    if (!left || !right) return std::nullopt;
    m = {*left, *right};
    const double f = left->polar.s - right->polar.s;
    if (std::abs(f) <= kBisectorTolerance * m.radius()) return settled_on_border(rays_, border_, place, m);
    const double slope = (left->T - right->T).dot(push_forward(j, border_.direction(place)));
    const double step = -f / slope;
    if (!std::isfinite(step)) return std::nullopt;
    place.parameter += std::clamp(step, -0.5 * n, 0.5 * n);
    place.parameter -= n * std::floor(place.parameter / n);
  }
  return std::nullopt;
}

BisectorPoint settled_on_border(const SiteRays& rays, const FaceBorder& border, BorderPlace place, BisectorPoint m) {
  const UvVec direction = border.direction(place);
  const Xyz along = push_forward(rays.surface().jet(m.left.uv), direction);
  const double step = (m.right.polar.s - m.left.polar.s) / (m.left.T - m.right.T).dot(along);
  if (!(std::abs(step) * along.norm() <= kLastStep * m.radius())) return m;
  const Uv left = m.left.uv + step * direction, right = m.right.uv + step * direction;
  const SurfaceJet j = rays.surface().jet(left);
  return {moved(m.left, left, j), moved(m.right, right, j)};
}

}  // namespace geovor
