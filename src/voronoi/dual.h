// The geodesic Delaunay graph of a diagram: sites joined where their cells meet.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "surface/surface.h"
#include "voronoi/diagram.h"

namespace geovor {

/// Two sites whose cells share an edge, joined by the geodesic that crosses there. A pair that shares several edges is
/// listed once for each.
struct DualEdge {
  int a = -1, b = -1;
  double length = 0.0;
  std::vector<Uv> path_uv;  ///< the geodesic from a to b, values running on across seams
  std::vector<Xyz> path;
};

struct DualGraph {
  std::vector<DualEdge> edges;                ///< in the order of the diagram's edges, cut loci left out
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise; a vertex of k > 3 sites gives k - 2
  bool is_triangulation = false;
  std::string why_not;  ///< empty where it is one
};

DualGraph dual_of(const Surface& surface, const VoronoiDiagram& diagram);

}  // namespace geovor
