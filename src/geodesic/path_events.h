// What a path meets, found in its steps.
#pragma once

#include <vector>

#include "geodesic/path.h"

namespace geovor {

/// The state on the leg at arc length s of the path, in the leg's own coordinates.
GeodesicVector state_on(const Surface& surface, const PathLeg& leg, double s);

/// The surface's parameters of the state x on the leg.
Uv point_on(const Surface& surface, const PathLeg& leg, const GeodesicVector& x);

SpaceState space_state(const Surface& surface, const PathLeg& leg, double s);

/// The arc length at which y changes its sign on the leg; negative if it does not.
double conjugate_point_on(const Surface& surface, const PathLeg& leg);

/// All events of a traced path but its end, by ascending s. A line within `touch` (a length in space) is touched.
std::vector<PathEvent> find_events(const Surface& surface, const PathRecord& record, double touch);

}  // namespace geovor
