// Geodesics as the curves that CAD programs know.
#pragma once

#include "brep/cad_curve.h"
#include "pipeline/surface_path.h"

namespace geovor {

/// The path as a B-spline of degree 5 whose parameter is the arc length: each piece has the path's points and unit
/// tangents at both its ends and in its middle, and the pieces are so short that the curve lies within `deviation` of
/// the path, point by point. C1; C0 at a crease. REQUIRES: the path has a length above 0.
CadCurve spline_of_path(const SurfacePath& path, double deviation);

}  // namespace geovor
