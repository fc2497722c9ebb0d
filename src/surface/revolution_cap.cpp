#include "surface/revolution_cap.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "numeric/chebyshev.h"
#include "numeric/gauss_legendre.h"

namespace geovor {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

// A meridian's end within this part of its coordinates of the axis lies on it, and one that meets it within this angle
// of the right one meets it at a right angle: what text with 15 digits, or the cosine of pi/2, leaves.
constexpr double kRounding = 1e-14;
constexpr double kRightAngle = 1e-12;

// Depth of the disk, at the start, by |C'| / |C''|: a sphere's is a quarter of its radius.
constexpr double kDepth = 0.25;

// Series of this length over a part of the meridian that is short against its radius of curvature reach rounding;
// otherwise the part is halved, so often at most.
constexpr int kTerms = 24;
constexpr int kTail = 3;
constexpr double kSettled = 4e-15;
constexpr int kHalvings = 20;

// The series hold somewhat farther than the disk.
constexpr double kBeyond = 1.25;

// The meridian by its depth t from the end on the axis, in the directions across (e1, e2) and along the axis (n).
class Profile {
 public:
  Profile(const Curve3& meridian, const Frame& axes, const PoleSide& side)
      : meridian_(meridian), axes_(axes), side_(side), piece_(meridian.piece(side.at, side.low ? 1.0 : -1.0)) {}

  struct Place {
    double radius, turn;             // polar coordinates of the projection on the plane (e1, e2)
    double radius_t;                 // derivative of the radius
    double by_r2, slope_by_r, h_rr;  // height / r^2, its derivative by r over r, its second derivative
  };

  // Everything is an integral of C'' or C' from the pole on, so that the radius (O(t)) and the height (O(t^2)) keep
  // their relative accuracy as t -> 0:
  // across = t int C'(ts) ds, height = t^2 int (1-s) C''.n(ts) ds, height' = t int C''.n(ts) ds.
  Place at(double t) const {
    constexpr int kNodes = 16;
    const GaussRule& rule = gauss_legendre(kNodes);
    Eigen::Vector2d q(0.0, 0.0), D(0.0, 0.0);
    double Z0 = 0.0, Z1 = 0.0;
    for (int i = 0; i < kNodes; ++i) {
      const double s = 0.5 * (1.0 + rule.nodes[i]), w = 0.5 * rule.weights[i];
      const Jet c = jet(t * s);
      q += w * c.d1;
      D += w * s * c.d2;
      Z0 += w * (1.0 - s) * c.z2;
      Z1 += w * c.z2;
    }
    const Jet c = jet(t);
    const double length = q.norm();
    const Eigen::Vector2d along = q / length;
    // rho'' = along.C'' + |part of C' across `along`|^2 / rho, and that part is t D's.
    const double twist = along.x() * D.y() - along.y() * D.x();
    const double r1 = along.dot(c.d1), r2 = along.dot(c.d2) + t * twist * twist / length;
    Place p{t * length, std::atan2(q.y(), q.x()), r1, Z0 / (length * length), Z1 / (r1 * length), 0.0};
    p.h_rr = (c.z2 - p.slope_by_r * p.radius * r2) / (r1 * r1);
    return p;
  }

 private:
  struct Jet {
    Eigen::Vector2d d1, d2;
    double z2;
  };
  Jet jet(double t) const {
    const CurveJet<3> c = meridian_.jet(side_.low ? side_.at + t : side_.at - t, piece_);
    const double sign = side_.low ? 1.0 : -1.0;
    return {sign * Eigen::Vector2d(c.d1.dot(axes_.x), c.d1.dot(axes_.y)),
            Eigen::Vector2d(c.d2.dot(axes_.x), c.d2.dot(axes_.y)), c.d2.dot(axes_.z)};
  }

  const Curve3& meridian_;
  const Frame& axes_;
  const PoleSide& side_;
  CurvePiece piece_;
};

// The profile as series in the distance r from the axis.
struct ProfileSeries {
  double radius = 0.0;                      // of the disk; the series hold up to kBeyond times that
  ChebyshevSeries by_r2, slope_by_r, h_rr;  // as in Profile::Place
  ChebyshevSeries depth_by_r, turn;

