#include "mesh/nearest_boxes.h"

#include <numeric>

namespace geovor {
namespace {

// Boxes that are looked at one by one cost less than a branch of the tree.
constexpr int kLeaf = 4;

}  // namespace

NearestBoxes::NearestBoxes(std::vector<SpaceBox> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(boxes_.size());
  if (!boxes_.empty()) build(0, static_cast<int>(boxes_.size()));
}

// Halves by the middles of the boxes, along the axis on which these lie farthest apart.
void NearestBoxes::build(int first, int last) {
  const auto here = nodes_.size();
  const auto twice_middle = [this](int i) -> Xyz { return boxes_[i].lo + boxes_[i].hi; };
  SpaceBox all = boxes_[order_[first]];
  SpaceBox middles{twice_middle(order_[first]), twice_middle(order_[first])};
  for (int k = first; k < last; ++k) {
    all.include(boxes_[order_[k]]);
    middles.include(twice_middle(order_[k]));
  }
  nodes_.push_back({all, first, last});
  if (last - first <= kLeaf) return;
  int axis = 0;
  (middles.hi - middles.lo).maxCoeff(&axis);
  const int half = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last, [&](int a, int b) {
    const double x = twice_middle(a)[axis], y = twice_middle(b)[axis];
    return x < y || (x == y && a < b);
  });
  build(first, half);
  nodes_[here].upper = static_cast<int>(nodes_.size());
  build(half, last);
}

}  // namespace geovor
