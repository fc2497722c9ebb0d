// Sharp corners of the CAD, and the small angles of a mesh that are no such corner's.
#pragma once

#include <vector>

#include "brep/model.h"
#include "delaunay/border.h"
#include "delaunay/face_mesh.h"

namespace geovor {

/// A corner of a face in which no mesh has a larger angle than this.
struct SharpCorner {
  int face = 0;  ///< FaceN's N
  Xyz place;
  double angle = 0.0;     ///< degrees
  int border_point = -1;  ///< its number among BorderPoints
};

/// Below this angle, degrees, a corner is listed and a triangle counted.
inline constexpr double kSmallAngle = 30.0;

/// The corners of the faces below kSmallAngle, in the order of faces and loops.
std::vector<SharpCorner> small_corners(const CadModel& model, const std::vector<FaceCorner>& corners,
                                       const BorderPoints& border);

/// A face's triangles whose smallest angle is below kSmallAngle, and those among them where it isn't in a sharp corner.
struct SmallAngles {
  int all = 0;
  int away_from_corners = 0;
};

/// `corners` are those of this face.
SmallAngles small_angles(const FaceMesh& mesh, const BorderPoints& border, const std::vector<SharpCorner>& corners);

}  // namespace geovor
