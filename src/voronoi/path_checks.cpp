#include "voronoi/path_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geodesic/trace.h"
#include "surface/forms.h"
#include "voronoi/site_ray.h"

namespace geovor {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// Points of a path that are looked at: enough to notice a path that leaves by a percent of its length.
constexpr int kPathSamples = 24;

double distance_anew(const SiteRays& rays, int site, Uv m, Polar guess) {
  const auto ray = rays.to(site, m, guess);
  return ray ? ray->polar.s : kInf;
}

double relative_spread(double lo, double hi) {
  const double spread = (hi - lo) / lo;
  return std::isfinite(spread) ? spread : kInf;
}

double edge_residual(const SiteRays& rays, const DiagramEdge& e) {
  double worst = 0.0;
  for (const EdgePoint& p : e.points) {
    const double a = distance_anew(rays, e.left, p.uv, {p.radius, p.left_angle});
    const double b = distance_anew(rays, e.right, p.uv, {p.radius, p.right_angle});
    worst = std::max(worst, relative_spread(std::min(a, b), std::max(a, b)));
  }
  return worst;
}

double vertex_residual(const SiteRays& rays, const DiagramVertex& v) {
  double lo = kInf, hi = 0.0;
  for (size_t i = 0; i < v.sites.size(); ++i) {
    const double d = distance_anew(rays, v.sites[i], v.uv, {v.radius, v.angles[i]});
    lo = std::min(lo, d), hi = std::max(hi, d);
  }
  return relative_spread(lo, hi);
}

/// The first place where the geodesic from the site leaves the face.
std::optional<Uv> exit_of_path(const FaceDomain& domain, Uv site, double angle, double length) {
  TraceOptions options;
  options.stop_at_domain = false;
  const UvVec direction = direction_at_angle(first_form(domain.surface().jet(site)), angle);
  std::vector<Uv> path;
  for (const auto& state : sample_geodesic(domain.surface(), site, direction, length, kPathSamples, options)) {
    path.push_back(state.p);
  }
  const auto exit = domain.first_exit(path);
  // The end itself may lie on the border, or beyond it by rounding.
  if (!exit || (domain.surface().position(exit->uv) - domain.surface().position(path.back())).norm() < 1e-6 * length) {
    return std::nullopt;
  }
  return domain.to_principal(exit->uv);
}

}  // namespace

void recompute_residuals(const Surface& surface, VoronoiDiagram& diagram) {
  std::vector<Uv> sites;
  for (const DiagramSite& s : diagram.sites) sites.push_back(s.uv);
  const SiteRays rays(surface, sites);
  for (DiagramEdge& e : diagram.edges) e.residual = edge_residual(rays, e);
  for (DiagramVertex& v : diagram.vertices) v.residual = vertex_residual(rays, v);
}

void warn_of_paths_that_leave(const FaceDomain& domain, VoronoiDiagram& diagram) {
  std::vector<char> warned(diagram.sites.size(), 0);
  const auto check = [&](int site, double angle, double length) {
    if (warned[site]) return;
    const auto exit = exit_of_path(domain, diagram.sites[site].uv, angle, length);
    if (!exit) return;
    warned[site] = 1;
    diagram.warnings.push_back(
        {"path_leaves_face",
         {site},
         *exit,
         "the shortest path from this site to a part of its cell leaves the face here; distances "
         "are those of the surface without its trims"});
  };
  for (const DiagramVertex& v : diagram.vertices) {
    for (size_t i = 0; i < v.sites.size(); ++i) check(v.sites[i], v.angles[i], v.radius);
  }
  for (const DiagramEdge& e : diagram.edges) {
    const EdgePoint& middle = e.points[e.points.size() / 2];
    check(e.left, middle.left_angle, middle.radius);
    check(e.right, middle.right_angle, middle.radius);
  }
}

}  // namespace geovor
