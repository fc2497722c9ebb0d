#include "delaunay/refine.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include "delaunay/place_order.h"

namespace geovor {
namespace {

// A triangle is too large if its circumradius exceeds this share of the size wanted: with it, and after the
// smoothing, the median edge has the size wanted (an equilateral triangle has 0.577).
constexpr double kLargestRadius = 0.755;
// Two vertices are too close below this share of the size wanted.
constexpr double kClosest = 0.74;
// A triangle with a circumradius above this many sizes gets a vertex somewhere, if not at its Voronoi vertex.
constexpr double kFarTooLarge = 1.2;
constexpr int kSmoothings = 6;
// Weights of the two aims of smoothing: with them the angles are about the best, and 95 of 100 edges still within 1.12
// of the size.
constexpr double kForAngles = 0.65;
constexpr double kEquilateral = 0.8660254037844386;  // height of an equilateral triangle over its side
// A vertex that would move by less than this share of the size stays: the rest is left to the next round.
constexpr double kSmallMove = 1e-3;

double wanted(const SurfaceTriangulation& m, int t) {
  const auto [a, b, c] = m.topology().corners(t);
  return (m.vertex(a).h + m.vertex(b).h + m.vertex(c).h) / 3.0;
}

// Ratios are compared after rounding, far above their noise; equals are taken in the order of their places.
constexpr double kRatioRounding = 1e-6;

// Triangles that are too large, the largest relative to its size first.
class Worklist {
 public:
  explicit Worklist(const SurfaceTriangulation& mesh) : mesh_(mesh), order_(mesh.rule().size) {}
  void consider(int t) {
    if (!mesh_.topology().alive(t)) return;
    const double ratio = mesh_.circumradius(t) / (kLargestRadius * wanted(mesh_, t));
    if (!(ratio > 1.0)) return;
    const auto [a, b, c] = mesh_.topology().corners(t);
    const Xyz middle = (mesh_.vertex(a).x + mesh_.vertex(b).x + mesh_.vertex(c).x) / 3.0;
    queue_.push({std::round(ratio / kRatioRounding), order_.key(middle), t, {a, b, c}});
  }
  /// The next triangle that is still as it was when it was considered; kNone at the end.
  int next() {
    while (!queue_.empty()) {
      const Item item = queue_.top();
      queue_.pop();
      if (mesh_.topology().alive(item.t) && mesh_.topology().corners(item.t) == item.corners) return item.t;
    }
    return HalfEdges::kNone;
  }

