// The curvature of a surface beside the border of a face.
#pragma once

#include "delaunay/surface_probe.h"

namespace geovor {

/// A place on a face's border, and where the face lies.
struct BesidePlace {
  Uv p;
  UvVec inward;  ///< a parameter direction into the face, of any length
  Xyz x;         ///< the same place in space
  Xyz tangent;   ///< unit, along the border
};

/// The largest |normal curvature| at the distance d from the border, right across it: a place that geometry alone
/// names, where Su and Sv span the tangent plane also if one of them vanishes all along the border. Where no such place
/// is found (the parameters end, or meet in a pole) that on the border.
double curvature_beside(const SurfaceProbe& probe, const BesidePlace& at, double d);

}  // namespace geovor
