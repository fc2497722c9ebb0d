// Near geodesics without an integrator: the whole path at once, as a polynomial.
#pragma once

#include <optional>

#include "geodesic/shooting.h"

namespace geovor {

/// The geodesic near the straight line in the parameter plane, if the path stays on one analytic piece of the surface,
/// inside the domain, and is short in curvature radii: some jets a node instead of twelve a step. Nothing where any of
/// that fails, or where the last coefficients of the polynomial are not as small as the tolerance; then it has cost
/// little. The result's `evaluations` count this call alone.
std::optional<Connection> collocate(const Surface& surface, const Ends& ends, const ConnectOptions& options);

}  // namespace geovor
