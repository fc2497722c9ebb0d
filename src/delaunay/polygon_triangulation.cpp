#include "delaunay/polygon_triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>

#include "base/interval.h"

// Incremental insertion with exact predicates on integers: with coordinates below 2^31 the determinant of orient()
// stays below 2^64 and is computed in 128 bits. Constraints come in by flipping the edges that cross them (Sloan 1993).

namespace geovor {
namespace {

constexpr std::int64_t kGridCells = std::int64_t{1} << 30;
constexpr double kGrid = static_cast<double>(kGridCells);

struct Lattice {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

__extension__ using Wide = __int128;

// Exact, with its sign: of thin triangles rounding would leave neither.
Wide twice_area(const Lattice& a, const Lattice& b, const Lattice& c) {
  return static_cast<Wide>(b.x - a.x) * (c.y - a.y) - static_cast<Wide>(b.y - a.y) * (c.x - a.x);
}

// > 0: c lies to the left of the line from a to b.
int orient(const Lattice& a, const Lattice& b, const Lattice& c) {
  const Wide det = twice_area(a, b, c);
  return det > 0 ? 1 : det < 0 ? -1 : 0;
}

class Builder {
 public:
  Builder(const std::vector<std::vector<Uv>>& loops, const std::vector<Uv>& inner, double aspect);
  PolygonTriangulation run();

 private:
  bool insert_point(int v);
  void insert_inner();
  void put(int v, int t, int on_edge);
  int locate(const Lattice& p, int& on_edge) const;
  void legalize(std::vector<int> edges);
  bool improves(int e) const;
  bool convex(int e) const;
  bool insert_segment(int a, int b);
  bool crossing_edges(int a, int b, std::deque<std::array<int, 2>>& crossed);
  void fail(const char* why, std::initializer_list<int> points);
  HalfEdges region() const;

