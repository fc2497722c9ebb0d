// A triangle mesh as plain arrays: what the mesher makes, the checks read and the writers write.
#pragma once

#include <array>
#include <vector>

#include "base/xyz.h"

namespace geovor {

/// Triangles over shared points. Corners run counter-clockwise seen from outside (for an open face: from the side of
/// the face's normal).
struct TriangleMesh {
  std::vector<Xyz> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> face_of;  ///< a triangle's CAD face number (FaceN's N), same length as `triangles`
};

}  // namespace geovor
