// Geodesics of the cone: straight lines of its development, the plane sector into which it unrolls.
#pragma once

#include <vector>

#include "geodesic/connect.h"
#include "surface/elementary_surfaces.h"

namespace geovor {

/// trace_geodesic on the cone. A line through the tip stops there (DegenerateMetric): beyond it no direction is the
/// continuation. From the tip it runs along the parameter line of `start.u`.
TraceResult trace_cone(const Cone& cone, Uv start, UvVec direction, double length);

/// The geodesics from `from` to the copies of `to` whose u is nearest to from.u + near and the next one that winds the
/// other way, the nearest first; those that turn by less than pi in the development, where alone there is a line. With
/// the tip at an end there is one, and its direction there is the one along the other end's parameter line. Empty
/// where the two lie on different nappes.
std::vector<Connection> connect_cone(const Cone& cone, Uv from, Uv to, double near);

}  // namespace geovor
