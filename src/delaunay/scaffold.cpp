#include "delaunay/scaffold.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <queue>
#include <tuple>

#include "delaunay/polygon_triangulation.h"

namespace geovor {
namespace {

// An edge may be this much longer than the size wanted before it is halved: the halves are then not much too short.
constexpr double kSlack = 1.3;
// However coarse the rule: no edge turns the normal by more than this, or orientation could not be told from normals.
constexpr double kLargestTurn = std::numbers::pi / 5;
// Pieces into which an edge's image on the surface is cut to measure its length.
constexpr int kPieces = 4;
// Of two edges the longer one is longer by this share at least, so that a path of equal edges ends.
constexpr double kLonger = 1e-6;
// A quadrilateral is turned only if both new triangles keep this share of it in the parameter plane …
constexpr double kConvex = 1e-3;
// … and only for a diagonal that is at most this part of the old one.
constexpr double kShorter = 0.95;
// The lattice is fine enough almost everywhere. Where halving goes on far beyond it the parameterization is singular
// and normals mean nothing; what is there then has to do.
constexpr int kLeast = 20'000;
constexpr int kMostGrowth = 10;
// A face that wants more lattice points than this is asking for a mistake in the units.
constexpr int kMostVertices = 4'000'000;

struct PlaneVertex {
  Uv uv;
  Xyz x, n;
  double h = 0.0;
  int border = -1;
};

class Builder {
 public:
  Builder(const CadFace& face, const SurfaceProbe& probe, const BorderPoints& border, const SizeRule& rule)
      : face_(face), probe_(probe), border_(border), rule_(rule) {}
  Scaffold run();
  std::vector<int> faults();

 private:
  struct Candidate {
    double ratio;
    int edge, a, b;
    bool operator<(const Candidate& o) const { return std::tie(ratio, o.a, o.b) < std::tie(o.ratio, a, b); }
  };

  void collect_border();
  bool triangulate(const std::vector<Uv>& inner);
  std::vector<Uv> lattice() const;
  void halve_edges();
  void consider(int edge);
  PlaneVertex make_vertex(Uv uv, double h_bound) const;
  double image_length(int edge) const;
  double image_length(int from, int to) const;
  double image_length(Uv a, Uv b) const;
  UvBox border_box() const;
  bool flip_shortens(int edge) const;
  void shorten(std::vector<int> edges);
  int end_of_longest_path(int edge) const;
  void halve(int edge);
  Scaffold sew() const;

