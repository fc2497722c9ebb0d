// Paths on the surfaces whose geodesics are known in closed form: their states in space and their events.
#pragma once

#include <vector>

#include "geodesic/path.h"

namespace geovor {

/// The state in space at arc length s of the path from `start` along `direction`, whose unit tangent in space is T.
/// Exact at a sphere's poles too, where the directions of the parameter plane end. REQUIRES: has_closed_form(surface)
SpaceState closed_form_at(const Surface& surface, Uv start, UvVec direction, const Xyz& T, double s);

/// All events of the path but its end, by ascending s. REQUIRES: has_closed_form(surface)
std::vector<PathEvent> closed_form_events(const Surface& surface, Uv start, UvVec direction, double length);

}  // namespace geovor
