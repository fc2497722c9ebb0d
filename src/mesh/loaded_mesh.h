// A triangle mesh as a file gave it, with what the file says of it beside the triangles.
#pragma once

#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace geovor {

struct LoadedMesh {
  TriangleMesh mesh;                ///< face_of: index into `groups`, -1: in none
  std::vector<std::string> groups;  ///< names, or the file's numbers; what a group stands for is the file's affair
  std::string precision;   ///< how the file keeps coordinates: "single precision", "double precision", "7 digits"
  double rounding = 0.0;   ///< by which a point may lie beside its true place for that reason alone
  int other_elements = 0;  ///< elements that are no triangle, left out (lines, points, volumes)
  int split = 0;           ///< polygons that were cut into triangles
};

}  // namespace geovor
