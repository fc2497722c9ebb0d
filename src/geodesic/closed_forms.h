// Geodesics in closed form: straight lines where the metric is constant (plane, cylinder) and on the cone's
// development, great circles on the sphere. A cone's tip and a sphere's poles are points like any other.
#pragma once

#include <optional>

#include "geodesic/connect.h"

namespace geovor {

/// Whether the functions below know the surface.
bool has_closed_form(const Surface& surface);

/// trace_geodesic in closed form; nothing if the surface has none. The state's u goes on over the seam.
std::optional<TraceResult> trace_closed_form(const Surface& surface, Uv start, UvVec direction, double length);

/// connect in closed form. With a guess: the geodesic that ends nearest to the guess's end in the tangent plane at
/// `from` (which winding of a cylinder, which way round a sphere); without: the shortest.
std::optional<Connection> connect_closed_form(const Surface& surface, Uv from, Uv to, std::optional<Polar> guess);

/// The shortest geodesic, and the next one that winds the other way, by length.
std::optional<std::vector<Connection>> connections_closed_form(const Surface& surface, Uv from, Uv to);

/// All geodesics shorter than `limit`, by length, however often they wind round a cylinder or a cone; less than once
/// round a sphere. With an infinite limit those of connections_closed_form. REQUIRES: has_closed_form(surface)
std::vector<Connection> geodesics_closed_form(const Surface& surface, Uv from, Uv to, double limit);

}  // namespace geovor
