// Points with the same geodesic distance to two sites, and the curve M(p,q) that they form (section 3.1.2 of the
// paper).
#pragma once

#include <optional>

#include "voronoi/equidistant_point.h"

namespace geovor {

/// A point m = O_p(r, phi) = O_q(r, psi) of the bisector of two generators. Seen by one who walks along the bisector in
/// the direction tangent(), p is to the left and q to the right (the surface normal is up).
struct BisectorPoint {
  SiteRay left, right;

  double radius() const { return 0.5 * (left.polar.s + right.polar.s); }
  const Xyz& position() const { return left.x; }

  /// Unit tangent of the bisector: it halves the angle from the direction of the right site to that of the left one,
  /// counter-clockwise, which keeps its digits where the two directions nearly agree and where they are opposite.
  Xyz tangent() const;
};

/// What the ODE (13) says at a point, in arc length of the surface: r' = cos(theta/2), phi' = sin(theta/2) / y_p,
/// psi' = -sin(theta/2) / y_q up to the direction of travel, here that of tangent().
struct BisectorSlope {
  double radius, left_angle, right_angle;
};
BisectorSlope bisector_slope(const BisectorPoint& m);

/// Three numbers that name a point of a bisector of two given sites.
struct BisectorCoordinates {
  double radius, left_angle, right_angle;
};
BisectorCoordinates coordinates(const BisectorPoint& m);

/// How far off a step of the ODE is as a rule.
inline constexpr double kMissOfPredictor = 1e-3;

/// The point of the bisector of sites `left` and `right` in the plane, by Newton's method from the guess. The two may
/// be branches of one site, told apart by their angles: its cut locus. `miss` is what the guess is off by, as a part of
/// its radius: where a good predictor says so, a point costs one trace a ray. Promises: both distances of the point
/// returned agree to kBisectorTolerance of the radius. Nothing where the iteration does not settle.
std::optional<BisectorPoint> correct_bisector(const SiteRays& rays, int left, int right,
                                              const BisectorCoordinates& guess, const SectionPlane& plane,
                                              double miss = kMissOfPredictor);

/// Bound on the difference of the two distances of a corrected point, relative to its radius: what two traces at
/// kRayTolerance leave open.
inline constexpr double kBisectorTolerance = 1e-12;

}  // namespace geovor