  double depth(double r) const { return r * depth_by_r(r); }
};

// The depth at which the profile has the distance r from the axis; NaN passes.
double depth_of(const Profile& profile, double r, double guess) {
  constexpr int kSteps = 30;
  double t = guess;
  for (int i = 0; i < kSteps; ++i) {
    const Profile::Place p = profile.at(t);
    const double step = (r - p.radius) / p.radius_t;
    t += step;
    if (!(std::abs(step) > kRounding * t)) break;
  }
  return t;
}

// Over the part of the meridian up to about the depth `reach`; false where the series don't settle.
bool make_series(const Profile& profile, double reach, ProfileSeries& series) {
  const double edge = profile.at(reach).radius;
  const Interval over{0.0, edge};
  const double speed = profile.at(0.0).radius_t;
  std::vector<double> by_r2, slope, second, depth, turn;
  for (int k = 0; k < kTerms; ++k) {
    const double r = ChebyshevSeries::node(over, k, kTerms);
    const double t = depth_of(profile, r, depth.empty() ? r / speed : r * depth.back());
    if (!(t > 0.0 && t < 2.0 * reach)) return false;
    const Profile::Place p = profile.at(t);
    by_r2.push_back(p.by_r2);
    slope.push_back(p.slope_by_r);
    second.push_back(p.h_rr);
    depth.push_back(t / r);
    turn.push_back(p.turn);
  }
  series = {edge / kBeyond, {over, by_r2}, {over, slope}, {over, second}, {over, depth}, {over, turn}};
  const double curvature = std::abs(second.front()) + 1.0 / edge;
  return series.h_rr.tail(kTail) < kSettled * curvature && series.by_r2.tail(kTail) < kSettled * curvature &&
         series.slope_by_r.tail(kTail) < kSettled * curvature &&
         series.depth_by_r.tail(kTail) < kSettled * std::abs(depth.front()) && series.turn.tail(kTail) < kSettled;
}

class RevolutionCap final : public PoleChart {
 public:
  // `turn_sign`: whether u turns about n counter-clockwise (1) or clockwise (-1).
  RevolutionCap(const Frame& axes, const PoleSide& side, const ProfileSeries& series, double turn_sign)
      : PoleChart(axes, side, series.radius, series.depth(series.radius) * 1.01),
        series_(series),
        turn_sign_(turn_sign) {}

  Uv to_base(Uv ab) const override {
    const double r = std::hypot(ab.u, ab.v);
    const double u = turn_sign_ * (std::atan2(ab.v, ab.u) - series_.turn(r));
    return side().point(u - kTwoPi * std::floor(u / kTwoPi), series_.depth(r));
  }

  // r with depth(r) = t; the depth is nearly proportional to r.
  Uv from_base(Uv p) const override {
    constexpr int kSteps = 40;
    const double t = side().depth(p);
    double r = t / series_.depth_by_r(0.0);
    for (int i = 0; i < kSteps; ++i) {
      const double next = t / series_.depth_by_r(std::clamp(r, -radius() * kBeyond, radius() * kBeyond));
      const bool settled = !(std::abs(next - r) > kRounding * std::abs(r));
      r = next;
      if (settled) break;
    }
    const double angle = turn_sign_ * p.u + series_.turn(r);
    return {r * std::cos(angle), r * std::sin(angle)};
  }

  Xyz side_direction(Uv p) const override {
    const Uv ab = from_base(p);
    const double angle = ab.u == 0.0 && ab.v == 0.0 ? turn_sign_ * p.u + series_.turn(0.0) : std::atan2(ab.v, ab.u);
    return turn_sign_ * (std::cos(angle) * frame().y - std::sin(angle) * frame().x);
  }

  HeightJet height(Uv ab) const override {
    const double r = std::hypot(ab.u, ab.v);
    const double c = r > 0.0 ? ab.u / r : 1.0, s = r > 0.0 ? ab.v / r : 0.0;
    const double slope = series_.slope_by_r(r), second = series_.h_rr(r);
    return {r * r * series_.by_r2(r),
            slope * ab.u,
            slope * ab.v,
            second * c * c + slope * s * s,
            (second - slope) * c * s,
            second * s * s + slope * c * c};
  }

