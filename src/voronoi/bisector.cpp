#include "voronoi/bisector.h"

#include <Eigen/Geometry>
#include <cmath>

namespace geovor {
namespace {

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

// Unknowns: the common radius and the two angles.
std::optional<BisectorPoint> correct_bisector(const SiteRays& rays, int left, int right,
                                              const BisectorCoordinates& guess, const SectionPlane& plane,
                                              double miss) {
  const std::array<PolarGuess, 2> aims{{{left, guess.left_angle}, {right, guess.right_angle}}};
  const auto found = find_equidistant(rays, aims, guess.radius, &plane, miss);
  if (!found) return std::nullopt;
  return BisectorPoint{found->rays[0], found->rays[1]};
}

}  // namespace geovor
