// The distance between two points of a surface: the shortest of the geodesics that join them.
#pragma once

#include <vector>

#include "geodesic/connect.h"

namespace geovor {

struct DistanceOptions {
  ConnectOptions connect;
  /// Cells of the coarse grid, in each direction, whose graph path is a second start beside the straight line; zero:
  /// none.
  int grid = 24;
};

struct DistanceResult {
  Connection shortest;                 ///< status as connect() has it
  std::vector<Connection> candidates;  ///< every different geodesic that was found, by length; the first is `shortest`
};

/// The shortest geodesic between two points of the surface's domain. Starts from the straight line in the parameter
/// plane (in a periodic direction: both ways round), and from a graph path on a coarse grid measured in space; keeps
/// the shortest. On a plane, cylinder or sphere the answer is the closed form. Does not promise that no shorter
/// geodesic exists; the tests measure how often one does.
DistanceResult distance(const Surface& surface, Uv from, Uv to, const DistanceOptions& options = {});

}  // namespace geovor
