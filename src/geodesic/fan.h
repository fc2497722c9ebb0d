// The safe way to the shortest geodesic: the geodesics that leave a point in all directions, followed roughly, each
// looked at for how near it passes by the target.
#pragma once

#include <vector>

#include "geodesic/connect.h"

namespace geovor {

/// Where a geodesic seems to end at the target.
struct FanHit {
  Polar at;           ///< to some percent
  double turn = 0.0;  ///< to the next geodesic that was followed
  bool plain = true;  ///< far from conjugate points, and not on another sheet: one geodesic must be meant
};

struct Fan {
  std::vector<FanHit> hits;  ///< by length; neighbours often hit with the same geodesic in mind
  /// Every point that a geodesic within the length reaches on the domain lies between two neighbouring geodesics that
  /// are close to each other for the curvature thereabouts. If not, some could not be followed far enough, or spread
  /// too fast.
  bool complete = false;
  int evaluations = 0;
};

/// A fan of a length follows its rays this many lengths.
inline constexpr double kFanReach = 1.05;

/// Follows geodesics from `from` as far as `length`, their first conjugate point (none is a shortest path beyond) or
/// the domain's border, as many as are needed to leave no gap.
Fan search_fan(const Surface& surface, Uv from, Uv to, double length);

}  // namespace geovor
