#include "voronoi/bisector.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "voronoi/equidistant_step.h"

namespace geovor {
namespace {

// Newton from the predictor takes two or three steps; more than this means that the guess was bad.
constexpr int kMaxIterations = 12;

// A step of the iteration that turns a geodesic by more than this (radians) means nothing any more.
constexpr double kMostTurn = 0.5;

double half_turn(const BisectorPoint& m) {
  const Xyz n = m.right.T.cross(m.right.N);
  return 0.5 * turn_between(-m.right.T, -m.left.T, n);
}

}  // namespace

Xyz BisectorPoint::tangent() const {
  const double half = half_turn(*this);
  return -std::cos(half) * right.T - std::sin(half) * right.N;
}

BisectorSlope bisector_slope(const BisectorPoint& m) {
  const double half = half_turn(m);
  return {-std::cos(half), std::sin(half) / m.left.y, -std::sin(half) / m.right.y};
}

BisectorCoordinates coordinates(const BisectorPoint& m) { return {m.radius(), m.left.polar.t, m.right.polar.t}; }

// Unknowns: the common radius and the two angles. The three conditions (both distances equal rho, the point in the
// plane) are linear in the tangent plane; what the new point asks of each angle is its way along N divided by y.
std::optional<BisectorPoint> correct_bisector(const SiteRays& rays, int left, int right,
                                              const BisectorCoordinates& guess, const SectionPlane& plane) {
  BisectorCoordinates c = guess;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const auto p = rays.at(left, {c.radius, c.left_angle});
    const auto q = rays.at(right, {c.radius, c.right_angle});
    if (!p || !q) return std::nullopt;
    const double mismatch = std::max((p->x - q->x).norm(), std::abs(plane.normal.dot(p->x) - plane.offset));
    if (mismatch <= kBisectorTolerance * c.radius) return BisectorPoint{*p, *q};
    EquidistantStep step(*p);
    step.add_ray(*p);
    step.add_ray(*q);
    step.add_plane(plane.normal, plane.offset);
    const EquidistantTarget target = step.solve();
    if (!target.solvable) return std::nullopt;
    const double turn_p = carry(*p, target.m).t - p->polar.t, turn_q = carry(*q, target.m).t - q->polar.t;
    const double k = std::min(1.0, kMostTurn / std::max(std::abs(turn_p), std::abs(turn_q)));
    c = {c.radius + k * (target.radius - c.radius), c.left_angle + k * turn_p, c.right_angle + k * turn_q};
  }
  return std::nullopt;
}

}  // namespace geovor
