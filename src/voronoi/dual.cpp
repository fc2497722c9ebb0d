#include "voronoi/dual.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "geodesic/distance.h"
#include "surface/forms.h"
#include "voronoi/dual_checks.h"
#include "voronoi/site_ray.h"
#include "voronoi/sites.h"

namespace geovor {
namespace {

// Pieces of a drawn path.
constexpr int kPathPieces = 16;

// A geodesic that differs from the guess by more (parts of the length, radians) may be another one.
constexpr double kSameLength = 0.2;
constexpr double kSameAngle = 0.3;

// Steps from the edge to the site on its right.
constexpr int kMarch = 8;

/// Where the edge is nearest to its sites, from its stored points.
const EdgePoint& nearest_point(const DiagramEdge& e) {
  return *std::min_element(e.points.begin(), e.points.end(),
                           [](const EdgePoint& a, const EdgePoint& b) { return a.radius < b.radius; });
}

// Site a, the point x and site b form a triangle with two sides of length r and the angle theta between them at x. In
// the plane its base is 2 r sin(theta/2), and its angles at the base are (pi - theta)/2; cos(theta/2) is the slope of
// the radius (13). Where the edge is nearest to its sites of all the bisector, theta = pi and this is no guess.
Polar guess_across(const EdgePoint& x) {
  const double cosine = std::min(1.0, std::abs(x.radius_slope)), half = std::acos(cosine);
  const double turn = std::copysign(0.5 * std::numbers::pi - half, x.radius_slope * x.left_slope);
  return {2.0 * x.radius * std::sin(half), x.left_angle - turn};
}

// The end of the geodesic from site a runs from x along the geodesic to site b, a step at a time: what joins a and b
// then is the geodesic that passes the edge where x lies.
std::optional<SiteRay> march(const SiteRays& rays, const DiagramEdge& e, const EdgePoint& x) {
  auto ray = rays.at(e.left, {x.radius, x.left_angle});
  for (int k = 1; ray && k <= kMarch; ++k) {
    const double left = x.radius * (1.0 - static_cast<double>(k) / kMarch);
    const auto on = k < kMarch ? rays.at(e.right, {left, x.right_angle}) : std::nullopt;
    if (k < kMarch && !on) return std::nullopt;
    const Uv m = on ? on->uv : rays.site(e.right);
    ray = rays.to(e.left, m, carry(*ray, on ? on->x : rays.surface().position(m)));
  }
  return ray;
}

std::optional<Polar> geodesic_through(const SiteRays& rays, const DiagramEdge& e) {
  const EdgePoint& x = nearest_point(e);
  const Polar guess = guess_across(x);
  if (guess.s > 0.0) {
    const auto ray = rays.to(e.left, rays.site(e.right), guess);
    if (ray && std::abs(ray->polar.s - guess.s) <= kSameLength * guess.s &&
        std::abs(wrap_angle(ray->polar.t - guess.t)) <= kSameAngle) {
      return ray->polar;
    }
  }
  const auto ray = march(rays, e, x);
  return ray ? std::optional(ray->polar) : std::nullopt;
}

// `finder` is made by the first edge that needs it: most diagrams have none.
DualEdge join(const SiteRays& rays, const VoronoiDiagram& diagram, int edge, std::optional<DistanceFinder>& finder) {
  const DiagramEdge& e = diagram.edges[edge];
  if (const auto polar = geodesic_through(rays, e)) return {e.left, e.right, edge, polar->s, polar->t, true, {}, {}};
  if (!finder) finder.emplace(rays.surface());
  const Connection c = finder->distance(rays.site(e.left), rays.site(e.right)).shortest;
  return {e.left, e.right, edge, c.length, c.angle, false, {}, {}};
}

void draw(const SiteRays& rays, DualEdge& dual) {
  TraceOptions options;
  options.stop_at_domain = false;
  options.tolerance = kDrawnPath;
  const UvVec direction = direction_at_angle(rays.surface().jet(rays.site(dual.a)), dual.angle);
  for (const auto& state :
       sample_geodesic(rays.surface(), rays.site(dual.a), direction, dual.length, kPathPieces, options)) {
    dual.path_uv.push_back(state.p);
    dual.path.push_back(rays.surface().position(state.p));
  }
}

// Around a vertex inside the face the generators form a polygon; on the border it stays open, which gives the same fan.
void add_fan(const DiagramVertex& v, std::vector<std::array<int, 3>>& triangles) {
  for (size_t i = 1; i + 1 < v.sites.size(); ++i) {
    const std::array<int, 3> t = {v.sites[0], v.sites[i], v.sites[i + 1]};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
  }
}

}  // namespace

DualGraph dual_of(const Surface& surface, const VoronoiDiagram& diagram, DualPaths paths) {
  const std::vector<Uv> sites = places_of_sites(diagram);
  const SiteRays rays(surface, sites);
  DualGraph dual;
  std::optional<DistanceFinder> finder;
  for (int e = 0; e < static_cast<int>(diagram.edges.size()); ++e) {
    if (diagram.edges[e].kind != EdgeKind::Bisector) continue;
    dual.edges.push_back(join(rays, diagram, e, finder));
    if (paths == DualPaths::Drawn) draw(rays, dual.edges.back());
  }
  for (const DiagramVertex& v : diagram.vertices) add_fan(v, dual.triangles);
  dual.why_not = why_no_triangulation(diagram, dual);
  dual.is_triangulation = dual.why_not.empty();
  return dual;
}

}  // namespace geovor
