// Points with the same geodesic distance to three generators.
#pragma once

#include <array>
#include <optional>

#include "voronoi/equidistant_point.h"

namespace geovor {

/// Bound on the differences of the three distances of a solved vertex, relative to its radius.
inline constexpr double kVertexTolerance = 1e-12;

/// How far off a guess by hand is, as a part of the radius.
inline constexpr double kMissOfRoughGuess = 0.2;

/// The point O_i(rho, t_i), i = 1..3, near the guess, by Newton's method: rho' = rho + <T_i, m - x_i> for all three,
/// then t_i += <N_i, m - x_i> / y_i, both to second order. The rays come in the order given. `miss` is what the guess
/// is off by, as a part of the radius. Nothing where the iteration does not settle.
std::optional<std::array<SiteRay, 3>> solve_vertex(const SiteRays& rays, const std::array<PolarGuess, 3>& guess,
                                                   double radius, double miss = kMissOfRoughGuess);

}  // namespace geovor
