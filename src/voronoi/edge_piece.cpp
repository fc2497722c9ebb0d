#include "voronoi/edge_piece.h"

#include <Eigen/Geometry>
#include <cmath>

namespace geovor {
namespace {

// Between two points of an edge an angle changes by what its slopes at both say, but for this part of it; more means
// that Newton's method went over to another geodesic of the site. A change too small to tell is none.
constexpr double kJump = 0.25;
constexpr double kNoChange = 1e-6;

bool is_free_end(const BisectorPoint& m) { return m.left.site == m.right.site && m.left.polar.t == m.right.polar.t; }

}  // namespace

double chord(const BisectorPoint& a, const BisectorPoint& b) { return (b.position() - a.position()).norm(); }

double turn(const BisectorPoint& a, const BisectorPoint& b) {
  const Xyz s = a.tangent(), t = b.tangent();
  return std::atan2(s.cross(t).norm(), s.dot(t));
}

double sag_of(const BisectorPoint& a, const BisectorPoint& b) {
  return is_free_end(a) || is_free_end(b) ? 0.0 : chord(a, b) * turn(a, b) / 8.0;
}

bool goes_on(const BisectorPoint& a, const BisectorPoint& b) {
  const double h = chord(a, b);
  const BisectorSlope d = bisector_slope(a), e = bisector_slope(b);
  const auto smooth = [h](double change, double slope0, double slope1) {
    const double most = kJump * h * (std::abs(slope0) + std::abs(slope1)) + kNoChange;
    return std::abs(wrap_angle(change - 0.5 * h * (slope0 + slope1))) <= most;
  };
  return smooth(b.left.polar.t - a.left.polar.t, d.left_angle, e.left_angle) &&
         smooth(b.right.polar.t - a.right.polar.t, d.right_angle, e.right_angle);
}

// The cubic that has the slopes of system (13) at both ends, half way between them.
std::optional<BisectorPoint> halfway(const SiteRays& rays, const BisectorPoint& a, const BisectorPoint& b) {
  const Xyz way = b.position() - a.position();
  const double h = way.norm();
  const BisectorSlope d = bisector_slope(a), e = bisector_slope(b);
  const auto middle = [h](double f0, double d0, double change, double d1) {
    return f0 + 0.5 * change + h / 8.0 * (d0 - d1);
  };
  const BisectorCoordinates guess = {
      middle(a.radius(), d.radius, b.radius() - a.radius(), e.radius),
      middle(a.left.polar.t, d.left_angle, wrap_angle(b.left.polar.t - a.left.polar.t), e.left_angle),
      middle(a.right.polar.t, d.right_angle, wrap_angle(b.right.polar.t - a.right.polar.t), e.right_angle)};
  const Xyz normal = way / h;
  const auto m = correct_bisector(rays, a.left.site, a.right.site, guess,
                                  {normal, normal.dot(0.5 * (a.position() + b.position()))});
  if (!m || chord(a, *m) > h || chord(*m, b) > h) return std::nullopt;
  return m;
}

}  // namespace geovor
