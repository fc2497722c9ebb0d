#include "voronoi/place_sites.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string>

#include "base/error.h"
#include "geodesic/trace.h"
#include "surface/forms.h"
#include "surface/tangent_frame.h"
#include "voronoi/border_distance.h"
#include "voronoi/diagram_builder.h"
#include "voronoi/face_border.h"
#include "voronoi/far_points.h"
#include "voronoi/site_ray.h"

namespace geovor {
namespace {

// Samples of the border are this part of the largest reach apart, so that every cell there has some.
constexpr double kBorderStep = 0.1;

// A reach below this part of the face's size is none: two places there would be one site.
constexpr double kSmallestReach = 1e-6;

// Vertices and stored points are exact whatever the tolerance; nothing is asked of the polylines between them. Part of
// the face's size.
constexpr double kCoarse = 0.05;

// The point that the first place is far from lies inside the border by this part of the face's extent; by less, halved
// so often at most, where the face is narrow there.
constexpr double kInside = 0.15;
constexpr int kMostHalvings = 20;

// Where the border's point has no tangent plane (less than the first of these between the parameters' directions) the
// way inside is found from a start so far from it, in parts of the box, to the third of these, parts of the way.
constexpr double kNoPlane = 1e-6;
constexpr double kFirstStart = 0.3;
constexpr double kSettled = 1e-11;
constexpr int kMostStarts = 40;

// Directions that are tried for a point whose diagram can be finished.
constexpr int kMostTurns = 8;

// A grid on which a closed surface is searched for its extreme point, lines in each direction.
constexpr int kGrid = 64;

/// The generator of Steele, Lea and Flood (2014): a full avalanche of the seed's bits.
std::uint64_t splitmix64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// A direction of space, uniform over the sphere.
Xyz direction_of(std::uint64_t seed) {
  constexpr double kTwoTo64 = 18446744073709551616.0;
  const std::uint64_t a = splitmix64(seed), b = splitmix64(a);
  const double z = 2.0 * (static_cast<double>(a) / kTwoTo64) - 1.0;
  const double turn = 2.0 * std::numbers::pi * (static_cast<double>(b) / kTwoTo64), r = std::sqrt(1.0 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

/// From the best point of a grid by Newton's method for <n, Su> = <n, Sv> = 0.
Uv extreme_of_closed(const Surface& surface, const UvBox& box, const Xyz& n) {
  Uv best = {box.u.middle(), box.v.middle()};
  double height = -std::numeric_limits<double>::infinity();
  for (int j = 0; j < kGrid; ++j) {
    for (int i = 0; i < kGrid; ++i) {
      const Uv p = {box.u.lo + box.u.length() * (i + 0.5) / kGrid, box.v.lo + box.v.length() * (j + 0.5) / kGrid};
      const double h = n.dot(surface.position(p));
      if (h > height) best = p, height = h;
    }
  }
  constexpr int kSteps = 8;
  for (int step = 0; step < kSteps; ++step) {
    const SurfaceJet j = surface.jet(best);
    Eigen::Matrix2d H;
    H << n.dot(j.Suu), n.dot(j.Suv), n.dot(j.Suv), n.dot(j.Svv);
    const Eigen::Vector2d d = H.fullPivLu().solve(Eigen::Vector2d(n.dot(j.Su), n.dot(j.Sv)));
    const Uv next = {best.u - d[0], best.v - d[1]};
    const double there = n.dot(surface.position(next));
    if (!(there >= height)) break;
    best = next, height = there;
  }
  return best;
}

/// Where parameters tell no directions a geodesic can arrive, but not leave: the one from inside that arrives there
/// from where the other would have gone, by Newton's method for its start.
std::optional<Uv> inside_of_gate_without_plane(const FaceDomain& domain, const BorderDistance::Gate& gate, double way) {
  const Surface& surface = domain.surface();
  const Uv middle = {domain.box().u.middle(), domain.box().v.middle()};
  std::vector<Uv> starts = {gate.uv + kFirstStart * (middle - gate.uv)};
  const SiteRays rays(surface, starts);
  int reached = -1;
  for (int i = 0; i < kMostStarts; ++i) {
    const auto ray = rays.to(i, gate.uv);
    if (!ray) {
      // The way there leaves the surface; from nearer by it may not.
      const Uv last_good = reached >= 0 ? starts[reached] : gate.uv;
      starts.push_back(last_good + 0.5 * (starts.back() - last_good));
      continue;
    }
    reached = i;
    const Xyz inward = ray->T.cross(ray->N).cross(gate.along).normalized();
    const double turn = std::atan2(inward.dot(ray->N), -inward.dot(ray->T));
    const TangentFrame frame = tangent_frame(surface, starts.back());
    const Xyz T = frame.at_angle(ray->polar.t);
    const Xyz step = (ray->polar.s - way) * T + turn * ray->y * frame.n.cross(T);
    if (step.norm() <= kSettled * way) return starts.back();
    const UvVec d = tangent_components(surface.jet(starts.back()), step);
    double k = 1.0;
    for (int halvings = 0; halvings < kMostHalvings && !domain.contains(starts.back() + k * d); ++halvings) k *= 0.5;
    starts.push_back(starts.back() + k * d);
  }
  return std::nullopt;
}

/// The end of the geodesic of this length that leads from the gate into the face.
std::optional<Uv> inside_of(const FaceDomain& domain, const BorderDistance::Gate& gate, double way) {
  const SurfaceJet j = domain.surface().jet(gate.uv);
  if (!(j.Su.cross(j.Sv).norm() > kNoPlane * std::max(j.Su.squaredNorm(), j.Sv.squaredNorm())))
    return inside_of_gate_without_plane(domain, gate, way);
  const Xyz inward = unit_normal(j).cross(gate.along).normalized();
  return trace_geodesic(domain.surface(), gate.uv, tangent_components(j, inward), way).end.p;
}

/// A little inside the point of the border that is extreme in a direction.
Uv just_inside(const FaceDomain& domain, const BorderDistance& border, const Xyz& n) {
  const BorderDistance::Gate gate = border.extreme(n);
  double way = kInside * n.dot(gate.x - border.extreme(-n).x);
  for (int i = 0; i < kMostHalvings; ++i, way *= 0.5) {
    const auto p = inside_of(domain, gate, way);
    if (p && domain.contains(*p)) return *p;
  }
  return gate.uv;
}

/// Keeps places of one batch apart: boxes of space of the largest reach.
class Batch {
 public:
  explicit Batch(double largest) : box_(largest) {}

  /// Takes the point unless one that was taken before is nearer than its reach.
  bool take(const FarPoint& p) {
    const Key home = key(p.x);
    Key k;
    for (k[0] = home[0] - 1; k[0] <= home[0] + 1; ++k[0]) {
      for (k[1] = home[1] - 1; k[1] <= home[1] + 1; ++k[1]) {
        for (k[2] = home[2] - 1; k[2] <= home[2] + 1; ++k[2]) {
          const auto found = boxes_.find(k);
          if (found == boxes_.end()) continue;
          for (const Xyz& x : found->second) {
            if ((x - p.x).norm() < p.reach * (1.0 + FarPoints::kSameReach)) return false;
          }
        }
      }
    }
    boxes_[home].push_back(p.x);
    return true;
  }

 private:
  using Key = std::array<long, 3>;
  Key key(const Xyz& x) const {
    const auto box = [this](double a) { return std::lround(a / box_); };
    return {box(x[0]), box(x[1]), box(x[2])};
  }
  double box_;
  std::map<Key, std::vector<Xyz>> boxes_;
};

class SitePlacer {
 public:
  SitePlacer(const FaceDomain& domain, std::uint64_t seed)
      : domain_(domain), border_(domain), tie_(direction_of(~seed)), size_(face_size(domain)), largest_(size_) {
    const BorderDistance border(domain.surface(), border_, kBorderStep * size_);
    std::vector<FarPoint> far;
    for (int turn = 0; turn < kMostTurns && far.empty(); ++turn) {
      const Xyz n = direction_of(seed + static_cast<std::uint64_t>(turn));
      sites_ = {border.empty() ? extreme_of_closed(domain.surface(), domain.box(), n) : just_inside(domain, border, n)};
      far = far_points();
    }
    if (far.empty()) throw_narrow();
    sites_ = {domain.to_principal(far.front().uv)};
  }

  /// `total`: what progress is told.
  void place(size_t count, double smallest_reach, int total, const PlacingProgress& progress) {
    const auto goes_on = [&] { return !progress || progress(static_cast<int>(sites_.size()), total); };
    while (goes_on() && sites_.size() < count) {
      const std::vector<FarPoint> far = far_points();
      if (far.empty() || far.front().reach <= std::max(smallest_reach, kSmallestReach * size_)) {
        if (smallest_reach > 0.0) return;
        throw_narrow();
      }
      largest_ = far.front().reach;
      const double least = std::max(smallest_reach, kBatchReach * largest_);
      Batch batch(largest_);
      const size_t most = sites_.size() < static_cast<size_t>(kOneByOne) ? sites_.size() + 1 : count;
      for (const FarPoint& p : far) {
        if (sites_.size() == std::min(most, count) || p.reach <= least) break;
        if (batch.take(p)) sites_.push_back(domain_.to_principal(p.uv));
      }
    }
  }

  const std::vector<Uv>& sites() const { return sites_; }

 private:
  std::vector<FarPoint> far_points() const {
    VoronoiOptions options;
    options.tolerance = kCoarse * size_;
    options.measure = false;
    const VoronoiDiagram diagram = build_diagram(domain_, sites_, options);
    const SiteRays rays(domain_.surface(), sites_);
    const BorderDistance border(domain_.surface(), border_, kBorderStep * largest_);
    std::vector<FarPoint> points = FarPoints(rays, diagram, border, tie_).points();
    // Where the path from a site to a place on the border leaves the face, so may the point on it.
    std::erase_if(points, [this](const FarPoint& p) { return !domain_.contains(domain_.to_principal(p.uv)); });
    return points;
  }

  [[noreturn]] void throw_narrow() const {
    throw Error(ErrorCode::Usage,
                "the face has no room for more than " + std::to_string(sites_.size()) + " sites; ask for fewer");
  }

  const FaceDomain& domain_;
  FaceBorder border_;
  Xyz tie_;
  double size_, largest_;
  std::vector<Uv> sites_;
};

}  // namespace

std::vector<Uv> place_sites(const FaceDomain& domain, int count, std::uint64_t seed, const PlacingProgress& progress) {
  if (count <= 0) throw Error(ErrorCode::Usage, "the number of sites must be at least 1");
  SitePlacer placer(domain, seed);
  placer.place(count, 0.0, count, progress);
  return placer.sites();
}

std::vector<Uv> place_sites_apart(const FaceDomain& domain, double spacing, std::uint64_t seed,
                                  const PlacingProgress& progress) {
  if (!(spacing > 0.0)) throw Error(ErrorCode::Usage, "the spacing must be positive");
  SitePlacer placer(domain, seed);
  placer.place(std::numeric_limits<int>::max(), kReachOfSpacing * spacing, 0, progress);
  return placer.sites();
}

}  // namespace geovor
