// The poles of a surface of revolution, where its meridian meets the axis at a right angle.
#pragma once

#include "surface/pole_chart.h"
#include "surface/swept_surfaces.h"

namespace geovor {

/// A chart for each end of the meridian that lies on the axis, to rounding, and meets it at a right angle; and two, one
/// for each side, where the meridian runs through the axis inside its domain (a whole circle of which a face uses an
/// arc). Such a pole is a line v = at inside the domain.
PoleCharts revolution_poles(const RevolutionSurface& surface);

}  // namespace geovor
