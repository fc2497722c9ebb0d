#include "voronoi/cell_charts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geodesic/offset.h"
#include "voronoi/border_walk.h"

namespace geovor {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Directions of the trapezoidal rule around a site whose cell is a whole closed surface.
constexpr int kAllAround = 64;

// The way in which a conjugate point of such a site is looked for, in sizes of the surface.
constexpr double kFarthest = 8.0;

// A conjugate point at the very end of a ray to a free end of a cut locus is no conjugate point inside.
constexpr double kInside = 1.0 - 1e-6;

class Charter {
 public:
  Charter(const FaceDomain& domain, const VoronoiDiagram& diagram)
      : surface_(domain.surface()),
        diagram_(diagram),
        sites_(places(diagram)),
        rays_(surface_, sites_),
        border_(domain) {}

  DiagramCharts charts();

 private:
  static std::vector<Uv> places(const VoronoiDiagram& diagram) {
    std::vector<Uv> sites;
    for (const DiagramSite& s : diagram.sites) sites.push_back(s.uv);
    return sites;
  }
  CellChart chart(const DiagramCell& cell, const std::vector<EdgeWalk>& edges) const;
  void add_loop(int site, const std::vector<CellPiece>& loop, const std::vector<EdgeWalk>& edges, CellChart& out) const;
  void add_piece(const ChartPiece& seen, CellChart& out) const;
  void look_for_conjugate_points(const DiagramCell& cell, CellChart& out) const;
  CellChart whole_surface(int site) const;

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
  out.least_y = std::min(out.least_y, seen.least_y);
  if (seen.shortest > 0.0) out.nearest = out.nearest > 0.0 ? std::min(out.nearest, seen.shortest) : seen.shortest;
}

void Charter::add_loop(int site, const std::vector<CellPiece>& loop, const std::vector<EdgeWalk>& edges,
                       CellChart& out) const {
  std::vector<ChartPiece> pieces;
  const double before = out.area;
  for (const CellPiece& piece : loop) {
    if (piece.edge >= 0) {
      pieces.push_back(edges[piece.edge].seen[piece.reversed ? 1 : 0]);
      out.back = std::max(out.back, pieces.back().back);
    } else {
      const BorderWalk walk = walk_border(rays_, border_, diagram_, site, piece);
      pieces.push_back(walk.seen);
      out.corner_gap = std::max(out.corner_gap, walk.arrival_gap);
    }
    add_piece(pieces.back(), out);
  }
  out.loop_areas.push_back(out.area - before);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Polar &a = pieces[i].last, &b = pieces[(i + 1) % pieces.size()].first;
    if (!(a.s > 0.0 && b.s > 0.0)) continue;  // the site itself is the corner
    const double turn = wrap_angle(b.t - a.t);
    out.turn += turn;
    out.corner_gap = std::max(out.corner_gap, std::hypot(turn * pieces[i].last_y, b.s - a.s) / a.s);
  }
}

void Charter::look_for_conjugate_points(const DiagramCell& cell, CellChart& out) const {
  const CellPiece& piece = cell.loops.front().front();
  Polar to;
  if (piece.edge >= 0) {
    const auto& points = diagram_.edges[piece.edge].points;
    const EdgePoint& p = points[points.size() / 2];
    to = {p.radius, piece.reversed ? p.right_angle : p.left_angle};
  } else if (const auto ray = rays_.to(cell.site, piece.border_uv[piece.border_uv.size() / 2])) {
    to = ray->polar;
  }
  if (!(to.s > 0.0)) return;
  TraceOptions options;
  options.stop_at_domain = false;
  const auto conjugate = first_conjugate_point(surface_, sites_[cell.site], to.t, kInside * to.s, options);
  if (conjugate) out.conjugate_at = conjugate->s / to.s;
}

CellChart Charter::chart(const DiagramCell& cell, const std::vector<EdgeWalk>& edges) const {
  if (cell.loops.empty()) return diagram_.sites.size() == 1 ? whole_surface(cell.site) : CellChart{};
  CellChart out;
  out.found = true;
  for (const auto& loop : cell.loops) add_loop(cell.site, loop, edges, out);
  look_for_conjugate_points(cell, out);
  if (!out.found) out.area = kNaN;
  return out;
}

// All rays meet again in their conjugate point, else there would be a cut locus with edges.
CellChart Charter::whole_surface(int site) const {
  CellChart out;
  const Uv start = sites_[site];
  const UvBox box = surface_.domain();
  const double size =
      (surface_.position({box.u.lo, box.v.lo}) - surface_.position({box.u.middle(), box.v.middle()})).norm() +
      (surface_.position({box.u.middle(), box.v.lo}) - surface_.position({box.u.middle(), box.v.hi})).norm();
  out.found = std::isfinite(size);
  for (int k = 0; k < kAllAround && out.found; ++k) {
    const double t = kTwoPi * k / kAllAround;
    const auto end = first_conjugate_point(surface_, start, t, kFarthest * size);
    const RayEnd ray =
        end ? trace_ray(surface_, start, {end->s, t}, rays_.curvature_map(), RayParts::WithSector) : RayEnd{};
    out.found = ray.found;
    out.area += ray.sector * kTwoPi / kAllAround;
    if (end) out.nearest = out.nearest > 0.0 ? std::min(out.nearest, end->s) : end->s;
  }
  out.turn = kTwoPi;
  if (!out.found) out.area = kNaN;
  return out;
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
