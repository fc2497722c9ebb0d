// Where a triangle mesh of unknown origin is not what a mesh should be, and how its angles and edges are spread.
#pragma once

#include <array>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace geovor {

/// An edge of the mesh between two points, and the triangles that use it, ascending.
struct MeshEdge {
  int from = -1, to = -1;  ///< from < to
  std::vector<int> triangles;
};

/// What is broken, by place. REQUIRES: indices in range; a triangle may have a corner twice.
struct MeshFaults {
  std::vector<MeshEdge> open;         ///< edges of one triangle
  std::vector<MeshEdge> crowded;      ///< edges of three triangles or more
  std::vector<MeshEdge> disagreeing;  ///< edges of two triangles that run through it in the same direction
  std::vector<int> pinched;           ///< points whose triangles are no single fan
  std::vector<int> without_area;      ///< triangles whose area is below the rounding of their corners
  bool manifold() const { return crowded.empty() && pinched.empty(); }
};
MeshFaults mesh_faults(const TriangleMesh& mesh);

/// The angles of a triangle at its corners, degrees; 0, 0, 180 in some order where it has no area.
std::array<double, 3> corner_angles(const TriangleMesh& mesh, int triangle);

/// The edges' lengths in ascending order, each edge once.
struct EdgeLengths {
  std::vector<double> sorted;
  /// The length below which a share (0 … 1) of the edges lies; 0 where there is none.
  double at(double share) const;
  double mean() const;
};
EdgeLengths edge_lengths(const TriangleMesh& mesh);

/// Every edge once, in ascending order of its points. Triangles with a corner twice have none.
std::vector<MeshEdge> mesh_edges(const TriangleMesh& mesh);

}  // namespace geovor
