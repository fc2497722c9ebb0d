#include "voronoi/path_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "geodesic/trace.h"
#include "surface/forms.h"
#include "voronoi/site_ray.h"

namespace geovor {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// Points of a path that are looked at: enough to notice a path that leaves by a percent of its length.
constexpr int kPathSamples = 24;

// Directions of neighbouring paths from a site (radians): what hides between two is narrower than a thirtieth of its
// distance from the site. Stored points further apart than this are all looked at.
constexpr double kSwing = 0.03;

// An excursion that stays this near to the border, as a part of the path's length, is none: the chords between the
// samples sag by as much, and going round it lengthens the path by less than its square. So a path whose end lies on
// the border, or beyond it by rounding, has not left.
constexpr double kShallow = 5e-4;

// Of the integrator: far below what is shallow.
constexpr double kPathTolerance = 1e-7;

std::vector<Uv> places_of_sites(const VoronoiDiagram& diagram) {
  std::vector<Uv> sites;
  for (const DiagramSite& s : diagram.sites) sites.push_back(s.uv);
  return sites;
}

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

/// Follows the geodesics from the sites and keeps, for each site, the first place found where one leaves the face.
class PathWatch {
 public:
  PathWatch(const FaceDomain& domain, const std::vector<Uv>& sites)
      : domain_(domain), rays_(domain.surface(), sites), exits_(sites.size()) {}

  /// The paths from the site on one side of the edge to the edge's points.
  void look_along(const DiagramEdge& e, bool left);
  /// The paths from the site to a stretch of the face's border: the first is found from `guess` or, without one, anew.
  void look_along(int site, const CellPiece& border, std::optional<Polar> guess);

  const std::vector<std::optional<Uv>>& exits() const { return exits_; }

 private:
  void look(int site, Polar to);
  const FaceDomain& domain_;
  SiteRays rays_;
  std::vector<std::optional<Uv>> exits_;
};

void PathWatch::look(int site, Polar to) {
  TraceOptions options;
  options.stop_at_domain = false;
  options.tolerance = kPathTolerance;
  const Surface& surface = domain_.surface();
  const Uv start = rays_.site(site);
  const UvVec direction = direction_at_angle(first_form(surface.jet(start)), to.t);
  std::vector<Uv> path;
  for (const auto& state : sample_geodesic(surface, start, direction, to.s, kPathSamples, options)) {
    path.push_back(state.p);
  }
  const auto exit = domain_.first_exit(path, std::max(domain_.deflection(), kShallow * to.s));
  if (exit) exits_[site] = domain_.to_principal(exit->out.uv);
}

void PathWatch::look_along(const DiagramEdge& e, bool left) {
  const int site = left ? e.left : e.right;
  std::optional<double> last;
  for (size_t i = 0; i < e.points.size() && !exits_[site]; ++i) {
    const EdgePoint& p = e.points[i];
    const double angle = left ? p.left_angle : p.right_angle;
    if (last && i + 1 < e.points.size() && std::abs(wrap_angle(angle - *last)) < kSwing) continue;
    last = angle;
    look(site, {p.radius, angle});
  }
}

// From one place to the next the geodesic is carried on; where that fails it is found anew.
void PathWatch::look_along(int site, const CellPiece& border, std::optional<Polar> guess) {
  std::optional<SiteRay> last;
  for (size_t i = 0; i < border.border_uv.size() && !exits_[site]; ++i) {
    if (last) {
      guess = carry(*last, border.border_xyz[i]);
      if (i + 1 < border.border_uv.size() && std::abs(wrap_angle(guess->t - last->polar.t)) < kSwing) continue;
    }
    auto ray = rays_.roughly_to(site, border.border_uv[i], guess);
    if (!ray && guess) ray = rays_.roughly_to(site, border.border_uv[i]);
    if (!ray) continue;
    look(site, ray->polar);
    last = ray;
  }
}

/// The ray from the cell's site by which a stretch of border starts at its vertex: the vertex's first generator owns
/// the border that leaves it.
std::optional<Polar> ray_at_start(const VoronoiDiagram& d, int site, const CellPiece& piece) {
  if (piece.from_vertex < 0) return std::nullopt;
  const DiagramVertex& v = d.vertices[piece.from_vertex];
  if (v.sites.front() != site) return std::nullopt;
  return Polar{v.radius, v.angles.front()};
}

}  // namespace

void recompute_residuals(const Surface& surface, VoronoiDiagram& diagram) {
  const std::vector<Uv> sites = places_of_sites(diagram);
  const SiteRays rays(surface, sites);
  for (DiagramEdge& e : diagram.edges) e.residual = edge_residual(rays, e);
  for (DiagramVertex& v : diagram.vertices) v.residual = vertex_residual(rays, v);
}

// Cells are stars: the paths to a cell's inner points are parts of those to its edges and to its stretches of border.
void warn_of_paths_that_leave(const FaceDomain& domain, VoronoiDiagram& diagram) {
  const std::vector<Uv> sites = places_of_sites(diagram);
  PathWatch watch(domain, sites);
  for (const DiagramEdge& e : diagram.edges) {
    watch.look_along(e, true);
    watch.look_along(e, false);
  }
  for (const DiagramCell& cell : diagram.cells) {
    for (const auto& loop : cell.loops) {
      for (const CellPiece& piece : loop) {
        if (piece.edge < 0) watch.look_along(cell.site, piece, ray_at_start(diagram, cell.site, piece));
      }
    }
  }
  for (int site = 0; site < static_cast<int>(sites.size()); ++site) {
    if (!watch.exits()[site]) continue;
    diagram.warnings.push_back(
        {"path_leaves_face",
         {site},
         *watch.exits()[site],
         "the shortest path from this site to a part of its cell leaves the face here; distances "
         "are those of the surface without its trims"});
  }
}

}  // namespace geovor
