#include "geodesic/box_tree.h"

#include <algorithm>
#include <numeric>

namespace geovor {
namespace {

// Boxes that are looked at one by one cost less than a branch of the tree.
constexpr int kLeaf = 4;

bool holds(const BoxTree::Box& box, const Xyz& x) {
  return (x.array() >= box.lo.array()).all() && (x.array() <= box.hi.array()).all();
}

}  // namespace

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(boxes_.size());
  if (!boxes_.empty()) build(0, static_cast<int>(boxes_.size()));
}

void BoxTree::build(int first, int last) {
  const auto here = nodes_.size();
  Box all = boxes_[order_[first]];
  const auto twice_centre = [this](int i) -> Xyz { return boxes_[i].lo + boxes_[i].hi; };
  Xyz lo = twice_centre(order_[first]), hi = lo;
  for (int k = first; k < last; ++k) {
    const Box& box = boxes_[order_[k]];
    all = {all.lo.cwiseMin(box.lo), all.hi.cwiseMax(box.hi)};
    lo = lo.cwiseMin(twice_centre(order_[k]));
    hi = hi.cwiseMax(twice_centre(order_[k]));
  }
  nodes_.push_back({all, first, last});
  if (last - first <= kLeaf) return;
  int axis = 0;
  (hi - lo).maxCoeff(&axis);
  const int middle = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last, [&](int a, int b) {
    const double x = twice_centre(a)[axis], y = twice_centre(b)[axis];
    return x < y || (x == y && a < b);
  });
  build(first, middle);
  nodes_[here].upper = static_cast<int>(nodes_.size());
  build(middle, last);
}

std::vector<int> BoxTree::holding(const Xyz& x) const {
  std::vector<int> found, open;
  if (!nodes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const int i = open.back();
    open.pop_back();
    const Node& node = nodes_[i];
    if (!holds(node.box, x)) continue;
    if (node.upper > 0) {
      open.push_back(node.upper);
      open.push_back(i + 1);
      continue;
    }
    for (int k = node.first; k < node.last; ++k)
      if (holds(boxes_[order_[k]], x)) found.push_back(order_[k]);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace geovor
