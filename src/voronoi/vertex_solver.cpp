#include "voronoi/vertex_solver.h"

namespace geovor {

std::optional<std::array<SiteRay, 3>> solve_vertex(const SiteRays& rays, const std::array<PolarGuess, 3>& guess,
                                                   double radius, double miss) {
  const auto found = find_equidistant(rays, guess, radius, nullptr, miss);
  if (!found) return std::nullopt;
  return found->rays;
}

}  // namespace geovor
