#include "voronoi/dual.h"

#include <algorithm>
#include <optional>
#include <set>

#include "geodesic/distance.h"
#include "surface/forms.h"
#include "voronoi/site_ray.h"

namespace geovor {
namespace {

// Pieces of a stored path: for pictures.
constexpr int kPathPieces = 16;

std::string number(int i) { return std::to_string(i); }

// Where the edge is nearest to its sites the two geodesics to it run into one another: the start of the search.
Polar guess_across(const DiagramEdge& e) {
  const auto nearest = std::min_element(e.points.begin(), e.points.end(),
                                        [](const auto& a, const auto& b) { return a.radius < b.radius; });
  return {2.0 * nearest->radius, nearest->left_angle};
}

// `finder` is made by the first edge that needs it: most diagrams have none.
DualEdge join(const SiteRays& rays, const DiagramEdge& e, std::optional<DistanceFinder>& finder) {
  DualEdge dual{e.left, e.right, 0.0, {}, {}};
  Polar polar;
  if (const auto ray = rays.to(e.left, rays.site(e.right), guess_across(e))) {
    polar = ray->polar;
  } else {
    if (!finder) finder.emplace(rays.surface());
    const Connection c = finder->distance(rays.site(e.left), rays.site(e.right)).shortest;
    polar = {c.length, c.angle};
  }
  dual.length = polar.s;
  const SurfaceJet j = rays.surface().jet(rays.site(e.left));
  TraceOptions options;
  options.stop_at_domain = false;
  for (const auto& state : sample_geodesic(rays.surface(), rays.site(e.left), direction_at_angle(j, polar.t), polar.s,
                                           kPathPieces, options)) {
    dual.path_uv.push_back(state.p);
    dual.path.push_back(rays.surface().position(state.p));
  }
  return dual;
}

// Around a vertex inside the face the generators form a polygon; on the border it stays open, which gives the same fan.
void add_fan(const DiagramVertex& v, std::vector<std::array<int, 3>>& triangles) {
  for (size_t i = 1; i + 1 < v.sites.size(); ++i) {
    const std::array<int, 3> t = {v.sites[0], v.sites[i], v.sites[i + 1]};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
  }
}

std::string why_no_triangulation(const VoronoiDiagram& diagram, const DualGraph& dual) {
  if (diagram.sites.size() < 3) return "there are fewer than three sites";
  for (const DiagramWarning& w : diagram.warnings) {
    if (w.kind == "unresolved") return "a part of the diagram is unresolved";
  }
  for (const DiagramEdge& e : diagram.edges) {
    if (e.kind == EdgeKind::CutLocus) return "the cell of site " + number(e.left) + " meets itself";
    if (e.closed()) return "sites " + number(e.left) + " and " + number(e.right) + " meet in a closed edge";
  }
  for (const DiagramCell& cell : diagram.cells) {
    if (cell.loops.size() != 1) return "the cell of site " + number(cell.site) + " is no disk";
  }
  std::set<std::pair<int, int>> pairs;
  for (const DualEdge& e : dual.edges) {
    const auto [lo, hi] = std::minmax(e.a, e.b);
    if (!pairs.insert({lo, hi}).second) {
      return "the cells of sites " + number(lo) + " and " + number(hi) + " meet more than once";
    }
  }
  return dual.triangles.empty() ? "no three cells meet" : "";
}

}  // namespace

DualGraph dual_of(const Surface& surface, const VoronoiDiagram& diagram) {
  std::vector<Uv> sites;
  for (const DiagramSite& s : diagram.sites) sites.push_back(s.uv);
  const SiteRays rays(surface, sites);
  DualGraph dual;
  std::optional<DistanceFinder> finder;
  for (const DiagramEdge& e : diagram.edges) {
    if (e.kind == EdgeKind::Bisector) dual.edges.push_back(join(rays, e, finder));
  }
  for (const DiagramVertex& v : diagram.vertices) add_fan(v, dual.triangles);
  dual.why_not = why_no_triangulation(diagram, dual);
  dual.is_triangulation = dual.why_not.empty();
  return dual;
}

}  // namespace geovor