 private:
  ProfileSeries series_;
  double turn_sign_;
};

// Axes at the end of the meridian, if that lies on the axis and leaves it at a right angle.
std::optional<Frame> axes_at(const RevolutionSurface& surface, const PoleSide& side) {
  const Curve3& meridian = surface.meridian();
  const CurveJet<3> c = meridian.jet(side.at, meridian.piece(side.at, side.low ? 1.0 : -1.0));
  const Xyz &axis = surface.axis_direction(), arm = c.C - surface.axis_origin();
  const double size = c.C.cwiseAbs().maxCoeff() + arm.norm() + c.d2.norm();
  const double speed = c.d1.norm();
  if (!(axis.cross(arm).norm() <= kRounding * size)) return std::nullopt;
  if (!(std::abs(c.d1.dot(axis)) <= kRightAngle * speed)) return std::nullopt;
  Frame axes;
  axes.origin = surface.axis_origin() + axis.dot(arm) * axis;
  const double inward = side.low ? 1.0 : -1.0;
  axes.x = inward * (c.d1 - axis.dot(c.d1) * axis).normalized();
  // Su x Sv at the low end is (axis x e1) x e1 = -axis, times a length.
  axes.z = -inward * axis;
  axes.y = axes.z.cross(axes.x);
  return axes;
}

std::shared_ptr<const PoleChart> cap_at(const RevolutionSurface& surface, const PoleSide& side) {
  const std::optional<Frame> axes = axes_at(surface, side);
  if (!axes) return nullptr;
  const Curve3& meridian = surface.meridian();
  const CurvePiece piece = meridian.piece(side.at, side.low ? 1.0 : -1.0);
  const CurveJet<3> c = meridian.jet(side.at, piece);
  const Interval range = surface.v_period() ? piece.box : meridian.domain();
  const double rest =
      side.low ? std::min(piece.box.hi, range.hi) - side.at : side.at - std::max(piece.box.lo, range.lo);
  const double bend = c.d2.norm() / c.d1.norm();
  double reach = bend * rest > kDepth ? kDepth / bend : rest;
  const Profile profile(meridian, *axes, side);
  ProfileSeries series;
  for (int i = 0; i < kHalvings; ++i, reach *= 0.5)
    if (make_series(profile, reach, series))
      return std::make_shared<const RevolutionCap>(*axes, side, series, side.low ? -1.0 : 1.0);
  return nullptr;
}

// Parameters inside the domain at which the meridian runs through the axis: CAD files give whole circles and ellipses
// of which the face has an arc. Newton on |C across the axis|^2, from samples that are lower than their neighbours.
std::vector<double> crossings(const RevolutionSurface& surface) {
  constexpr int kSamples = 96, kSteps = 50;
  const Interval range = surface.meridian().domain();
  const Xyz& axis = surface.axis_direction();
  std::vector<double> found;
  if (!std::isfinite(range.length())) return found;
  auto across = [&axis](const Xyz& w) -> Xyz { return w - axis.dot(w) * axis; };
  auto arm = [&](double t) { return across(surface.meridian().position(t) - surface.axis_origin()).norm(); };
  const double step = range.length() / kSamples;
  for (int i = 0; i < kSamples; ++i) {
    double t = range.lo + (i + 0.5) * step;
    if (!(arm(t) <= arm(t - step) && arm(t) <= arm(t + step))) continue;
    for (int k = 0; k < kSteps; ++k) {
      const CurveJet<3> c = surface.meridian().jet(t);
      const Xyz r = across(c.C - surface.axis_origin()), r1 = across(c.d1);
      const double move = -r.dot(r1) / r1.squaredNorm();  // Gauss-Newton: quadratic, as the residual is zero
      t += move;
      if (!(std::abs(move) > 0.5 * std::numeric_limits<double>::epsilon() * std::abs(t))) break;
    }
    if (!(range.lo + 0.5 * step < t && t < range.hi - 0.5 * step) && !surface.v_period()) continue;
    if (found.empty() || std::abs(t - found.back()) > 0.5 * step) found.push_back(t);
  }
  return found;
}

}  // namespace

PoleCharts revolution_poles(const RevolutionSurface& surface) {
  const Interval range = surface.meridian().domain();
  std::vector<PoleSide> sides;
  for (const double at : crossings(surface)) {
    sides.push_back({true, at, true});
    sides.push_back({true, at, false});
  }
  if (!surface.v_period()) {
    if (std::isfinite(range.lo)) sides.push_back({true, range.lo, true});
    if (std::isfinite(range.hi)) sides.push_back({true, range.hi, false});
  }
  PoleCharts charts;
  for (const PoleSide& side : sides)
    if (auto chart = cap_at(surface, side)) charts.push_back(std::move(chart));
  return charts;
}

}  // namespace geovor