  std::vector<int> loop_sizes_;
  std::vector<Lattice> points_;  // of the polygon, then the three of the triangle around it
  double aspect_;
  int border_count_ = 0;
  int count_ = 0;
  HalfEdges mesh_;
  mutable int last_ = 0;
  PolygonTriangulation result_;
};

Builder::Builder(const std::vector<std::vector<Uv>>& loops, const std::vector<Uv>& inner, double aspect)
    : aspect_(aspect) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  UvBox box{{kInf, -kInf}, {kInf, -kInf}};
  for (const auto& loop : loops) {
    loop_sizes_.push_back(static_cast<int>(loop.size()));
    for (Uv p : loop) {
      box.u = {std::min(box.u.lo, p.u), std::max(box.u.hi, p.u)};
      box.v = {std::min(box.v.lo, p.v), std::max(box.v.hi, p.v)};
    }
  }
  const auto snap = [](double x, Interval r) {
    return r.length() > 0 ? std::llround((x - r.lo) / r.length() * kGrid) : 0LL;
  };
  for (const auto& loop : loops) {
    for (Uv p : loop) points_.push_back({snap(p.u, box.u), snap(p.v, box.v)});
  }
  border_count_ = static_cast<int>(points_.size());
  for (Uv p : inner) points_.push_back({snap(p.u, box.u), snap(p.v, box.v)});
  count_ = static_cast<int>(points_.size());
  // A triangle that holds the box [0, 2^30]^2 well inside; its coordinates stay below 2^33.
  const std::int64_t g = kGridCells;
  points_.push_back({-2 * g, -g});
  points_.push_back({4 * g, -g});
  points_.push_back({g / 2, 5 * g});
  mesh_ = HalfEdges(count_ + 3, {{count_, count_ + 1, count_ + 2}});
}

void Builder::fail(const char* why, std::initializer_list<int> points) {
  result_.ok = false;
  result_.why = why;
  result_.bad_points = points;
}

// The triangle that holds p, walking from the last one; on_edge is the half-edge that p lies on, if any.
int Builder::locate(const Lattice& p, int& on_edge) const {
  int t = mesh_.alive(last_) ? last_ : 0;
  int from = HalfEdges::kNone;
  for (;;) {
    int go = HalfEdges::kNone;
    on_edge = HalfEdges::kNone;
    for (int i = 0; i < 3; ++i) {
      const int e = 3 * t + i;
      const int side = orient(points_[mesh_.origin(e)], points_[mesh_.target(e)], p);
      if (side < 0 && mesh_.twin(e) != HalfEdges::kNone && e != from) go = e;
      if (side == 0) on_edge = e;
    }
    if (go == HalfEdges::kNone) break;
    from = mesh_.twin(go);
    t = HalfEdges::triangle(from);
  }
  last_ = t;
  return t;
}

bool Builder::insert_point(int v) {
  int on_edge = HalfEdges::kNone;
  const int t = locate(points_[v], on_edge);
  for (int corner : mesh_.corners(t)) {
    if (points_[corner].x == points_[v].x && points_[corner].y == points_[v].y) {
      fail("two points of its border coincide", {corner, v});
      return false;
    }
  }
  put(v, t, on_edge);
  return true;
}

void Builder::put(int v, int t, int on_edge) {
  if (on_edge == HalfEdges::kNone) {
    mesh_.split_triangle(t, v);
  } else {
    mesh_.split_edge(on_edge, v);
  }
  std::vector<int> opposite;
  for (int e : mesh_.star(v)) opposite.push_back(HalfEdges::next(e));
  legalize(opposite);
}

// Inner points that fall on the border or on another point are not needed.
void Builder::insert_inner() {
  for (int v = border_count_; v < count_; ++v) {
    const Lattice& p = points_[v];
    if (p.x < 0 || p.y < 0 || p.x > kGridCells || p.y > kGridCells) continue;
    int on_edge = HalfEdges::kNone;
    const int t = locate(p, on_edge);
    if (on_edge != HalfEdges::kNone && mesh_.fixed(on_edge)) continue;
    const auto corners = mesh_.corners(t);
    if (std::any_of(corners.begin(), corners.end(), [&](int c) { return points_[c].x == p.x && points_[c].y == p.y; }))
      continue;
    put(v, t, on_edge);
  }
}

bool Builder::convex(int e) const {
  const int f = mesh_.twin(e);
  const Lattice &a = points_[mesh_.origin(e)], &b = points_[mesh_.target(e)];
  const Lattice &c = points_[mesh_.apex(e)], &d = points_[mesh_.apex(f)];
  return orient(d, b, c) > 0 && orient(c, a, d) > 0;
}

// The Delaunay criterion by the two angles opposite the edge; rounding only costs beauty here.
bool Builder::improves(int e) const {
  const auto cotangent = [this](int edge) {
    const Lattice &c = points_[mesh_.apex(edge)], &a = points_[mesh_.origin(edge)], &b = points_[mesh_.target(edge)];
    const double dot = static_cast<double>(a.x - c.x) * static_cast<double>(b.x - c.x) +
                       aspect_ * aspect_ * static_cast<double>(a.y - c.y) * static_cast<double>(b.y - c.y);
    return dot / (aspect_ * static_cast<double>(twice_area(c, a, b)));
  };
  constexpr double kMargin = 1e-9;  // a square's two diagonals are equally good
  const double c = cotangent(e), d = cotangent(mesh_.twin(e));
  return c + d < -kMargin * (1.0 + std::abs(c) + std::abs(d));
}

void Builder::legalize(std::vector<int> edges) {
  // Each flip lowers the Dirichlet energy, so this ends; the bound guards against rounding in `improves`.
  long budget = 100L * (mesh_.triangle_count() + 100);
  while (!edges.empty() && budget-- > 0) {
    const int e = edges.back();
    edges.pop_back();
    if (mesh_.fixed(e) || !convex(e) || !improves(e)) continue;
    const int f = mesh_.twin(e);
    mesh_.flip(e);
    for (int x : {HalfEdges::next(e), HalfEdges::prev(e), HalfEdges::next(f), HalfEdges::prev(f)}) edges.push_back(x);
  }
}

// The edges that the segment from a to b crosses, in its order; by their ends, because a flip renumbers its neighbours.
bool Builder::crossing_edges(int a, int b, std::deque<std::array<int, 2>>& crossed) {
  const Lattice &pa = points_[a], &pb = points_[b];
  int e = HalfEdges::kNone;
  for (int s : mesh_.star(a)) {
    const int opposite = HalfEdges::next(s);
    const int right = orient(pa, pb, points_[mesh_.origin(opposite)]);
    const int left = orient(pa, pb, points_[mesh_.target(opposite)]);
    if (right < 0 && left > 0) e = opposite;
    if (right == 0 && orient(pa, points_[mesh_.target(s)], pb) == 0) {
      const Lattice& c = points_[mesh_.target(s)];
      const bool ahead =
          static_cast<Wide>(c.x - pa.x) * (pb.x - pa.x) + static_cast<Wide>(c.y - pa.y) * (pb.y - pa.y) > 0;
      if (ahead) {
        fail("its border touches itself", {a, b, mesh_.target(s)});
        return false;
      }
    }
  }
  while (e != HalfEdges::kNone) {
    if (mesh_.fixed(e)) {
      fail("its border crosses itself", {a, b, mesh_.origin(e), mesh_.target(e)});
      return false;
    }
    crossed.push_back({mesh_.origin(e), mesh_.target(e)});
    const int f = mesh_.twin(e);
    const int c = mesh_.apex(f);
    if (c == b) return true;
    const int side = orient(pa, pb, points_[c]);
    if (side == 0) {
      fail("its border touches itself", {a, b, c});
      return false;
    }
    e = side > 0 ? HalfEdges::next(f) : HalfEdges::prev(f);
  }
  fail("its border has no inside", {a, b});
  return false;
}

bool Builder::insert_segment(int a, int b) {
  int e = mesh_.find(a, b);
  if (e == HalfEdges::kNone) {
    std::deque<std::array<int, 2>> crossed;
    if (!crossing_edges(a, b, crossed)) return false;
    std::vector<int> created;
    while (!crossed.empty()) {
      const int x = mesh_.find(crossed.front()[0], crossed.front()[1]);
      crossed.pop_front();
      if (!convex(x)) {
        crossed.push_back({mesh_.origin(x), mesh_.target(x)});
        continue;
      }
      mesh_.flip(x);
      const int sa = orient(points_[a], points_[b], points_[mesh_.origin(x)]);
      const int sb = orient(points_[a], points_[b], points_[mesh_.target(x)]);
      if (sa * sb < 0) {
        crossed.push_back({mesh_.origin(x), mesh_.target(x)});
      } else {
        created.push_back(x);
      }
    }
    e = mesh_.find(a, b);
    if (e == HalfEdges::kNone) {
      fail("its border crosses itself", {a, b});
      return false;
    }
    mesh_.set_fixed(e);
    legalize(created);
    return true;
  }
  mesh_.set_fixed(e);
  return true;
}

// Keeps the triangles inside by the even-odd rule: each crossing of a border segment changes sides.
HalfEdges Builder::region() const {
  constexpr int kUnknown = -1;
  std::vector<int> inside(mesh_.triangle_count(), kUnknown);
  std::vector<int> stack;
  const int start = HalfEdges::triangle(mesh_.outgoing(count_));
  inside[start] = 0;
  stack.push_back(start);
  while (!stack.empty()) {
    const int t = stack.back();
    stack.pop_back();
    for (int e = 3 * t; e < 3 * t + 3; ++e) {
      const int f = mesh_.twin(e);
      if (f == HalfEdges::kNone || inside[f / 3] != kUnknown) continue;
      inside[f / 3] = mesh_.fixed(e) ? 1 - inside[t] : inside[t];
      stack.push_back(f / 3);
    }
  }
  std::vector<std::array<int, 3>> kept;
  for (int t = 0; t < mesh_.triangle_count(); ++t) {
    if (inside[t] == 1) kept.push_back(mesh_.corners(t));
  }
  return {count_, kept};
}

PolygonTriangulation Builder::run() {
  result_.ok = true;
  for (int v = 0; v < border_count_; ++v) {
    if (!insert_point(v)) return result_;
  }
  int first = 0;
  for (int size : loop_sizes_) {
    for (int i = 0; i < size; ++i) {
      if (!insert_segment(first + i, first + (i + 1) % size)) return result_;
    }
    first += size;
  }
  insert_inner();
  result_.triangles = region();
  if (result_.triangles.triangle_count() == 0) fail("its border encloses nothing", {});
  return result_;
}

}  // namespace

PolygonTriangulation triangulate_polygon(const std::vector<std::vector<Uv>>& loops, const std::vector<Uv>& inner,
                                         double aspect) {
  return Builder(loops, inner, aspect).run();
}

}  // namespace geovor
