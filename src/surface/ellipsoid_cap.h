// The poles of an ellipsoid, and of a sphere, in closed form.
#pragma once

#include "surface/pole_chart.h"

namespace geovor {

/// Both poles of (a cos u cos v, b sin u cos v, c sin v) in the coordinates of `placement`, u in [0, 2 pi], the poles
/// at v = -pi/2 and pi/2.
PoleCharts ellipsoid_poles(const Frame& placement, double a, double b, double c);

}  // namespace geovor
