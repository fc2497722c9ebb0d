// The cells of a diagram as triangles: what pictures in space are made of.
#pragma once

#include <array>
#include <vector>

#include "base/xyz.h"

namespace geovor {

/// Each cell has points of its own. Corners run counter-clockwise seen from the side of the normals.
struct CellMesh {
  std::vector<Xyz> points;
  std::vector<Xyz> normals;  ///< of the surface, unit length; one a point
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> site_of;              ///< of a triangle
  std::vector<std::vector<Xyz>> border;  ///< of the face, as polylines; seams and poles left out
};

}  // namespace geovor
