#include "voronoi/labels.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace geovor {
namespace {

// Candidates are kept up to this many reaches above the nearest: two for the promise, one because the way along the
// lattice deviates from the geodesic that it follows.
constexpr double kKeep = 3.0;

// Two arrivals of one geodesic, as a part of the reach: they agree to kRoughly of their length.
constexpr double kSameArrival = 1e-3;

struct Arrival {
  double length;
  long order;  ///< first come first served among equals: no other order is the same on every machine
  int node;
  SiteRay ray;
};
struct Later {
  bool operator()(const Arrival& a, const Arrival& b) const {
    return a.length != b.length ? a.length > b.length : a.order > b.order;
  }
};

/// Dijkstra's front, run for all sites at once. A node takes any number of arrivals.
class Front {
 public:
  Front(const FaceLattice& lattice, const SiteRays& rays, std::vector<std::vector<SiteRay>>& lists)
      : lattice_(lattice), rays_(rays), lists_(lists), known_(lattice.count()) {}

  void start(int site) {
    for (int node : lattice_.corners(rays_.site(site))) push(node, rays_.roughly_to(site, lattice_.uv(node)));
  }

  void run() {
    while (!queue_.empty()) {
      const Arrival a = queue_.top();
      queue_.pop();
      if (take(a)) spread(a);
    }
  }

 private:
  double limit(int node) const {
    return lists_[node].empty() ? std::numeric_limits<double>::infinity()
                                : lists_[node].front().polar.s + kKeep * lattice_.reach(node);
  }

  void push(int node, const std::optional<SiteRay>& ray) {
    if (!ray || !(ray->polar.s <= limit(node))) return;
    known_[node].push_back(*ray);
    queue_.push({ray->polar.s, order_++, node, *ray});
  }

  bool take(const Arrival& a) {
    if (!(a.length <= limit(a.node))) return false;
    auto& list = lists_[a.node];
    const auto same = [&](const SiteRay& ray) {
      return near_guess(ray, a.ray.site, a.ray.polar, kSameArrival * lattice_.reach(a.node));
    };
    if (std::any_of(list.begin(), list.end(), same)) return false;
    list.push_back(a.ray);
    return true;
  }

  bool known(int node, int site, const Polar& guess) const {
    const auto near = [&](const SiteRay& ray) { return near_guess(ray, site, guess, lattice_.reach(node)); };
    return std::any_of(known_[node].begin(), known_[node].end(), near);
  }

  void spread(const Arrival& a) {
    for (const auto& z : lattice_.neighbours(a.node)) {
      const Polar guess = carry(a.ray, lattice_.xyz(z.node));
      if (!(guess.s > 0.0) || guess.s > limit(z.node) + lattice_.reach(z.node)) continue;
      if (!known(z.node, a.ray.site, guess)) push(z.node, rays_.roughly_to(a.ray.site, z.uv, guess));
    }
  }

  const FaceLattice& lattice_;
  const SiteRays& rays_;
  std::vector<std::vector<SiteRay>>& lists_;
  std::vector<std::vector<SiteRay>> known_;  ///< every geodesic computed so far, taken or not
  std::priority_queue<Arrival, std::vector<Arrival>, Later> queue_;
  long order_ = 0;
};

void sort_by_length(std::vector<SiteRay>& list) {
  std::stable_sort(list.begin(), list.end(), [](const SiteRay& a, const SiteRay& b) { return a.polar.s < b.polar.s; });
}

}  // namespace

CandidateLabels::CandidateLabels(const FaceLattice& lattice, const SiteRays& rays)
    : lattice_(lattice), rays_(rays), lists_(lattice.count()) {
  Front front(lattice, rays, lists_);
  for (int site = 0; site < rays.count(); ++site) front.start(site);
  front.run();
  for (auto& list : lists_) sort_by_length(list);
}

std::vector<SiteRay> CandidateLabels::around(Uv m, bool roughly) const {
  const Xyz x = rays_.surface().position(m);
  std::vector<SiteRay> found;
  for (int corner : lattice_.corners(m)) {
    for (const SiteRay& candidate : lists_[corner]) {
      const Polar guess = carry(candidate, x);
      const auto near = [&](const SiteRay& ray) {
        return near_guess(ray, candidate.site, guess, lattice_.reach(corner));
      };
      if (std::any_of(found.begin(), found.end(), near)) continue;
      const auto ray = roughly ? rays_.roughly_to(candidate.site, m, guess) : rays_.to(candidate.site, m, guess);
      if (!ray) continue;
      const auto same = [&](const SiteRay& other) { return same_generator(*ray, other); };
      if (std::none_of(found.begin(), found.end(), same)) found.push_back(*ray);
    }
  }
  sort_by_length(found);
  return found;
}

}  // namespace geovor
