// A face cut into small, nearly flat pieces with boxes around them: where to look for the face, and where to sample it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "brep/face_domain.h"
#include "mesh/nearest_boxes.h"

namespace geovor {

/// The image of a rectangle of the parameter plane that holds some of the face.
struct SurfacePatch {
  UvBox box;
  bool inside = false;   ///< wholly in the face; otherwise the border passes through, or near by
  Uv middle;             ///< of the rectangle
  Xyz S, Su, Sv;         ///< there
  Eigen::Matrix3d axes;  ///< rows: two orthonormal directions along the patch, and its normal
  SpaceBox extent;       ///< along these rows, from S
  SpaceBox space;        ///< along the axes of space

  /// A lower bound of the squared distance from x to the patch, by the tilted box.
  double least_distance2(const Xyz& x) const { return extent.distance2(axes * (x - S)); }
  /// The parameters of the foot of x on the tangent plane at the middle, inside the rectangle.
  Uv guess(const Xyz& x) const;
};

/// Together they cover the face. A patch turns by no more than some 20 degrees and lies in its boxes as far as its
/// second differences tell; smaller than `negligible` (space) it is not cut any more.
std::vector<SurfacePatch> surface_patches(const FaceDomain& domain, double negligible);

}  // namespace geovor
