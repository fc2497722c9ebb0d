// The poles of B-spline surfaces.
#pragma once

#include "surface/bspline_surface.h"
#include "surface/pole_chart.h"

namespace geovor {

/// A chart for each side whose poles are one point, to rounding, and at which the surface has a tangent plane and one
/// second form. Knot lines that run into the pole stay in the chart: there its third derivatives may jump.
PoleCharts spline_poles(const BSplineSurface& surface);

}  // namespace geovor
