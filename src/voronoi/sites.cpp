#include "voronoi/sites.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

namespace geovor {
namespace {

// Boxes are no smaller than this part of the largest coordinate: their numbers stay far from overflow.
constexpr double kSmallestBox = 1e-12;

std::string subject(int site, int other) {
  if (other < 0) return "site " + std::to_string(site) + " ";
  return "sites " + std::to_string(site) + " and " + std::to_string(other) + " ";
}

std::vector<Xyz> places(const FaceDomain& domain, const std::vector<Uv>& sites, double tolerance) {
  std::vector<Xyz> x;
  for (int i = 0; i < static_cast<int>(sites.size()); ++i) {
    if (!is_finite(sites[i])) throw SiteError(i, -1, "is no finite number; give two finite parameters");
    if (!domain.contains(sites[i]) && !(domain.distance_to_border(sites[i]) <= tolerance)) {
      throw SiteError(i, -1, "lies outside the border of the face; move it inside or leave it out");
    }
    x.push_back(domain.surface().position(sites[i]));
    if (!x.back().allFinite()) throw SiteError(i, -1, "has no place in space; move it or leave it out");
  }
  return x;
}

/// Points in boxes of space. A point that is too near to one that is kept is not kept itself, so that a box of the
/// tolerance's size holds a few points at most and each question costs the same.
class Sieve {
 public:
  Sieve(const std::vector<Xyz>& points, double tolerance) : points_(points), tolerance_(tolerance) {
    double largest = 1.0;
    for (const Xyz& x : points) largest = std::max(largest, x.cwiseAbs().maxCoeff());
    box_ = std::max(tolerance, kSmallestBox * largest);
  }

  /// The smallest index kept so far within the tolerance of point i; keeps i where there is none.
  std::optional<int> add(int i) {
    const Key home = key(points_[i]);
    int smallest = i;
    Key k;
    for (k[0] = home[0] - 1; k[0] <= home[0] + 1; ++k[0]) {
      for (k[1] = home[1] - 1; k[1] <= home[1] + 1; ++k[1]) {
        // The three boxes along z are neighbours in the map.
        const auto end = boxes_.upper_bound({k[0], k[1], home[2] + 1});
        for (auto b = boxes_.lower_bound({k[0], k[1], home[2] - 1}); b != end; ++b) {
          for (int j : b->second) {
            if ((points_[j] - points_[i]).norm() <= tolerance_) smallest = std::min(smallest, j);
          }
        }
      }
    }
    if (smallest < i) return smallest;
    boxes_[home].push_back(i);
    return std::nullopt;
  }

 private:
  using Key = std::array<std::int64_t, 3>;
  Key key(const Xyz& x) const {
    const auto box = [this](double a) { return static_cast<std::int64_t>(std::floor(a / box_)); };
    return {box(x[0]), box(x[1]), box(x[2])};
  }

  const std::vector<Xyz>& points_;
  double tolerance_, box_;
  std::map<Key, std::vector<int>> boxes_;
};

}  // namespace

SiteError::SiteError(int site, int other, const std::string& reason)
    : Error(ErrorCode::Usage, subject(site, other) + reason), site_(site), other_(other), reason_(reason) {}

// Of all pairs the first in order is wanted: of a site j that is too near to an earlier one i, the pairs (j, k) with
// later ones k come after (i, j).
void check_sites(const FaceDomain& domain, const std::vector<Uv>& sites, double tolerance) {
  const std::vector<Xyz> x = places(domain, sites, tolerance);
  Sieve sieve(x, tolerance);
  const int n = static_cast<int>(x.size());
  std::pair<int, int> first = {n, n};
  for (int j = 0; j < n; ++j) {
    if (const auto i = sieve.add(j)) first = std::min(first, {*i, j});
  }
  if (first.first < n) throw SiteError(first.first, first.second, "are the same point; leave one of them out");
}

std::vector<Uv> places_of_sites(const VoronoiDiagram& diagram) {
  std::vector<Uv> places;
  for (const DiagramSite& site : diagram.sites) places.push_back(site.uv);
  return places;
}

}  // namespace geovor
