#include "delaunay/close_gaps.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "delaunay/edge_set.h"

namespace geovor {
namespace {

using Triangle = std::array<int, 3>;

// A gap with more corners is no gap but a hole.
constexpr int kLargestGap = 60;
// So many times the triangles around gaps that can't be filled are taken out.
constexpr int kMostDigs = 6;

class Patchwork {
 public:
  Patchwork(const std::vector<MeshVertex>& points, const MeshBorder& border, std::vector<Triangle> certain)
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

  // Fills the gaps; where one can't be filled, because triangles around it overlap, they are taken out and it is tried
  // again. Points that lose all their triangles so are left over.
  bool fill() {
    for (int dig = 0; dig < kMostDigs; ++dig) {
      std::set<int> spoilt;
      for (const std::vector<int>& gap : gaps()) {
        if (!cut_ears(gap)) spoilt.insert(gap.begin(), gap.end());
      }
      if (spoilt.empty()) return true;
      take_out(spoilt);
    }
    return false;
  }

  /// Nothing unless every edge has its triangles, every point one fan of them, and all hang together.
  std::optional<HalfEdges> whole() const;

 private:
  bool is_border_edge(int a, int b) const { return border_.on_border(a) && border_.next[a] == b; }

  void insert(const Triangle& t) {
    for (int k = 0; k < 3; ++k) edges_.insert(t[k], t[(k + 1) % 3]);
  }

  void take_out(const std::set<int>& around) {
    const auto touches = [&around](const Triangle& t) {
      return std::any_of(t.begin(), t.end(), [&around](int v) { return around.count(v) > 0; });
    };
    triangles_.erase(std::remove_if(triangles_.begin(), triangles_.end(), touches), triangles_.end());
    edges_ = EdgeSet();
    for (const Triangle& t : triangles_) insert(t);
  }

  // The edges that should still have a triangle on their left, by where they start.
  std::map<int, std::vector<int>> missing() const {
    std::map<int, std::vector<int>> after;
    const auto add = [&](int a, int b) {
      if (!edges_.has(a, b)) after[a].push_back(b);
    };
    for (const Triangle& t : triangles_) {
      for (int k = 0; k < 3; ++k) {
        if (!is_border_edge(t[k], t[(k + 1) % 3])) add(t[(k + 1) % 3], t[k]);
      }
    }
    for (int a = 0; border_.on_border(a); ++a) add(a, border_.next[a]);
    return after;
  }

  // Those edges joined to polygons. Where gaps meet in a point each goes on with its own edge: the first one clockwise
  // from where it came.
  std::vector<std::vector<int>> gaps() const {
    std::vector<std::vector<int>> result;
    auto after = missing();
    while (!after.empty()) {
      std::vector<int> gap = {after.begin()->first};
      int from = gap[0], to = take(after, from, -1);
      while (to != gap[0] && after.count(to) > 0) {
        gap.push_back(to);
        const int next = take(after, to, from);
        from = to;
        to = next;
      }
      result.push_back(std::move(gap));
    }
    return result;
  }

  int take(std::map<int, std::vector<int>>& after, int at, int from) const {
    const auto place = after.find(at);
    std::vector<int>& ends = place->second;
    size_t best = 0;
    for (size_t i = 1; from >= 0 && i < ends.size(); ++i) {
      if (clockwise(at, from, ends[i]) < clockwise(at, from, ends[best])) best = i;
    }
    const int end = ends[best];
    ends.erase(ends.begin() + static_cast<long>(best));
    if (ends.empty()) after.erase(place);
    return end;
  }

  // The angle by which the direction to b lies clockwise of that to a, in (0, 2 pi].
  double clockwise(int at, int a, int b) const {
    const MeshVertex& v = points_[at];
    const Xyz p = points_[a].x - v.x, q = points_[b].x - v.x;
    const double angle = std::atan2(v.n.dot(q.cross(p)), q.dot(p) - v.n.dot(p) * v.n.dot(q));
    return angle > 0.0 ? angle : angle + 2.0 * std::numbers::pi;
  }

  // The ear with the widest smallest angle first.
  bool cut_ears(std::vector<int> gap) {
    if (gap.size() < 3 || gap.size() > kLargestGap) return false;
    while (true) {
      const int n = static_cast<int>(gap.size());
      int best = -1;
      double widest = 0.0;
      for (int i = 0; i < n; ++i) {
        const Triangle t = ear(gap, i);
        const double w = width(t);
        if (w > widest && (n == 3 || (!edges_.has(t[0], t[2]) && is_free(gap, t)))) best = i, widest = w;
      }
      if (best < 0) return false;
      const Triangle t = ear(gap, best);
      insert(t);
      triangles_.push_back(t);
      if (n == 3) return true;
      gap.erase(gap.begin() + best);
    }
  }

  static Triangle ear(const std::vector<int>& gap, int i) {
    const int n = static_cast<int>(gap.size());
    return {gap[(i + n - 1) % n], gap[i], gap[(i + 1) % n]};
  }

  // Whether no other corner of the gap lies in the ear.
  bool is_free(const std::vector<int>& gap, const Triangle& t) const {
    const MeshVertex& m = points_[t[1]];
    return std::none_of(gap.begin(), gap.end(), [&](int v) {
      if (v == t[0] || v == t[1] || v == t[2]) return false;
      for (int k = 0; k < 3; ++k) {
        const Xyz &a = points_[t[k]].x, &b = points_[t[(k + 1) % 3]].x;
        if (m.n.dot((b - a).cross(points_[v].x - a)) < 0.0) return false;
      }
      return true;
    });
  }

  // Twice the area over the square of the longest side; negative where the triangle faces the wrong way.
  double width(const Triangle& t) const {
    const MeshVertex &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
    const double longest = std::max({(b.x - a.x).squaredNorm(), (c.x - b.x).squaredNorm(), (a.x - c.x).squaredNorm()});
    return (b.x - a.x).cross(c.x - a.x).dot((a.n + b.n + c.n).normalized()) / longest;
  }

  const std::vector<MeshVertex>& points_;
  const MeshBorder& border_;
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

std::optional<HalfEdges> close_gaps(const std::vector<MeshVertex>& points, const MeshBorder& border,
                                    std::vector<Triangle> certain, const std::vector<Triangle>& candidates) {
  Patchwork patches(points, border, std::move(certain));
  for (const Triangle& t : candidates) patches.add_if_room(t);
  if (!patches.fill()) return std::nullopt;
  return patches.whole();
}

}  // namespace geovor
