// A tree of boxes in space that hands out those near a point, nearest first.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "base/xyz.h"

namespace geovor {

/// A box with sides along the axes.
struct SpaceBox {
  Xyz lo, hi;
  void include(const Xyz& x) {
    lo = lo.cwiseMin(x);
    hi = hi.cwiseMax(x);
  }
  void include(const SpaceBox& box) {
    lo = lo.cwiseMin(box.lo);
    hi = hi.cwiseMax(box.hi);
  }
  double distance2(const Xyz& x) const { return (lo - x).cwiseMax(x - hi).cwiseMax(0.0).squaredNorm(); }
};

/// Immutable, so that any number of threads may ask.
class NearestBoxes {
 public:
  NearestBoxes() = default;
  explicit NearestBoxes(std::vector<SpaceBox> boxes);

  bool empty() const { return nodes_.empty(); }
  const SpaceBox& all() const { return nodes_.front().box; }

  /// Calls visit(i, distance2) for boxes, the nearer ones earlier, as long as their squared distance from x is below
  /// `best2`, which visit may lower. The order depends on the boxes and on x alone.
  template <typename Visit>
  void near(const Xyz& x, double& best2, Visit&& visit) const {
    if (!nodes_.empty()) descend(0, nodes_[0].box.distance2(x), x, best2, visit);
  }

 private:
  // Leaves are the boxes order_[first, last); the lower child of an inner node follows it, the upper one is at `upper`.
  struct Node {
    SpaceBox box;
    int first = 0, last = 0, upper = 0;
  };
  void build(int first, int last);

  template <typename Visit>
  void descend(int i, double distance2, const Xyz& x, double& best2, Visit& visit) const {
    if (!(distance2 < best2)) return;
    const Node& node = nodes_[i];
    if (node.upper == 0) {
      for (int k = node.first; k < node.last; ++k) {
        const double d2 = boxes_[order_[k]].distance2(x);
        if (d2 < best2) visit(order_[k], d2);
      }
      return;
    }
    std::pair<double, int> a{nodes_[i + 1].box.distance2(x), i + 1}, b{nodes_[node.upper].box.distance2(x), node.upper};
    if (b.first < a.first) std::swap(a, b);
    descend(a.second, a.first, x, best2, visit);
    descend(b.second, b.first, x, best2, visit);
  }

  std::vector<SpaceBox> boxes_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace geovor
