// Geodesics of the sphere: great circles. A pole is a point like any other.
#pragma once

#include <vector>

#include "geodesic/connect.h"
#include "surface/elementary_surfaces.h"

namespace geovor {

/// trace_geodesic on the sphere. u goes on over the seam, by half a turn for every half circle.
TraceResult trace_sphere(const Sphere& sphere, Uv start, UvVec direction, double length);

/// The shorter arc of the great circle through both points and the longer one, which leaves the other way. Where the
/// points are equal or opposite any direction will do, and `fallback_angle` is taken.
std::vector<Connection> connect_sphere(const Sphere& sphere, Uv from, Uv to, double fallback_angle);

}  // namespace geovor