 private:
  struct Item {
    double ratio;
    PlaceOrder::Key place;
    int t;
    std::array<int, 3> corners;
    bool operator<(const Item& o) const { return std::tie(ratio, o.place, o.t) < std::tie(o.ratio, place, t); }
  };
  const SurfaceTriangulation& mesh_;
  PlaceOrder order_;
  std::priority_queue<Item> queue_;
};

// Whether a point in triangle t stands so close to a fixed edge that only a sliver would fit between.
bool crowds_border(const SurfaceTriangulation& m, const Xyz& x, int t) {
  const HalfEdges& topo = m.topology();
  for (int e = 3 * t; e < 3 * t + 3; ++e) {
    if (!topo.fixed(e)) continue;
    const Xyz a = m.vertex(topo.origin(e)).x - x, b = m.vertex(topo.target(e)).x - x;
    constexpr double kWidestCosine = -0.5;  // the edge is seen under 120 degrees or more
    if (a.dot(b) < kWidestCosine * a.norm() * b.norm()) return true;
  }
  return false;
}

bool insert_near(SurfaceTriangulation& mesh, const Xyz& point, int t) {
  const int below = point.allFinite() ? mesh.locate(point, t) : HalfEdges::kNone;
  if (below == HalfEdges::kNone) return false;
  const auto vertex = mesh.drop(point, below);
  return vertex && !crowds_border(mesh, vertex->x, below) && mesh.insert(*vertex, below);
}

// The Voronoi vertex; where a border stands before it and the triangle is far too large, its middle.
bool insert_into(SurfaceTriangulation& mesh, int t) {
  if (insert_near(mesh, mesh.circumcentre(t), t)) return true;
  if (mesh.circumradius(t) < kFarTooLarge * wanted(mesh, t)) return false;
  const auto [a, b, c] = mesh.topology().corners(t);
  const Xyz middle = (mesh.vertex(a).x + mesh.vertex(b).x + mesh.vertex(c).x) / 3.0;
  for (int v : {a, b, c}) {
    if ((mesh.vertex(v).x - middle).norm() < kClosest * mesh.vertex(v).h) return false;
  }
  return insert_near(mesh, middle, t);
}

void insert_voronoi_vertices(SurfaceTriangulation& mesh) {
  Worklist work(mesh);
  for (int t = 0; t < mesh.topology().triangle_count(); ++t) work.consider(t);
  for (int t = work.next(); t != HalfEdges::kNone; t = work.next()) {
    if (!insert_into(mesh, t)) continue;
    const HalfEdges& topo = mesh.topology();
    for (int e : topo.star(topo.vertex_count() - 1)) {
      work.consider(e / 3);
      if (topo.twin(HalfEdges::next(e)) != HalfEdges::kNone) work.consider(topo.twin(HalfEdges::next(e)) / 3);
    }
  }
}

// Collapses edges that are too short, the shortest relative to its size first. Of two inner ends the one that comes
// first in space stays.
int thin_out(SurfaceTriangulation& mesh) {
  const HalfEdges& topo = mesh.topology();
  const PlaceOrder order(mesh.rule().size);
  struct Short {
    double ratio;
    PlaceOrder::Key place;
    int u, w;
  };
  std::vector<Short> shorts;
  for (int e = 0; e < 3 * topo.triangle_count(); ++e) {
    if (!topo.alive(e / 3) || topo.twin(e) == HalfEdges::kNone) continue;
    const MeshVertex &u = mesh.vertex(topo.origin(e)), &w = mesh.vertex(topo.target(e));
    const double ratio = (u.x - w.x).norm() / (kClosest * 0.5 * (u.h + w.h));
    if (u.border >= 0 || !(ratio < 1.0)) continue;
    if (w.border < 0 && order.key(u.x) < order.key(w.x)) continue;
    shorts.push_back(
        {std::round(ratio / kRatioRounding), order.key(0.5 * (u.x + w.x)), topo.origin(e), topo.target(e)});
  }
  std::sort(shorts.begin(), shorts.end(), [](const Short& a, const Short& b) {
    return std::tie(a.ratio, a.place, a.u) < std::tie(b.ratio, b.place, b.u);
  });
  int removed = 0;
  for (const Short& s : shorts) {
    if (topo.outgoing(s.u) == HalfEdges::kNone || topo.outgoing(s.w) == HalfEdges::kNone) continue;
    const int e = topo.find(s.u, s.w);
    if (e != HalfEdges::kNone && mesh.collapse(e)) ++removed;
  }
  return removed;
}

// Where a vertex should be for the sake of its star: mostly the mean of the places that would make its triangles
// equilateral, which widens angles, and a little the centroid of the star, each triangle weighted by the vertices that
// it should hold, area / h^2, which evens out lengths.
Xyz better_place(const SurfaceTriangulation& mesh, int v) {
  const HalfEdges& topo = mesh.topology();
  const Xyz& x = mesh.vertex(v).x;
  Xyz centroid = Xyz::Zero(), apex = Xyz::Zero();
  double weight = 0.0, count = 0.0;
  for (int e : topo.star(v)) {
    const Xyz &a = mesh.vertex(topo.target(e)).x, &b = mesh.vertex(topo.apex(e)).x;
    const Xyz side = b - a, height = (x - a) - (x - a).dot(side) / side.squaredNorm() * side;
    const double h = wanted(mesh, e / 3), w = side.norm() * height.norm() / (h * h);
    centroid += w * (a + b + x) / 3.0;
    weight += w;
    apex += 0.5 * (a + b) + kEquilateral * side.norm() * height.normalized();
    count += 1.0;
  }
  return (1.0 - kForAngles) * centroid / weight + kForAngles * apex / count;
}

// All vertices at once, so that their order does not matter.
void smooth(SurfaceTriangulation& mesh) {
  const HalfEdges& topo = mesh.topology();
  std::vector<std::pair<int, MeshVertex>> moves;
  for (int v = 0; v < topo.vertex_count(); ++v) {
    if (topo.outgoing(v) == HalfEdges::kNone || mesh.vertex(v).border >= 0) continue;
    const Xyz target = better_place(mesh, v);
    if (!((target - mesh.vertex(v).x).norm() > kSmallMove * mesh.vertex(v).h)) continue;
    if (auto to = mesh.drop_from(v, target)) moves.emplace_back(v, std::move(*to));
  }
  for (const auto& [v, to] : moves) mesh.move(v, to);
  mesh.flip_all();
}

// h(x) <= h(y) + gradation * |x - y| along the edges, from the smallest sizes outwards (Dijkstra's algorithm). Border
// points keep their sizes: they stand where they stand.
void grade(SurfaceTriangulation& mesh) {
  using Node = std::pair<double, int>;
  std::priority_queue<Node, std::vector<Node>, std::greater<>> queue;
  const HalfEdges& topo = mesh.topology();
  for (int v = 0; v < topo.vertex_count(); ++v) {
    if (topo.outgoing(v) != HalfEdges::kNone) queue.push({mesh.vertex(v).h, v});
  }
  while (!queue.empty()) {
    const auto [h, v] = queue.top();
    queue.pop();
    if (h > mesh.vertex(v).h) continue;
    for (int e : topo.star(v)) {
      for (int w : {topo.target(e), topo.apex(e)}) {
        const double bound = h + mesh.rule().gradation * (mesh.vertex(w).x - mesh.vertex(v).x).norm();
        if (mesh.vertex(w).border < 0 && bound < mesh.vertex(w).h) {
          mesh.set_size(w, bound);
          queue.push({bound, w});
        }
      }
    }
  }
}

}  // namespace

void refine(SurfaceTriangulation& mesh, int rounds) {
  mesh.decide_by_geodesics(false);
  mesh.flip_all();
  for (int round = 0; round < rounds; ++round) {
    grade(mesh);
    while (thin_out(mesh) > 0) {
    }
    insert_voronoi_vertices(mesh);
    for (int i = 0; i < kSmoothings; ++i) {
      mesh.decide_by_geodesics(round + 1 == rounds && i + 1 == kSmoothings);
      smooth(mesh);
    }
  }
  mesh.compact();
}

}  // namespace geovor
