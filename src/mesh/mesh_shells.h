// A mesh as faces, edges and shells that share what they meet in: what writers of solids need.
#pragma once

#include <array>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace geovor {

/// One use of an edge by a triangle.
struct EdgeUse {
  int edge = 0;  ///< index into SharedEdges::ends
  bool reversed = false;
};

/// Every edge of the mesh once.
struct SharedEdges {
  std::vector<std::array<int, 2>> ends;      ///< points, in the direction of the first use
  std::vector<std::array<EdgeUse, 3>> uses;  ///< a triangle: from its corner k to the next one
};

/// Triangles joined by edges.
struct MeshShell {
  std::vector<int> triangles;  ///< ascending
  bool closed = false;         ///< every edge is used once in each direction
  double volume = 0.0;         ///< of a closed shell: negative where its normals look inwards
};

/// Edges are numbered in the order of their first use. REQUIRES: first_fault(mesh) finds nothing.
SharedEdges shared_edges(const TriangleMesh& mesh);

/// In the order of their first triangles.
std::vector<MeshShell> shells_of(const TriangleMesh& mesh, const SharedEdges& edges);

/// Whether a triangle has no plane: the sine of its corner is rounding.
bool is_flat(const TriangleMesh& mesh, int triangle);

}  // namespace geovor
