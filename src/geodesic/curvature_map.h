// Where a surface is curved, and how far a geodesic may go at once without passing by a place that is more curved than
// where it comes from.
#pragma once

#include <vector>

#include "surface/surface.h"

namespace geovor {

class CurvatureMap {
 public:
  /// Looks at a grid over the domain; of an infinite one at a part, since cylinders are the same all along. What is
  /// narrower than a cell of the grid may be missed.
  explicit CurvatureMap(const Surface& surface);

  /// The largest normal curvature that was found.
  double largest() const { return largest_; }

  /// How far a ray of length s whose last leg ended at p, after `covered`, may be traced in one go to this tolerance:
  /// to s in the end. From flat ground the integrator may step over the tail of a low bump, or through a saddle's flat
  /// middle, and take the error for less than it is: on a bump of height and width 0.5 rays of length 0.6 were 4e-11
  /// off, on a monkey saddle some of length 0.1 were 8e-12. Legs that are a part of radius() end before.
  double leg_end(Uv p, double covered, double s, double tolerance) const;

  /// The tolerance for which a leg of this length from p is short enough, whatever the steps on it say of their errors.
  double tolerance_of(Uv p, double leg) const;

  /// Whether p is not far beyond the domain: within half of its extents. Farther out, continued polynomials are no
  /// guide to anything, and a path may take thousands of steps.
  bool near_domain(Uv p) const;

  /// No place that is nearer to p than four times this has a smaller radius of curvature than this: the minimum over
  /// all places x of max(|x - p| / 4, radius at x). How a bump's curvature fades tells how wide it is: far from all
  /// that is sharp, and only there, things change slowly. Infinite where the surface is flat.
  double radius(Uv p) const;

 private:
  int cell(double x, Interval range, bool periodic) const;

  UvBox box_, rim_;
  bool u_periodic_, v_periodic_;
  double largest_ = 0.0;
  std::vector<double> radii_;  ///< by cell, rows of u
};

}  // namespace geovor
