#include "voronoi/cell_charts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "numeric/worst_of.h"
#include "voronoi/border_walk.h"
#include "voronoi/sites.h"

namespace geovor {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Directions of the trapezoidal rule around a site whose cell is a whole closed surface.
constexpr int kAllAround = 64;

// The way in which a conjugate point of such a site is looked for, in sizes of the surface.
constexpr double kFarthest = 8.0;

// Loops around holes turn by zero about a site inside the face, and back about one on a hole's border; loops around
// the cell by more than this.
constexpr double kNoTurn = 1e-3;

// A conjugate point at the very end of a ray to a free end of a cut locus is no conjugate point inside.
constexpr double kInside = 1.0 - 1e-6;

class Charter {
 public:
  Charter(const FaceDomain& domain, const VoronoiDiagram& diagram)
      : surface_(domain.surface()),
        diagram_(diagram),
        sites_(places_of_sites(diagram)),
        rays_(surface_, sites_),
        border_(domain) {}

  DiagramCharts charts();

 private:
  CellChart chart(const DiagramCell& cell, const std::vector<EdgeWalk>& edges) const;
  Polar add_loop(int site, const std::vector<CellPiece>& loop, const std::vector<EdgeWalk>& edges,
                 CellChart& out) const;
  void add_piece(const ChartPiece& seen, CellChart& out) const;
  void look_for_conjugate_point(int site, Polar to, CellChart& out) const;
  void add_whole_surface(int site, CellChart& out) const;

  const Surface& surface_;
  const VoronoiDiagram& diagram_;
  std::vector<Uv> sites_;
  SiteRays rays_;
  FaceBorder border_;
};

void Charter::add_piece(const ChartPiece& seen, CellChart& out) const {
  out.found = out.found && seen.found;
  out.area += seen.area;
  out.turn += seen.turn;
  out.least_y = smaller_of(out.least_y, seen.least_y);
  out.hidden = larger_of(out.hidden, seen.hidden);
  if (seen.shortest > 0.0) out.nearest = out.nearest > 0.0 ? smaller_of(out.nearest, seen.shortest) : seen.shortest;
}

/// The polar coordinates of one of the loop's places.
Polar Charter::add_loop(int site, const std::vector<CellPiece>& loop, const std::vector<EdgeWalk>& edges,
                        CellChart& out) const {
  std::vector<ChartPiece> pieces;
  const double before = out.area;
  for (const CellPiece& piece : loop) {
    if (piece.edge >= 0) {
      pieces.push_back(edges[piece.edge].seen[piece.reversed ? 1 : 0]);
      out.back = larger_of(out.back, pieces.back().back);
    } else {
      const BorderWalk walk = walk_border(rays_, border_, diagram_, site, piece);
      pieces.push_back(walk.seen);
      out.corner_gap = larger_of(out.corner_gap, walk.arrival_gap);
    }
    add_piece(pieces.back(), out);
  }
  out.loop_areas.push_back(out.area - before);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Polar &a = pieces[i].last, &b = pieces[(i + 1) % pieces.size()].first;
    if (a.s == 0.0 || b.s == 0.0) continue;  // the site itself is the corner
    const double turn = wrap_angle(b.t - a.t);
    out.turn += turn;
    out.corner_gap = larger_of(out.corner_gap, std::hypot(turn * pieces[i].last_y, b.s - a.s) / a.s);
  }
  for (const ChartPiece& piece : pieces)
    if (piece.middle.s > 0.0) return piece.middle;
  return {};
}

void Charter::look_for_conjugate_point(int site, Polar to, CellChart& out) const {
  out.found = out.found && to.s > 0.0;
  if (!out.found) return;
  TraceOptions options;
  options.stop_at_domain = false;
  const auto conjugate = first_conjugate_point(surface_, sites_[site], to.t, kInside * to.s, options);
  if (conjugate) out.conjugate_at = conjugate->s / to.s;
}

CellChart Charter::chart(const DiagramCell& cell, const std::vector<EdgeWalk>& edges) const {
  CellChart out;
  out.found = true;
  Polar of_outer;  // the loop that goes around the cell has the largest area
  for (const auto& loop : cell.loops) {
    const Polar place = add_loop(cell.site, loop, edges, out);
    if (out.loop_areas.back() == *std::max_element(out.loop_areas.begin(), out.loop_areas.end())) of_outer = place;
  }
  if (diagram_.sites.size() == 1 && diagram_.edges.empty() && !(out.turn > kNoTurn)) {
    add_whole_surface(cell.site, out);
  } else if (cell.loops.empty()) {
    out.found = false;
  } else {
    look_for_conjugate_point(cell.site, of_outer, out);
  }
  if (!out.found) out.area = kNaN;
  return out;
}

// All rays meet again in their conjugate point, else there would be a cut locus with edges.
void Charter::add_whole_surface(int site, CellChart& out) const {
  const Uv start = sites_[site];
  const UvBox box = surface_.domain();
  const double size =
      (surface_.position({box.u.lo, box.v.lo}) - surface_.position({box.u.middle(), box.v.middle()})).norm() +
      (surface_.position({box.u.middle(), box.v.lo}) - surface_.position({box.u.middle(), box.v.hi})).norm();
  out.found = out.found && std::isfinite(size);
  std::optional<RayEnd> first;
  for (int k = 0; k < kAllAround && out.found; ++k) {
    const double t = kTwoPi * k / kAllAround;
    const auto end = first_conjugate_point(surface_, start, t, kFarthest * size);
    const RayEnd ray =
        end ? trace_ray(surface_, start, {end->s, t}, rays_.curvature_map(), RayParts::WithSector) : RayEnd{};
    out.found = ray.found;
    out.area += ray.sector * kTwoPi / kAllAround;
    if (!ray.found) return;
    if (!first) first = ray, out.antipode = end;
    out.corner_gap = larger_of(out.corner_gap, (ray.x - first->x).norm() / end->s);
    out.nearest = out.nearest > 0.0 ? smaller_of(out.nearest, end->s) : end->s;
  }
  out.turn += kTwoPi;
}

DiagramCharts Charter::charts() {
  DiagramCharts out;
  for (int e = 0; e < static_cast<int>(diagram_.edges.size()); ++e)
    out.edges.push_back(walk_edge(surface_, rays_.curvature_map(), diagram_, e));
  for (const DiagramCell& cell : diagram_.cells) out.cells.push_back(chart(cell, out.edges));
  return out;
}

}  // namespace

DiagramCharts chart_cells(const FaceDomain& domain, const VoronoiDiagram& diagram) {
  return Charter(domain, diagram).charts();
}

}  // namespace geovor
