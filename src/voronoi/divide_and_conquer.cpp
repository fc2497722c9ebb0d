#include "voronoi/divide_and_conquer.h"

#include <algorithm>
#include <numeric>

namespace geovor {
namespace {

class Division {
 public:
  Division(const FaceDomain& domain, const std::vector<Uv>& sites) : domain_(domain), sites_(sites) {
    for (Uv p : sites) places_.push_back(domain.surface().position(p));
  }

  VoronoiDiagram diagram_of(std::vector<int> which, const VoronoiOptions& options) const {
    std::sort(which.begin(), which.end());
    std::vector<Uv> places;
    for (int i : which) places.push_back(sites_[i]);
    if (which.size() < 2) return build_diagram(domain_, places, options);
    return merge_diagrams(domain_, places, halves(which), options);
  }

 private:
  std::vector<PartDiagram> halves(const std::vector<int>& which) const {
    std::vector<int> order(which.size());
    std::iota(order.begin(), order.end(), 0);
    const int axis = widest(which);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return places_[which[a]][axis] < places_[which[b]][axis]; });
    const auto middle = order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2);
    std::vector<PartDiagram> parts;
    for (auto [first, last] : {std::pair(order.begin(), middle), std::pair(middle, order.end())}) {
      PartDiagram part;
      part.which.assign(first, last);
      std::sort(part.which.begin(), part.which.end());
      std::vector<int> of_all;
      for (int i : part.which) of_all.push_back(which[i]);
      VoronoiOptions rough;
      rough.tolerance = face_size(domain_);  // no more points than were traced
      rough.measure = false;
      part.diagram = diagram_of(of_all, rough);
      parts.push_back(std::move(part));
    }
    return parts;
  }

  int widest(const std::vector<int>& which) const {
    Xyz lower = places_[which.front()], upper = lower;
    for (int i : which) lower = lower.cwiseMin(places_[i]), upper = upper.cwiseMax(places_[i]);
    int axis = 0;
    (upper - lower).maxCoeff(&axis);
    return axis;
  }

  const FaceDomain& domain_;
  const std::vector<Uv>& sites_;
  std::vector<Xyz> places_;
};

}  // namespace

VoronoiDiagram divide_and_conquer(const FaceDomain& domain, const std::vector<Uv>& sites,
                                  const VoronoiOptions& options) {
  std::vector<int> all(sites.size());
  std::iota(all.begin(), all.end(), 0);
  return Division(domain, sites).diagram_of(std::move(all), options);
}

}  // namespace geovor
