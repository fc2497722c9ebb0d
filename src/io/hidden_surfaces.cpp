// A depth buffer says which triangle is seen in each unit square. A seen triangle that also covers a square where
// another one is seen must be painted before that one; all such pairs together are sorted topologically. Sorting by
// depth alone, the usual painter's algorithm, fails where a long triangle reaches past a short one.
#include "io/hidden_surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace geovor {
namespace {

/// Neighbours agree in depth on their common edge to rounding; less than this (page units) is not "in front".
constexpr double kSameDepth = 1e-3;
/// A triangle too small to cover the middle of a square counts as seen unless something is in front of its centroid by
/// more than this (page units): twice the depth that a surface seen at 60 degrees gains over a square.
constexpr double kTinyDepth = 3.5;

/// Twice the signed area on the page.
double twice_area(const PageTriangle& t) {
  return (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y);
}

double mean_depth(const PageTriangle& t) { return (t[0].depth + t[1].depth + t[2].depth) / 3.0; }

class DepthBuffer {
 public:
  DepthBuffer(const std::vector<PageTriangle>& triangles, int width, int height)
      : triangles_(triangles),
        width_(width),
        height_(height),
        owner_(static_cast<std::size_t>(width) * height, -1),
        depth_(owner_.size(), -std::numeric_limits<double>::infinity()) {
    for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
      for_each_square(t, [&](std::size_t square, double depth) {
        if (!(depth > depth_[square])) return;
        depth_[square] = depth;
        owner_[square] = t;
      });
    }
  }

  std::vector<char> seen() const {
    std::vector<char> seen(triangles_.size(), 0);
    for (const int t : owner_) {
      if (t >= 0) seen[t] = 1;
    }
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (!seen[t] && twice_area(triangles_[t]) != 0.0) seen[t] = tiny_and_seen(static_cast<int>(t));
    }
    return seen;
  }

  /// The pairs (behind, in front) of seen triangles, each once.
  std::vector<std::pair<int, int>> hidings(const std::vector<char>& seen) const {
    std::vector<std::pair<int, int>> pairs;
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
      if (!seen[t]) continue;
      const std::size_t first = pairs.size();
      for_each_square(t, [&](std::size_t square, double depth) {
        if (owner_[square] != t && depth_[square] > depth + kSameDepth) pairs.push_back({t, owner_[square]});
      });
      std::sort(pairs.begin() + first, pairs.end());
      pairs.erase(std::unique(pairs.begin() + first, pairs.end()), pairs.end());
    }
    return pairs;
  }

 private:
  /// Calls visit(square, depth) for the unit squares whose middle lies in the triangle.
  template <typename Visit>
  void for_each_square(int index, Visit&& visit) const {
    const PageTriangle& t = triangles_[index];
    const double area = twice_area(t);
    if (!(std::abs(area) > 0.0)) return;
    const auto [x_lo, x_hi] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [y_lo, y_hi] = std::minmax({t[0].y, t[1].y, t[2].y});
    const auto clamped = [](double x, int n) { return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(n))); };
    for (int row = clamped(y_lo - 0.5, height_); row < clamped(y_hi + 0.5, height_); ++row) {
      for (int column = clamped(x_lo - 0.5, width_); column < clamped(x_hi + 0.5, width_); ++column) {
        const double x = column + 0.5, y = row + 0.5;
        const auto part = [&](const PagePoint& a, const PagePoint& b) {
          return ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / area;
        };
        const double w0 = part(t[1], t[2]), w1 = part(t[2], t[0]), w2 = part(t[0], t[1]);
        if (!(w0 >= 0.0 && w1 >= 0.0 && w2 >= 0.0)) continue;
        visit(static_cast<std::size_t>(row) * width_ + column, w0 * t[0].depth + w1 * t[1].depth + w2 * t[2].depth);
      }
    }
  }

  bool tiny_and_seen(int index) const {
    bool covers = false;
    for_each_square(index, [&](std::size_t, double) { covers = true; });
    if (covers) return false;
    const PageTriangle& t = triangles_[index];
    const double x = std::floor((t[0].x + t[1].x + t[2].x) / 3.0), y = std::floor((t[0].y + t[1].y + t[2].y) / 3.0);
    if (!(x >= 0.0 && x < width_ && y >= 0.0 && y < height_)) return false;
    return depth_[static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x)] <= mean_depth(t) + kTinyDepth;
  }

  const std::vector<PageTriangle>& triangles_;
  int width_, height_;
  std::vector<int> owner_;
  std::vector<double> depth_;
};

/// Kahn's algorithm, the deepest of the free triangles first. In a ring the deepest of those that are left is freed.
std::vector<int> sorted(const std::vector<PageTriangle>& triangles, const std::vector<char>& seen,
                        const std::vector<std::pair<int, int>>& hidings) {
  std::vector<int> by_depth;
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
    if (seen[t]) by_depth.push_back(t);
  }
  std::stable_sort(by_depth.begin(), by_depth.end(),
                   [&](int a, int b) { return mean_depth(triangles[a]) < mean_depth(triangles[b]); });
  std::vector<int> rank(triangles.size(), -1), waiting(triangles.size(), 0);
  for (std::size_t i = 0; i < by_depth.size(); ++i) rank[by_depth[i]] = static_cast<int>(i);
  for (const auto& [behind, front] : hidings) ++waiting[front];

  std::priority_queue<int, std::vector<int>, std::greater<>> free;  // ranks
  for (const int t : by_depth) {
    if (waiting[t] == 0) free.push(rank[t]);
  }
  std::vector<int> order;
  std::vector<char> painted(triangles.size(), 0);
  std::size_t next_in_ring = 0;
  while (order.size() < by_depth.size()) {
    while (free.empty() && painted[by_depth[next_in_ring]]) ++next_in_ring;
    const int t = free.empty() ? by_depth[next_in_ring] : by_depth[free.top()];
    if (!free.empty()) free.pop();
    if (painted[t]) continue;
    painted[t] = 1;
    order.push_back(t);
    for (auto h = std::lower_bound(hidings.begin(), hidings.end(), std::pair{t, -1});
         h != hidings.end() && h->first == t; ++h) {
      if (--waiting[h->second] == 0 && !painted[h->second]) free.push(rank[h->second]);
    }
  }
  return order;
}

}  // namespace

std::vector<int> painting_order(const std::vector<PageTriangle>& triangles, int width, int height) {
  const DepthBuffer buffer(triangles, width, height);
  const std::vector<char> seen = buffer.seen();
  return sorted(triangles, seen, buffer.hidings(seen));
}

}  // namespace geovor