  const CadFace& face_;
  const SurfaceProbe& probe_;
  const BorderPoints& border_;
  const SizeRule& rule_;
  std::vector<std::vector<Uv>> loops_;
  std::vector<PlaneVertex> vertices_;
  HalfEdges mesh_;
  std::priority_queue<Candidate> queue_;
  Scaffold result_;
};

PlaneVertex Builder::make_vertex(Uv uv, double h_bound) const {
  const SurfaceSample s = probe_.at(uv);
  return {uv, s.x, s.n, std::min(rule_.at(s.curvature), h_bound), -1};
}

void Builder::collect_border() {
  for (const TrimLoop& loop : face_.loops) {
    std::vector<Uv> polygon;
    for (const Coedge& c : loop.coedges) {
      const BorderPoints::Edge& e = border_.edges[c.edge];
      std::vector<int> points = e.points;
      std::vector<double> t = e.t;
      if (points.size() < 2) {  // a pole: both ends of its p-curve are the same point
        if (points.empty()) continue;
        points = {points[0], points[0]};
        t = {c.range.lo, c.range.hi};
      }
      if (c.reversed) {
        std::reverse(points.begin(), points.end());
        std::reverse(t.begin(), t.end());
      }
      for (size_t i = 0; i + 1 < t.size(); ++i) {
        const auto p = c.pcurve->position(t[i]);
        const Uv uv{p.x(), p.y()};
        if (!polygon.empty() && polygon.back() == uv) continue;
        polygon.push_back(uv);
        PlaneVertex v = make_vertex(uv, border_.size[points[i]]);
        v.h = border_.size[points[i]];
        v.x = border_.points[points[i]];
        v.border = points[i];
        vertices_.push_back(v);
      }
    }
    loops_.push_back(polygon);
  }
}

bool Builder::triangulate(const std::vector<Uv>& inner) {
  const UvBox& box = probe_.box();
  const double aspect = probe_.v_speed() * box.v.length() / (probe_.u_speed() * box.u.length());
  PolygonTriangulation flat = triangulate_polygon(loops_, inner, std::isfinite(aspect) && aspect > 0.0 ? aspect : 1.0);
  if (!flat.ok) {
    result_.why = flat.why;
    for (int p : flat.bad_points) result_.bad_points.push_back(vertices_[p].border);
    return false;
  }
  mesh_ = std::move(flat.triangles);
  return true;
}

// The middles of boxes that are no longer, in space, than the size wanted there: each box is halved across its longer
// side.
std::vector<Uv> Builder::lattice() const {
  std::vector<Uv> middles;
  std::vector<UvBox> boxes = {border_box()};
  while (!boxes.empty() && middles.size() < static_cast<size_t>(kMostVertices)) {
    const UvBox box = boxes.back();
    boxes.pop_back();
    const Uv middle{box.u.middle(), box.v.middle()};
    const double h = kSlack * rule_.at(probe_.at(middle).curvature);
    const double across = image_length({box.u.lo, middle.v}, {box.u.hi, middle.v});
    const double along = image_length({middle.u, box.v.lo}, {middle.u, box.v.hi});
    if (!(std::max(across, along) > h)) {
      middles.push_back(middle);
    } else if (across > along) {
      boxes.push_back({{middle.u, box.u.hi}, box.v});
      boxes.push_back({{box.u.lo, middle.u}, box.v});
    } else {
      boxes.push_back({box.u, {middle.v, box.v.hi}});
      boxes.push_back({box.u, {box.v.lo, middle.v}});
    }
  }
  return middles;
}

UvBox Builder::border_box() const {
  UvBox box{{loops_[0][0].u, loops_[0][0].u}, {loops_[0][0].v, loops_[0][0].v}};
  for (const auto& loop : loops_) {
    for (Uv p : loop) {
      box.u = {std::min(box.u.lo, p.u), std::max(box.u.hi, p.u)};
      box.v = {std::min(box.v.lo, p.v), std::max(box.v.hi, p.v)};
    }
  }
  return box;
}

double Builder::image_length(int edge) const { return image_length(mesh_.origin(edge), mesh_.target(edge)); }

double Builder::image_length(int from, int to) const { return image_length(vertices_[from].uv, vertices_[to].uv); }

double Builder::image_length(Uv a, Uv b) const {
  double sum = 0.0;
  Xyz last = probe_.position(a);
  for (int i = 1; i <= kPieces; ++i) {
    const Xyz x = probe_.position(lerp(a, b, static_cast<double>(i) / kPieces));
    sum += (x - last).norm();
    last = x;
  }
  return sum;
}

void Builder::consider(int edge) {
  if (mesh_.twin(edge) == HalfEdges::kNone) return;
  const PlaneVertex &a = vertices_[mesh_.origin(edge)], &b = vertices_[mesh_.target(edge)];
  const double length = image_length(edge);
  const double h = std::min({a.h, b.h, rule_.size});
  const Xyz middle = probe_.at(lerp(a.uv, b.uv, 0.5)).n;
  const double cosine = std::min(
      {a.n.dot(b.n), 2.0 * a.n.dot(middle) * a.n.dot(middle) - 1.0, 2.0 * b.n.dot(middle) * b.n.dot(middle) - 1.0});
  const double turn = std::acos(std::clamp(cosine, -1.0, 1.0));
  // Where the normal turns on edges shorter than any rule asks for there is a crease, and halving would not mend it.
  const double floor = 0.5 * std::min(h, std::min(rule_.min_size, rule_.size));
  double ratio = length / (kSlack * h);
  if (length > floor) ratio = std::max(ratio, turn / kLargestTurn);
  if (ratio > 1.0) queue_.push({ratio, edge, mesh_.origin(edge), mesh_.target(edge)});
}

void Builder::halve_edges() {
  for (int e = 0; e < 3 * mesh_.triangle_count(); ++e) {
    if (e < mesh_.twin(e)) consider(e);
  }
  const int most = kLeast + kMostGrowth * mesh_.vertex_count();
  while (!queue_.empty() && mesh_.vertex_count() < most) {
    const Candidate c = queue_.top();
    queue_.pop();
    if (mesh_.origin(c.edge) != c.a || mesh_.target(c.edge) != c.b) continue;
    const int longest = end_of_longest_path(c.edge);
    if (longest == HalfEdges::kNone) continue;
    halve(longest);
    if (longest != c.edge && mesh_.origin(c.edge) == c.a && mesh_.target(c.edge) == c.b) queue_.push(c);
  }
}

// From triangle to triangle, always on to a longer edge: halving the last one first keeps the triangles from
// degenerating (Rivara's longest-edge propagation path), and a short edge beside a long one from being halved for ever.
// A path that ends on the border ends in nothing: border edges are as long as they are.
int Builder::end_of_longest_path(int edge) const {
  double length = image_length(edge);
  for (bool found = true; found;) {
    found = false;
    const int twin = mesh_.twin(edge);
    if (twin == HalfEdges::kNone) return HalfEdges::kNone;
    for (int e : {HalfEdges::next(edge), HalfEdges::prev(edge), HalfEdges::next(twin), HalfEdges::prev(twin)}) {
      const double other = image_length(e);
      if (other > length * (1.0 + kLonger)) {
        length = other;
        edge = e;
        found = true;
      }
    }
  }
  return edge;
}

void Builder::halve(int edge) {
  const PlaneVertex &a = vertices_[mesh_.origin(edge)], &b = vertices_[mesh_.target(edge)];
  const PlaneVertex middle =
      make_vertex(lerp(a.uv, b.uv, 0.5), std::max(a.h, b.h) + rule_.gradation * 0.5 * image_length(edge));
  const int v = mesh_.add_vertex();
  vertices_.push_back(middle);
  mesh_.split_edge(edge, v);
  std::vector<int> opposite;
  for (int e : mesh_.star(v)) {  // the edges opposite to v have new numbers: their old entries are dead
    consider(e);
    consider(HalfEdges::next(e));
    opposite.push_back(HalfEdges::next(e));
  }
  shorten(std::move(opposite));
}

// Whether the quadrilateral about the edge is convex in the parameter plane and its other diagonal clearly shorter in
// space.
bool Builder::flip_shortens(int edge) const {
  if (mesh_.fixed(edge)) return false;
  const int c = mesh_.apex(edge), d = mesh_.apex(mesh_.twin(edge));
  const Uv a = vertices_[mesh_.origin(edge)].uv, b = vertices_[mesh_.target(edge)].uv;
  const Uv p = vertices_[c].uv, q = vertices_[d].uv;
  const double whole = cross(b - a, p - a) + cross(q - a, b - a);
  if (!(cross(q - p, b - p) < -kConvex * whole) || !(cross(a - p, q - p) < -kConvex * whole)) return false;
  return image_length(c, d) < kShorter * image_length(edge);
}

// Each flip makes the sum of all lengths smaller, so this ends.
void Builder::shorten(std::vector<int> edges) {
  while (!edges.empty()) {
    const int e = edges.back();
    edges.pop_back();
    if (!flip_shortens(e)) continue;
    const int f = mesh_.twin(e);
    mesh_.flip(e);
    consider(e);
    for (int x : {HalfEdges::next(e), HalfEdges::prev(e), HalfEdges::next(f), HalfEdges::prev(f)}) {
      consider(x);
      edges.push_back(x);
    }
  }
}

// Border points become one vertex each, whatever number of times the loops pass them; triangles that lie in a pole
// vanish.
Scaffold Builder::sew() const {
  Scaffold out;
  std::vector<int> id(vertices_.size(), -1);
  std::map<int, int> of_border;
  for (size_t i = 0; i < vertices_.size(); ++i) {
    const PlaneVertex& p = vertices_[i];
    const auto known = p.border >= 0 ? of_border.find(p.border) : of_border.end();
    if (known != of_border.end()) {
      id[i] = known->second;
      MeshVertex& v = out.vertices[id[i]];
      v.uv.push_back(p.uv);
      v.n = (v.n + p.n).normalized();
      continue;
    }
    id[i] = static_cast<int>(out.vertices.size());
    if (p.border >= 0) of_border[p.border] = id[i];
    out.vertices.push_back({p.x, p.n, p.h, p.border, {p.uv}, false, false});
  }
  for (const TrimLoop& loop : face_.loops) {
    for (const Coedge& c : loop.coedges) {
      const BorderPoints::Edge& e = border_.edges[c.edge];
      if (e.points.size() != 1) continue;
      const auto a = c.pcurve->position(c.range.lo), b = c.pcurve->position(c.range.hi);
      MeshVertex& v = out.vertices[of_border.at(e.points[0])];
      (std::abs(a.x() - b.x()) > std::abs(a.y() - b.y()) ? v.free_u : v.free_v) = true;
    }
  }
  std::vector<std::array<int, 3>> triangles;
  for (int t = 0; t < mesh_.triangle_count(); ++t) {
    auto [a, b, c] = mesh_.corners(t);
    a = id[a], b = id[b], c = id[c];
    if (a != b && b != c && c != a) triangles.push_back({a, b, c});
  }
  out.triangles = HalfEdges(static_cast<int>(out.vertices.size()), triangles);
  for (const TrimLoop& loop : face_.loops) {
    for (const Coedge& c : loop.coedges) {
      const auto& points = border_.edges[c.edge].points;
      for (size_t i = 0; i + 1 < points.size(); ++i) {
        const int a = of_border.at(points[i]), b = of_border.at(points[i + 1]);
        for (int e : {out.triangles.find(a, b), out.triangles.find(b, a)}) {
          if (e != HalfEdges::kNone) out.triangles.set_fixed(e);
        }
      }
    }
  }
  for (int e = 0; e < 3 * out.triangles.triangle_count(); ++e) {
    if (out.triangles.twin(e) != HalfEdges::kNone) continue;
    const int a = out.vertices[out.triangles.origin(e)].border, b = out.vertices[out.triangles.target(e)].border;
    if (a >= 0 && b >= 0) continue;
    out.why = "its seam or pole can't be closed";
    return out;
  }
  out.ok = true;
  return out;
}

std::vector<int> Builder::faults() {
  collect_border();
  return triangulate({}) ? std::vector<int>{} : result_.bad_points;
}

Scaffold Builder::run() {
  collect_border();
  if (loops_.empty() || loops_[0].empty()) {
    result_.why = "it has no border";
    return result_;
  }
  const std::vector<Uv> inner = lattice();
  if (inner.size() >= static_cast<size_t>(kMostVertices)) {
    result_.why = "it wants more than " + std::to_string(kMostVertices) + " vertices at this size";
    return result_;
  }
  if (!triangulate(inner)) return result_;
  for (Uv p : inner) vertices_.push_back(make_vertex(p, rule_.size));
  halve_edges();
  return sew();
}

}  // namespace

Scaffold build_scaffold(const CadFace& face, const SurfaceProbe& probe, const BorderPoints& border,
                        const SizeRule& rule) {
  return Builder(face, probe, border, rule).run();
}

std::vector<int> border_faults(const CadFace& face, const SurfaceProbe& probe, const BorderPoints& border) {
  const SizeRule rule;
  return Builder(face, probe, border, rule).faults();
}

}  // namespace geovor
