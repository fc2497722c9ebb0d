#include "voronoi/path_checks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "geodesic/trace.h"
#include "surface/forms.h"
#include "voronoi/border_view.h"
#include "voronoi/site_ray.h"
#include "voronoi/sites.h"

namespace geovor {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// Points of a path that are looked at: enough to notice a path that leaves by a percent of its length.
constexpr int kPathSamples = 24;

// Paths that are looked at to places on one hidden run of the border, spread over it, the last one among them.
constexpr int kPathsOfRun = 8;

// An excursion that stays this near to the border, as a part of the path's length, is none: the chords between the
// samples sag by as much, and going round it lengthens the path by less than its square. So a path whose end lies on
// the border, or beyond it by rounding, has not left.
constexpr double kShallow = 5e-4;

// Of the integrator: far below what is shallow.
constexpr double kPathTolerance = 1e-7;

double distance_anew(const SiteRays& rays, int site, Uv m, Polar guess) {
  const auto ray = rays.to(site, m, guess);
  return ray ? ray->polar.s : kInf;
}

double relative_spread(double lo, double hi) {
  const double spread = (hi - lo) / lo;
  return std::isfinite(spread) ? spread : kInf;
}

// The free end of a cut locus has one geodesic, which can't differ from itself; and its end is conjugate to the site,
// so that Newton's method for a geodesic to that place has nothing to divide by.
double edge_residual(const SiteRays& rays, const DiagramEdge& e) {
  double worst = 0.0;
  for (const EdgePoint& p : e.points) {
    if (e.left == e.right && p.left_angle == p.right_angle) continue;
    const double a = distance_anew(rays, e.left, p.uv, {p.radius, p.left_angle});
    const double b = distance_anew(rays, e.right, p.uv, {p.radius, p.right_angle});
    worst = std::max(worst, relative_spread(std::min(a, b), std::max(a, b)));
  }
  return worst;
}

double vertex_residual(const SiteRays& rays, const DiagramVertex& v) {
  if (v.sites.size() == 1) return 0.0;
  double lo = kInf, hi = 0.0;
  for (size_t i = 0; i < v.sites.size(); ++i) {
    const double d = distance_anew(rays, v.sites[i], v.uv, {v.radius, v.angles[i]});
    lo = std::min(lo, d), hi = std::max(hi, d);
  }
  return relative_spread(lo, hi);
}

/// Where a path leaves the face and where it comes back, and what part of its length it spends outside.
struct Excursion {
  Uv out, back;
  double part = 0.0;
};

/// The first excursion of the site's ray with these polar coordinates, which ends on the border.
std::optional<Excursion> excursion(const FaceDomain& domain, Uv site, const BorderView::Place& to) {
  TraceOptions options;
  options.stop_at_domain = false;
  options.tolerance = kPathTolerance;
  const Surface& surface = domain.surface();
  const UvVec direction = direction_at_angle(surface.jet(site), to.polar.t);
  std::vector<Uv> path;
  for (const auto& state : sample_geodesic(surface, site, direction, to.polar.s, kPathSamples, options)) {
    path.push_back(state.p);
  }
  const auto exit = domain.first_exit(path, std::max(domain.deflection(), kShallow * to.polar.s));
  if (!exit) return std::nullopt;
  const double n = static_cast<double>(path.size()) - 1.0;
  const double left_at = exit->out.segment + exit->out.k;
  const double back_at = exit->back ? exit->back->segment + exit->back->k : n;
  return Excursion{domain.to_principal(exit->out.uv), exit->back ? domain.to_principal(exit->back->uv) : to.uv,
                   (back_at - left_at) / n};
}

/// Of the paths to the run's places, the longest excursion.
std::optional<Excursion> longest_excursion(const FaceDomain& domain, Uv site, const BorderView& view, HiddenRun run) {
  std::optional<Excursion> longest;
  const int count = std::min(kPathsOfRun, run.last - run.first);
  for (int i = 1; i <= count; ++i) {
    const auto found = excursion(domain, site, view.places[run.first + (run.last - run.first) * i / count]);
    if (found && (!longest || found->part > longest->part)) longest = found;
  }
  return longest;
}

DiagramWarning leaves_face(int site, const Excursion& e) {
  char back[64];
  std::snprintf(back, sizeof back, "(%.6g, %.6g)", e.back.u, e.back.v);
  return {"path_leaves_face",
          {site},
          e.out,
          std::string("the shortest path from this site to a part of its cell leaves the face here and comes back at "
                      "(u, v) = ") +
              back + "; distances are those of the surface without its trims"};
}

// A cell is a star of the continued surface. A path to a point of it that leaves the face comes back, before that
// point, through a piece of border that belongs to the cell as well and turns its back on the site: along it, with the
// face to the left, the angle falls. So the cell's stretches of border tell all, and cells inside the face cost
// nothing.
void warn_of_piece(const FaceDomain& domain, const SiteRays& rays, const VoronoiDiagram& diagram, int site,
                   const CellPiece& piece, std::vector<DiagramWarning>& warnings) {
  BorderView view = view_of_border(rays, diagram, site, piece);
  if (piece.from_vertex == piece.to_vertex) begin_in_front(view);
  if (!view.complete) {
    warnings.push_back({"unresolved",
                        {site},
                        piece.border_uv.front(),
                        "to a part of the border that starts here no geodesic was found: whether paths to it leave the "
                        "face is not known"});
  }
  for (const HiddenRun run : hidden_runs(view, domain.deflection())) {
    const auto found = longest_excursion(domain, rays.site(site), view, run);
    if (found) warnings.push_back(leaves_face(site, *found));
  }
}

void warn_of_cell(const FaceDomain& domain, const SiteRays& rays, const VoronoiDiagram& diagram,
                  const DiagramCell& cell, std::vector<DiagramWarning>& warnings) {
  for (const auto& loop : cell.loops)
    for (const CellPiece& piece : loop)
      if (piece.edge < 0) warn_of_piece(domain, rays, diagram, cell.site, piece, warnings);
}

}  // namespace

void recompute_residuals(const Surface& surface, VoronoiDiagram& diagram) {
  const std::vector<Uv> sites = places_of_sites(diagram);
  const SiteRays rays(surface, sites);
  for (DiagramEdge& e : diagram.edges) e.residual = edge_residual(rays, e);
  for (DiagramVertex& v : diagram.vertices) v.residual = vertex_residual(rays, v);
}

void warn_of_paths_that_leave(const FaceDomain& domain, VoronoiDiagram& diagram) {
  const std::vector<Uv> sites = places_of_sites(diagram);
  const SiteRays rays(domain.surface(), sites);
  std::vector<DiagramWarning> warnings;
  for (const DiagramCell& cell : diagram.cells) warn_of_cell(domain, rays, diagram, cell, warnings);
  diagram.warnings.insert(diagram.warnings.end(), warnings.begin(), warnings.end());
}

std::vector<DiagramWarning> paths_that_leave(const FaceDomain& domain, const VoronoiDiagram& diagram, int site) {
  const std::vector<Uv> sites = places_of_sites(diagram);
  const SiteRays rays(domain.surface(), sites);
  std::vector<DiagramWarning> warnings;
  warn_of_cell(domain, rays, diagram, diagram.cells[site], warnings);
  std::erase_if(warnings, [](const DiagramWarning& w) { return w.kind != "path_leaves_face"; });
  return warnings;
}

}  // namespace geovor
