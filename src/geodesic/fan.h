// The safe way to the shortest geodesic: the geodesics that leave a point in all directions, followed roughly, each
// looked at for how near it passes by the target.
#pragma once

#include <vector>

#include "geodesic/connect.h"

namespace geovor {

struct Fan {
  std::vector<Polar> hits;  ///< where a geodesic ends at the target, to some percent: guesses for connect()
  /// Every point within the length, on the domain, lies between two neighbouring geodesics that are close to each other
  /// for the curvature thereabouts. If not, some could not be followed far enough, or spread too fast.
  bool complete = false;
  int evaluations = 0;
};

/// Follows geodesics from `from` as far as `length`, their first conjugate point (none is a shortest path beyond) or
/// the domain's border, as many as are needed to leave no gap.
Fan search_fan(const Surface& surface, Uv from, Uv to, double length);

}  // namespace geovor
