#include "delaunay/close_gaps.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "delaunay/edge_set.h"

namespace geovor {
namespace {

using Triangle = std::array<int, 3>;

// A gap with more corners is no gap but a hole.
constexpr int kLargestGap = 12;

class Patchwork {
 public:
  Patchwork(const std::vector<MeshVertex>& points, const FaceBorder& border, std::vector<Triangle> certain)
      : points_(points), border_(border), triangles_(std::move(certain)) {
    for (const Triangle& t : triangles_) insert(t);
  }

  void add_if_room(const Triangle& t) {
    for (int k = 0; k < 3; ++k) {
      if (edges_.has(t[k], t[(k + 1) % 3]) || is_border_edge(t[(k + 1) % 3], t[k])) return;
    }
    insert(t);
    triangles_.push_back(t);
  }

  // The edges that a triangle should still be to the left of, joined to polygons.
  bool fill() {
    std::vector<int> after(points_.size(), -1);
    std::vector<int> starts;
    const auto missing = [&](int a, int b) {
      if (edges_.has(a, b)) return true;
      if (after[a] >= 0) return false;  // two gaps meet in a point: which goes with which is not known
      after[a] = b;
      starts.push_back(a);
      return true;
    };
    for (const Triangle& t : triangles_) {
      for (int k = 0; k < 3; ++k) {
        const int a = t[k], b = t[(k + 1) % 3];
        if (!is_border_edge(a, b) && !missing(b, a)) return false;
      }
    }
    for (size_t a = 0; a < border_.points.size(); ++a) {
      if (!missing(static_cast<int>(a), border_.next[a])) return false;
    }
    for (const int start : starts) {
      if (after[start] < 0) continue;
      std::vector<int> gap;
      for (int v = start; v >= 0 && after[v] >= 0;) {
        gap.push_back(v);
        const int next = after[v];
        after[v] = -1;
        v = next;
        if (static_cast<int>(gap.size()) > kLargestGap) return false;
      }
      if (!cut_ears(gap)) return false;
    }
    return true;
  }

  /// Nothing unless every edge has its triangles, every point one fan of them, and all hang together.
  std::optional<HalfEdges> whole() const;

 private:
  bool is_border_edge(int a, int b) const {
    return a < static_cast<int>(border_.points.size()) && border_.next[a] == b;
  }

  void insert(const Triangle& t) {
    for (int k = 0; k < 3; ++k) edges_.insert(t[k], t[(k + 1) % 3]);
  }

  // The ear with the widest smallest angle first.
  bool cut_ears(std::vector<int> gap) {
    while (gap.size() >= 3) {
      const int n = static_cast<int>(gap.size());
      int best = -1;
      double widest = 0.0;
      for (int i = 0; i < n; ++i) {
        const Triangle t = {gap[(i + n - 1) % n], gap[i], gap[(i + 1) % n]};
        const double w = n > 3 && edges_.has(t[0], t[2]) ? -1.0 : width(t);
        if (w > widest) best = i, widest = w;
      }
      if (best < 0) return false;
      const Triangle t = {gap[(best + n - 1) % n], gap[best], gap[(best + 1) % n]};
      insert(t);
      triangles_.push_back(t);
      if (n == 3) return true;
      gap.erase(gap.begin() + best);
    }
    return false;
  }

  // Twice the area over the square of the longest side; negative where the triangle faces the wrong way.
  double width(const Triangle& t) const {
    const MeshVertex &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
    const double longest = std::max({(b.x - a.x).squaredNorm(), (c.x - b.x).squaredNorm(), (a.x - c.x).squaredNorm()});
    return (b.x - a.x).cross(c.x - a.x).dot((a.n + b.n + c.n).normalized()) / longest;
  }

  const std::vector<MeshVertex>& points_;
  const FaceBorder& border_;
  std::vector<Triangle> triangles_;
  EdgeSet edges_;
};

std::optional<HalfEdges> Patchwork::whole() const {
  if (triangles_.empty()) return std::nullopt;
  std::vector<size_t> corners(points_.size(), 0);
  std::vector<int> set(points_.size());
  std::iota(set.begin(), set.end(), 0);
  const auto find = [&set](int v) {
    while (set[v] != v) v = set[v] = set[set[v]];
    return v;
  };
  for (const Triangle& t : triangles_) {
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      ++corners[a];
      set[find(a)] = find(b);
      if (edges_.has(b, a) == is_border_edge(a, b)) return std::nullopt;
    }
  }
  HalfEdges result(static_cast<int>(points_.size()), triangles_);
  const int root = find(triangles_[0][0]);
  for (size_t i = 0; i < points_.size(); ++i) {
    const int v = static_cast<int>(i);
    if (corners[i] == 0 && i >= border_.points.size()) continue;
    if (corners[i] == 0 || find(v) != root || result.star(v).size() != corners[i]) return std::nullopt;
  }
  return result;
}

}  // namespace

std::optional<HalfEdges> close_gaps(const std::vector<MeshVertex>& points, const FaceBorder& border,
                                    std::vector<Triangle> certain, const std::vector<Triangle>& candidates) {
  Patchwork patches(points, border, std::move(certain));
  for (const Triangle& t : candidates) patches.add_if_room(t);
  if (!patches.fill()) return std::nullopt;
  return patches.whole();
}

}  // namespace geovor
