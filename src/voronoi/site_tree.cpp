#include "voronoi/site_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace geovor {
namespace {

// Points that are looked at one by one cost less than a branch of the tree.
constexpr int kLeaf = 6;

}  // namespace

SiteTree::SiteTree(std::vector<Xyz> points) : points_(std::move(points)), order_(points_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!points_.empty()) build(0, count());
  for (const int i : order_) sorted_.push_back(points_[i]);
}

void SiteTree::build(int first, int last) {
  const auto here = nodes_.size();
  nodes_.push_back({first, last});
  if (last - first <= kLeaf) return;
  Xyz lo = points_[order_[first]], hi = lo;
  for (int k = first; k < last; ++k) {
    lo = lo.cwiseMin(points_[order_[k]]);
    hi = hi.cwiseMax(points_[order_[k]]);
  }
  int axis = 0;
  (hi - lo).maxCoeff(&axis);
  const int middle = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last, [&](int a, int b) {
    const double x = points_[a][axis], y = points_[b][axis];
    return x < y || (x == y && a < b);
  });
  const double split = points_[order_[middle]][axis];
  build(first, middle);
  const int upper = static_cast<int>(nodes_.size());
  build(middle, last);
  nodes_[here] = {first, last, axis, upper, split};
}

void SiteTree::collect(const Xyz& x, double r, std::vector<int>& found) const {
  if (!nodes_.empty() && r >= 0.0) collect(0, x, r * r, found);
}

void SiteTree::collect(int node, const Xyz& x, double square, std::vector<int>& found) const {
  const Node& n = nodes_[node];
  if (n.axis < 0) {
    for (int k = n.first; k < n.last; ++k)
      if ((sorted_[k] - x).squaredNorm() <= square) found.push_back(order_[k]);
    return;
  }
  const double off = x[n.axis] - n.split;
  const bool both = off * off <= square;
  if (both || off < 0.0) collect(node + 1, x, square, found);
  if (both || off >= 0.0) collect(n.upper, x, square, found);
}

std::vector<int> SiteTree::in_ball(const Xyz& x, double r) const {
  std::vector<int> found;
  collect(x, r, found);
  std::sort(found.begin(), found.end(), [&](int a, int b) {
    const double p = (points_[a] - x).squaredNorm(), q = (points_[b] - x).squaredNorm();
    return p < q || (p == q && a < b);
  });
  return found;
}

int SiteTree::nearest(const Xyz& x, int except) const {
  Best best{std::numeric_limits<double>::infinity()};
  if (!nodes_.empty()) search(0, x, except, best);
  return best.index;
}

void SiteTree::search(int node, const Xyz& x, int except, Best& best) const {
  const Node& n = nodes_[node];
  if (n.axis < 0) {
    for (int k = n.first; k < n.last; ++k) {
      const double square = (sorted_[k] - x).squaredNorm();
      const int i = order_[k];
      if (i == except || !(square < best.square || (square == best.square && i < best.index))) continue;
      best = {square, i};
    }
    return;
  }
  const double off = x[n.axis] - n.split;
  search(off < 0.0 ? node + 1 : n.upper, x, except, best);
  if (off * off <= best.square) search(off < 0.0 ? n.upper : node + 1, x, except, best);
}

}  // namespace geovor
