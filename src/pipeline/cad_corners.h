// The corners of a CAD model's faces: the angles that no mesh can make larger.
#pragma once

#include <vector>

#include "brep/model.h"

namespace geovor {

/// Where two edges of a face meet at a vertex. Seams and poles make no corner.
struct CadCorner {
  int face = -1;  ///< index into CadModel::faces
  Xyz at;
  double angle = 0.0;  ///< inside the face, degrees, 0 … 360; 0 for a cusp
};
std::vector<CadCorner> cad_corners(const CadModel& model);

}  // namespace geovor
