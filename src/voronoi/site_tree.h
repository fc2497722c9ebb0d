// A k-d tree of points of space: who lies within a distance of a place, and who is next.
#pragma once

#include <vector>

#include "base/xyz.h"

namespace geovor {

class SiteTree {
 public:
  SiteTree() = default;
  explicit SiteTree(std::vector<Xyz> points);

  /// Indices of the points within `r` of x (r included), nearest first, of equally near ones the lower index first.
  std::vector<int> in_ball(const Xyz& x, double r) const;

  /// The same in no order that means anything (though always the same one), appended to `found`.
  void collect(const Xyz& x, double r, std::vector<int>& found) const;

  /// The point nearest to x other than `except`; -1 if there is none.
  int nearest(const Xyz& x, int except = -1) const;

  const Xyz& point(int i) const { return points_[i]; }
  int count() const { return static_cast<int>(points_.size()); }

 private:
  // Leaves hold order_[first, last) and have no axis; the lower child of a node follows it, the upper one is at
  // `upper`.
  struct Node {
    int first = 0, last = 0, axis = -1, upper = 0;
    double split = 0.0;
  };
  struct Best {
    double square;
    int index = -1;
  };
  void build(int first, int last);
  void collect(int node, const Xyz& x, double square, std::vector<int>& found) const;
  void search(int node, const Xyz& x, int except, Best& best) const;

  std::vector<Xyz> points_, sorted_;  // sorted_[k] = points_[order_[k]]: a leaf's points lie side by side
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace geovor
