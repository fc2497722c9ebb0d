#include "voronoi/sites.h"

#include <algorithm>
#include <numeric>

namespace geovor {
namespace {

std::string subject(int site, int other) {
  if (other < 0) return "site " + std::to_string(site) + " ";
  return "sites " + std::to_string(site) + " and " + std::to_string(other) + " ";
}

}  // namespace

SiteError::SiteError(int site, int other, const std::string& reason)
    : Error(ErrorCode::Usage, subject(site, other) + reason), site_(site), other_(other), reason_(reason) {}

void check_sites(const FaceDomain& domain, const std::vector<Uv>& sites, double tolerance) {
  std::vector<Xyz> x;
  for (int i = 0; i < static_cast<int>(sites.size()); ++i) {
    if (!is_finite(sites[i])) throw SiteError(i, -1, "is no finite number; give two finite parameters");
    if (!domain.contains(sites[i]) && !(domain.distance_to_border(sites[i]) <= tolerance)) {
      throw SiteError(i, -1, "lies outside the border of the face; move it inside or leave it out");
    }
    x.push_back(domain.surface().position(sites[i]));
  }
  // Sorted along x, a pair that is too near is found a few places apart.
  std::vector<int> order(sites.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return x[a].x() < x[b].x(); });
  std::pair<int, int> first = {static_cast<int>(sites.size()), -1};
  for (size_t i = 0; i < order.size(); ++i) {
    for (size_t j = i + 1; j < order.size() && x[order[j]].x() - x[order[i]].x() <= tolerance; ++j) {
      if ((x[order[j]] - x[order[i]]).norm() > tolerance) continue;
      first = std::min(first, {std::min(order[i], order[j]), std::max(order[i], order[j])});
    }
  }
  if (first.second >= 0) throw SiteError(first.first, first.second, "are the same point; leave one of them out");
}

}  // namespace geovor
