// Poles of surfaces made from other surfaces: the same map under other parameters, and at a constant distance.
#pragma once

#include "surface/offset_surface.h"
#include "surface/pole_chart.h"
#include "surface/reparameterize.h"

namespace geovor {

/// The poles of the base, told in the new parameters. Where these turn the normal round, the charts turn with it.
PoleCharts reparameterized_poles(const Reparameterized& surface);

/// The poles of the basis, moved along their normals. None where the distance reaches a centre of curvature.
PoleCharts offset_poles(const OffsetSurface& surface);

}  // namespace geovor
