#include "voronoi/vertex_solver.h"

#include <algorithm>
#include <cmath>

#include "voronoi/equidistant_step.h"

namespace geovor {
namespace {

// Three or four steps from a guess within a tenth of the radius; the rest is for wide triangles on curved places.
constexpr int kMaxIterations = 20;

// A step longer than this part of the radius leaves the place where the linear conditions mean anything.
constexpr double kLongestStep = 0.5;

double mismatch(const std::array<SiteRay, 3>& r) {
  return std::max({(r[0].x - r[1].x).norm(), (r[1].x - r[2].x).norm(), (r[2].x - r[0].x).norm()});
}

}  // namespace

std::optional<std::array<SiteRay, 3>> solve_vertex(const SiteRays& rays, const std::array<PolarGuess, 3>& guess,
                                                   double radius) {
  std::array<PolarGuess, 3> g = guess;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    std::array<SiteRay, 3> r;
    for (int i = 0; i < 3; ++i) {
      const auto ray = rays.at(g[i].site, {radius, g[i].angle});
      if (!ray) return std::nullopt;
      r[i] = *ray;
    }
    if (mismatch(r) <= kVertexTolerance * radius) return r;
    EquidistantStep step(r[0]);
    for (const SiteRay& ray : r) step.add_ray(ray);
    const EquidistantTarget target = step.solve();
    if (!target.solvable) return std::nullopt;
    const double length = std::max((target.m - r[0].x).norm(), std::abs(target.radius - radius));
    const double k = std::min(1.0, kLongestStep * radius / length);
    for (int i = 0; i < 3; ++i) g[i].angle += k * (carry(r[i], target.m).t - r[i].polar.t);
    radius += k * (target.radius - radius);
  }
  return std::nullopt;
}

}  // namespace geovor
