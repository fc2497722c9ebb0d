// The geodesic Delaunay graph of a diagram: sites joined where their cells meet.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "surface/surface.h"
#include "voronoi/diagram.h"

namespace geovor {

/// Two sites whose cells share an edge, joined by the geodesic that crosses there. A pair that shares several edges is
/// listed once for each, every time with the geodesic through that edge (which runs on the other side of a bump, or
/// the other way round a cylinder).
struct DualEdge {
  int a = -1, b = -1;
  int edge = -1;         ///< the edge of the diagram that it crosses: a is to its left, b to its right
  double length = 0.0;   ///< of the geodesic
  double angle = 0.0;    ///< t under which it leaves a
  bool through = false;  ///< it is the geodesic through the edge; else none settled there, and it is the shortest one
  /// For pictures, where asked for: the geodesic from a to b, values running on across seams.
  std::vector<Uv> path_uv;
  std::vector<Xyz> path;
};

struct DualGraph {
  std::vector<DualEdge> edges;                ///< in the order of the diagram's edges, cut loci left out
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise; a vertex of k > 3 sites gives k - 2
  /// The edges and triangles are a triangulation of the sites: every cell is a disk that meets the border of the face
  /// once at most, two cells meet in one edge at most, every edge has a triangle, no two triangles the same corners.
  bool is_triangulation = false;
  std::string why_not;  ///< empty where it is one; names the sites at fault
};

enum class DualPaths { None, Drawn };

/// The dual of a finished diagram, in time that grows as the diagram does. Lengths are good to 1e-12; the paths, for
/// pictures, to kDrawnPath of their length.
DualGraph dual_of(const Surface& surface, const VoronoiDiagram& diagram, DualPaths paths = DualPaths::Drawn);

inline constexpr double kDrawnPath = 1e-6;

}  // namespace geovor
