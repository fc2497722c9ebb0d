#include "voronoi/vertex_table.h"

#include <algorithm>
#include <cmath>

namespace geovor {
namespace {

// At one vertex, two rays of the same site are one if their ends' angles agree to this; they come from different
// chains, each exact to kBisectorTolerance.
constexpr double kSameRay = 1e-4;

bool same_ray(const SiteRay& a, const SiteRay& b) {
  return a.site == b.site && std::abs(wrap_angle(a.polar.t - b.polar.t)) < kSameRay;
}

}  // namespace

int VertexTable::add(const std::vector<SiteRay>& rays, int spokes) {
  Vertex v;
  v.rays = rays;
  v.data.uv = domain_.to_principal(rays.front().uv);
  v.data.xyz = rays.front().x;
  for (const SiteRay& ray : rays) {
    v.data.radius += ray.polar.s / static_cast<double>(rays.size());
    v.data.sites.push_back(ray.site);
    v.data.angles.push_back(ray.polar.t);
  }
  v.data.spokes.resize(spokes);
  cells_[cell_of(v.data.xyz)].push_back(count());
  vertices_.push_back(std::move(v));
  return count() - 1;
}

VertexTable::Cell VertexTable::cell_of(const Xyz& x) const {
  return {std::lround(x[0] / merge_), std::lround(x[1] / merge_), std::lround(x[2] / merge_)};
}

// By number, so that the first made comes first.
std::vector<int> VertexTable::near(const Xyz& x) const {
  std::vector<int> found;
  const Cell c = cell_of(x);
  for (long i = c[0] - 1; i <= c[0] + 1; ++i) {
    for (long j = c[1] - 1; j <= c[1] + 1; ++j) {
      const auto first = cells_.lower_bound({i, j, c[2] - 1}), last = cells_.upper_bound({i, j, c[2] + 1});
      for (auto cell = first; cell != last; ++cell) {
        for (int v : cell->second) {
          if ((vertices_[v].data.xyz - x).norm() < merge_) found.push_back(v);
        }
      }
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::optional<SpokeRef> VertexTable::spoke_between(int vertex, const SiteRay& right, const SiteRay& left) const {
  const Vertex& v = vertices_[vertex];
  const int n = static_cast<int>(v.rays.size());
  for (int i = 0; i < static_cast<int>(v.data.spokes.size()); ++i) {
    if (same_ray(v.rays[i], right) && same_ray(v.rays[(i + 1) % n], left)) return SpokeRef{vertex, i};
  }
  return std::nullopt;
}

// Seen from the vertex the chain's left site is to the right.
std::optional<SpokeRef> VertexTable::arriving(const BisectorPoint& last) const {
  for (int i : near(last.position())) {
    if (const auto spoke = spoke_between(i, last.left, last.right)) return spoke;
  }
  return std::nullopt;
}

// Those of a vertex on the border have a first and a last.
std::optional<int> VertexTable::find(const std::vector<SiteRay>& generators, bool on_border) const {
  for (int i : near(generators.front().x)) {
    const Vertex& v = vertices_[i];
    if (v.data.on_boundary != on_border || v.rays.size() != generators.size()) continue;
    const auto last = on_border ? v.rays.begin() + 1 : v.rays.end();
    const auto first =
        std::find_if(v.rays.begin(), last, [&](const SiteRay& ray) { return same_ray(ray, generators.front()); });
    if (first == last) continue;
    std::vector<SiteRay> turned(first, v.rays.end());
    turned.insert(turned.end(), v.rays.begin(), first);
    if (std::equal(turned.begin(), turned.end(), generators.begin(), same_ray)) return i;
  }
  return std::nullopt;
}

int VertexTable::put_inside(const std::vector<SiteRay>& generators) {
  if (const auto known = find(generators, false)) return *known;
  return add(generators, static_cast<int>(generators.size()));
}

int VertexTable::put_on_border(BorderPlace place, const std::vector<SiteRay>& generators) {
  if (const auto known = find(generators, true)) return *known;
  const int made = add(generators, static_cast<int>(generators.size()) - 1);
  DiagramVertex& v = vertices_[made].data;
  v.on_boundary = true;
  v.border_cycle = place.cycle;
  v.border_parameter = place.parameter;
  return made;
}

SpokeRef VertexTable::arrive_at_free_end(const BisectorPoint& last) { return {add({last.left}, 1), 0}; }

BisectorPoint VertexTable::departure(SpokeRef s) const {
  const Vertex& v = vertices_[s.vertex];
  const int n = static_cast<int>(v.rays.size());
  return {v.rays[(s.spoke + 1) % n], v.rays[s.spoke]};
}

}  // namespace geovor
