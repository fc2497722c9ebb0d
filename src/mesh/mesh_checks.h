// What is true of a triangle mesh, without knowing where it came from.
#pragma once

#include <optional>
#include <string>

#include "mesh/triangle_mesh.h"

namespace geovor {

struct MeshTopology {
  int vertices = 0;  ///< points that a triangle uses
  int edges = 0;
  int triangles = 0;
  int border_edges = 0;  ///< used once
  int bad_edges = 0;     ///< used more than twice, or twice in the same direction
  int components = 0;    ///< sets of triangles connected through shared points
  int euler() const { return vertices - edges + triangles; }
  bool closed() const { return triangles > 0 && border_edges == 0 && bad_edges == 0; }
};
/// Counts. REQUIRES: indices in range (first_fault).
MeshTopology topology(const TriangleMesh& mesh);

struct MeshQuality {
  double area = 0.0;
  double volume = 0.0;               ///< signed, by the divergence theorem; means something for closed meshes only
  double smallest_angle = 0.0;       ///< degrees
  double largest_angle = 0.0;        ///< degrees
  double mean_smallest_angle = 0.0;  ///< mean over the triangles of their smallest angle, degrees
  int below_20 = 0;                  ///< triangles with an angle below 20 degrees
  int below_30 = 0;
  double shortest_edge = 0.0, median_edge = 0.0, longest_edge = 0.0;
  int zero_area = 0;  ///< triangles whose area is below rounding
};
/// All zero for a mesh without triangles. REQUIRES: indices in range (first_fault).
MeshQuality quality(const TriangleMesh& mesh);

/// The first law of TriangleMesh that is broken ("triangle 7 names point 12 of 10"), or nothing: indices in range,
/// three different corners, finite points, no directed edge twice, face_of complete.
std::optional<std::string> first_fault(const TriangleMesh& mesh);

}  // namespace geovor
