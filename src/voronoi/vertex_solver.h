// Points with the same geodesic distance to three generators.
#pragma once

#include <array>
#include <optional>

#include "voronoi/site_ray.h"

namespace geovor {

/// Bound on the mismatch of the three ends of a solved vertex, relative to its radius.
inline constexpr double kVertexTolerance = 2e-12;

/// A site with polar coordinates as the start of an iteration.
struct PolarGuess {
  int site;
  double angle;
};

/// The point O_i(rho, t_i), i = 1..3, near the guess, by Newton's method: rho' = rho + <T_i, m - x_i> for all three,
/// then t_i += <N_i, m - x_i> / y_i. The rays come in the order given. Nothing where the iteration does not settle.
std::optional<std::array<SiteRay, 3>> solve_vertex(const SiteRays& rays, const std::array<PolarGuess, 3>& guess,
                                                   double radius);

}  // namespace geovor
