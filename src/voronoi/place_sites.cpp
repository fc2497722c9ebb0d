#include "voronoi/place_sites.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "base/error.h"
#include "voronoi/diagram_builder.h"
#include "voronoi/lattice.h"
#include "voronoi/site_ray.h"

namespace geovor {
namespace {

// Lattice steps between two neighbouring sites: the more, the nearer the places are to the farthest points.
constexpr double kStepsPerSpacing = 5.0;
constexpr double kStepsPerDiagonal = 20.0;

// Distances that agree to this part are a tie, which the position in space breaks.
constexpr double kTie = 1e-6;

/// The generator of Steele, Lea and Flood (2014): a full avalanche of the seed's bits.
std::uint64_t splitmix64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

bool before_in_space(const Xyz& a, const Xyz& b) {
  for (int k = 0; k < 3; ++k) {
    if (std::abs(a[k] - b[k]) > kTie * (std::abs(a[k]) + std::abs(b[k]))) return a[k] < b[k];
  }
  return false;
}

class FarthestPoints {
 public:
  explicit FarthestPoints(const FaceDomain& domain, double spacing)
      : lattice_(domain, spacing, {}),
        rays_(domain.surface(), sites_),
        distance_(lattice_.count(), std::numeric_limits<double>::infinity()),
        known_(lattice_.count()) {
    for (int node = 0; node < lattice_.count(); ++node) {
      if (!lattice_.inside(node)) continue;
      inside_.push_back(node);
      to_border_.push_back(domain.distance_to_border(lattice_.uv(node)));
    }
  }

  const std::vector<int>& inside() const { return inside_; }

  /// Makes the node a site and tells all nodes to which it is the nearest.
  void add(int node) {
    const int site = static_cast<int>(sites_.size());
    sites_.push_back(lattice_.uv(node));
    distance_[node] = 0.0;
    for (const auto& z : lattice_.neighbours(node)) offer(z.node, rays_.roughly_to(site, z.uv));
    while (!queue_.empty()) {
      const Arrival a = queue_.top();
      queue_.pop();
      if (a.ray.polar.s > distance_[a.node]) continue;
      for (const auto& z : lattice_.neighbours(a.node)) {
        const Polar guess = carry(a.ray, lattice_.xyz(z.node));
        if (guess.s > 0.0 && guess.s < distance_[z.node] * (1.0 - kTie) && !known(z.node, site, guess)) {
          offer(z.node, rays_.roughly_to(site, z.uv, guess));
        }
      }
    }
  }

  int farthest() const {
    int best = inside_.front();
    double score = -1.0;
    for (size_t i = 0; i < inside_.size(); ++i) {
      const int node = inside_[i];
      const double s = std::min(distance_[node], 2.0 * to_border_[i]);
      const bool tie = std::abs(s - score) <= kTie * score;
      if (tie ? before_in_space(lattice_.xyz(node), lattice_.xyz(best)) : s > score) best = node, score = s;
    }
    return best;
  }

  const std::vector<Uv>& sites() const { return sites_; }

 private:
  struct Arrival {
    int node;
    SiteRay ray;
    bool operator<(const Arrival& other) const {
      return ray.polar.s != other.ray.polar.s ? ray.polar.s > other.ray.polar.s : node > other.node;
    }
  };

  // A node has up to eight neighbours that carry the same geodesic on to it: one of them is enough.
  bool known(int node, int site, const Polar& guess) const {
    const auto near = [&](const SiteRay& ray) { return near_guess(ray, site, guess, lattice_.reach(node)); };
    return std::any_of(known_[node].begin(), known_[node].end(), near);
  }

  void offer(int node, const std::optional<SiteRay>& ray) {
    if (!ray) return;
    auto& known = known_[node];
    if (!known.empty() && known.front().site != ray->site) known.clear();
    known.push_back(*ray);
    if (!(ray->polar.s < distance_[node])) return;
    distance_[node] = ray->polar.s;
    queue_.push({node, *ray});
  }

  FaceLattice lattice_;
  std::vector<Uv> sites_;
  SiteRays rays_;
  std::vector<double> distance_;             ///< to the nearest site
  std::vector<std::vector<SiteRay>> known_;  ///< geodesics computed for the last site that reached the node
  std::vector<int> inside_;
  std::vector<double> to_border_;
  std::priority_queue<Arrival> queue_;
};

}  // namespace

std::vector<Uv> place_sites(const FaceDomain& domain, int count, std::uint64_t seed) {
  if (count <= 0) throw Error(ErrorCode::Usage, "the number of sites must be at least 1");
  const double per_site = std::sqrt(rough_area(domain) / count);
  FarthestPoints places(domain, std::min(per_site / kStepsPerSpacing, face_size(domain) / kStepsPerDiagonal));
  if (static_cast<int>(places.inside().size()) < count) {
    throw Error(ErrorCode::Usage, "the face is too narrow for " + std::to_string(count) + " sites; ask for fewer");
  }
  places.add(places.inside()[splitmix64(seed) % places.inside().size()]);
  while (static_cast<int>(places.sites().size()) < count) places.add(places.farthest());
  return places.sites();
}

}  // namespace geovor
