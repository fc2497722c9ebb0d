// Lines on a surface as the curves that CAD programs know.
#pragma once

#include "brep/cad_sheet.h"
#include "surface/surface.h"

namespace geovor {

/// A B-spline of the parameter plane and one of space with the same parameter.
struct SurfaceCurve {
  CadPcurve pcurve;
  CadCurve curve;
};

struct SplineFit {
  double deviation = 0.0;  ///< how far the p-curve may lie from the smooth curve through the points, in space
  double gap = 0.0;        ///< how far the curve may lie from the p-curve's image, at the same parameter
};

/// Cubic splines through a dense polyline on the surface, C1 where the polyline turns little. `uv` runs on across
/// seams; its ends are kept to the last digit. The curve through the points is the cubic one with the tangents of the
/// parabolas through three neighbours, and the polyline itself where the two differ by more than `deviation`.
/// REQUIRES: at least two points, successive ones distinct in space.
SurfaceCurve spline_on_surface(const Surface& surface, const std::vector<Uv>& uv, const std::vector<Xyz>& xyz,
                               const SplineFit& fit);

}  // namespace geovor
