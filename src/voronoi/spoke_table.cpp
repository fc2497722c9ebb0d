#include "voronoi/spoke_table.h"

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

int SpokeTable::add(const std::vector<SiteRay>& rays, int spokes) {
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
  vertices_.push_back(std::move(v));
  return count() - 1;
}

std::optional<int> SpokeTable::spoke_between(const Vertex& v, const SiteRay& right, const SiteRay& left) const {
  const int n = static_cast<int>(v.rays.size());
  for (int i = 0; i < static_cast<int>(v.data.spokes.size()); ++i) {
    if (same_ray(v.rays[i], right) && same_ray(v.rays[(i + 1) % n], left)) return i;
  }
  return std::nullopt;
}

// Seen from the vertex the chain's left site is to the right.
std::optional<SpokeRef> SpokeTable::arrive_inside(const std::vector<SiteRay>& generators, const BisectorPoint& last) {
  for (int i = 0; i < count(); ++i) {
    const Vertex& v = vertices_[i];
    if (v.data.on_boundary || !((v.data.xyz - last.position()).norm() < merge_)) continue;
    if (const auto spoke = spoke_between(v, last.left, last.right)) return SpokeRef{i, *spoke};
  }
  const int made = add(generators, static_cast<int>(generators.size()));
  const auto spoke = spoke_between(vertices_[made], last.left, last.right);
  if (!spoke) return std::nullopt;
  return SpokeRef{made, *spoke};
}

std::optional<SpokeRef> SpokeTable::arrive_on_border(BorderPlace place, const BisectorPoint& last) {
  return start_on_border(place, {last.right, last.left});
}

void SpokeTable::ensure_inside(const std::vector<SiteRay>& generators) {
  const SiteRay &right = generators[0], &left = generators[1];
  for (const Vertex& v : vertices_) {
    if (v.data.on_boundary || !((v.data.xyz - right.x).norm() < merge_)) continue;
    if (spoke_between(v, right, left)) return;
  }
  add(generators, static_cast<int>(generators.size()));
}

// Several edges may end in one point of the border: each new one must share a generator with the first or the last of
// those that are there.
std::optional<SpokeRef> SpokeTable::extend_border_vertex(int i, const BisectorPoint& outwards) {
  Vertex& v = vertices_[i];
  if (const auto spoke = spoke_between(v, outwards.right, outwards.left)) return SpokeRef{i, *spoke};
  const auto insert = [&](int at, int spoke, const SiteRay& ray) {
    v.rays.insert(v.rays.begin() + at, ray);
    v.data.sites.insert(v.data.sites.begin() + at, ray.site);
    v.data.angles.insert(v.data.angles.begin() + at, ray.polar.t);
    v.data.spokes.insert(v.data.spokes.begin() + spoke, Spoke{});
  };
  const int n = static_cast<int>(v.rays.size());
  if (same_ray(v.rays.back(), outwards.right)) {
    insert(n, n - 1, outwards.left);
    return SpokeRef{i, n - 1};
  }
  if (same_ray(v.rays.front(), outwards.left)) {
    insert(0, 0, outwards.right);
    return SpokeRef{i, 0};
  }
  return std::nullopt;
}

SpokeRef SpokeTable::start_on_border(BorderPlace place, const BisectorPoint& first) {
  for (int i = 0; i < count(); ++i) {
    if (!vertices_[i].data.on_boundary || !((vertices_[i].data.xyz - first.position()).norm() < merge_)) continue;
    if (const auto spoke = extend_border_vertex(i, first)) return *spoke;
  }
  const int made = add({first.right, first.left}, 1);
  DiagramVertex& v = vertices_[made].data;
  v.on_boundary = true;
  v.border_cycle = place.cycle;
  v.border_parameter = place.parameter;
  return {made, 0};
}

SpokeRef SpokeTable::arrive_at_free_end(const BisectorPoint& last) { return {add({last.left}, 1), 0}; }

BisectorPoint SpokeTable::departure(SpokeRef s) const {
  const Vertex& v = vertices_[s.vertex];
  const int n = static_cast<int>(v.rays.size());
  return {v.rays[(s.spoke + 1) % n], v.rays[s.spoke]};
}

}  // namespace geovor
