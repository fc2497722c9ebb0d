// Geodesics of the cone: straight lines of its development, the plane sector into which it unrolls.
#pragma once

#include <vector>

#include "geodesic/connect.h"
#include "surface/elementary_surfaces.h"

namespace geovor {

/// trace_geodesic on the cone. A line through the tip stops there (DegenerateMetric): beyond it no direction is the
/// continuation.
TraceResult trace_cone(const Cone& cone, Uv start, UvVec direction, double length);

/// The geodesics from `from` to the copies of `to` whose u is nearest to `u` and next to it, the nearest first; those
/// that turn by less than pi in the development, where alone there is a line. The tip is a point like any other. Empty
/// where the two lie on different nappes.
std::vector<Connection> connect_cone(const Cone& cone, Uv from, Uv to, double u);

}  // namespace geovor
