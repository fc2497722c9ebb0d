// A mesh with what the CAD says of its faces: what the writers of meshes take.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace geovor {

struct FaceLabel {
  int face = 0;                                 ///< FaceN's N
  std::string name;                             ///< the CAD's, any text; may be empty, or the name of other faces too
  std::optional<std::array<double, 3>> colour;  ///< red, green, blue: 0 … 1, linear
};

struct LabelledMesh {
  const TriangleMesh& mesh;
  std::vector<FaceLabel> labels = {};  ///< of any faces, in any order; a face without one has its number alone
  std::string title = "geovor";        ///< any text
  std::string unit = "mm";             ///< of the coordinates
};

}  // namespace geovor
