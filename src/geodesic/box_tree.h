// A tree of boxes in space: which of them hold a point.
#pragma once

#include <vector>

#include "base/xyz.h"

namespace geovor {

class BoxTree {
 public:
  struct Box {
    Xyz lo, hi;
  };

  BoxTree() = default;
  explicit BoxTree(std::vector<Box> boxes);

  /// Indices of the boxes that hold x, in ascending order.
  std::vector<int> holding(const Xyz& x) const;

 private:
  // Leaves are the boxes order_[first, last); the lower child of an inner node follows it, the upper one is at `upper`.
  struct Node {
    Box box;
    int first, last, upper = 0;
  };
  void build(int first, int last);

  std::vector<Box> boxes_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace geovor
