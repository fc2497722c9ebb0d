// The energy method: a geodesic as the minimum of 1/2 int |d/dt r(x(t))|^2, from any path between two points. Slower
// than shooting and no more accurate than its nodes allow, but it converges from far away.
#pragma once

#include <vector>

#include "geodesic/shooting.h"

namespace geovor {

struct RelaxedPath {
  bool converged = false;
  Polar start;            ///< angle and length: what shooting starts from
  std::vector<Uv> nodes;  ///< at the Lobatto nodes
  int evaluations = 0;
};

/// Damped Newton on the interior nodes of a path given at Lobatto nodes (see numeric/lobatto.h), ends held fixed. The
/// curve in space is the polynomial through the nodes' positions, so the parameterization does not matter.
RelaxedPath relax(const Surface& surface, const Ends& ends, std::vector<Uv> nodes);

/// A polyline of the parameter plane at Lobatto nodes of the given degree, by arc length in space.
std::vector<Uv> at_lobatto_nodes(const Surface& surface, const std::vector<Uv>& polyline, int degree);

/// The geodesic near a polyline from ends.from to ends.to: relaxed with more and more nodes until shooting from it
/// converges.
Connection connect_along(const Surface& surface, const Ends& ends, const std::vector<Uv>& polyline,
                         const ConnectOptions& options);

}  // namespace geovor
