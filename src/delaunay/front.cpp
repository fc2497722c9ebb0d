#include "delaunay/front.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <optional>

#include "delaunay/edge_set.h"
#include "delaunay/place_order.h"
#include "delaunay/space_grid.h"
#include "surface/project.h"

namespace geovor {
namespace {

// No point stands nearer to another than this part of the size: rows that meet overlap by less than they leave open.
constexpr double kApart = 0.77;
// Nor to the border than this, where a whole edge is in the way.
constexpr double kOffBorder = 0.45;
// A way through a corner of the border meets both of its sides.
constexpr double kCorner = 0.05;
// Longer edges than this part of the size, between rows that met, are not built upon.
constexpr double kLongest = 1.5;
// The sides of a new triangle have the size and a little more, which makes up for the shorter ones where rows meet.
constexpr double kSide = 1.002;
// They follow the edge below them, between these parts of its length.
constexpr double kShortestSide = 0.75, kLongestSide = 1.4;
// The least height of a new triangle over its edge, in parts of the edge; for edges that are too long.
constexpr double kLeastHeight = 0.32;
// A point that is nearer by less than this part of the size is as near.
constexpr double kAsNear = 1e-7;
// Where there is no normal it is zero or not a number, else of length one.
constexpr double kLeastNormal = 0.5;
// A face that wants more points than this is asking for a mistake in the units.
constexpr size_t kMostPoints = 4'000'000;
// A face without a border is begun from a point this many times its extent away: one place of it is nearest.
constexpr double kFarAway = 4.0;

struct Edge {
  int a, b;
};

class Fronts {
 public:
  Fronts(const SurfaceProbe& probe, const SizeRule& rule, const SizeField& field, const MeshBorder& border)
      : probe_(probe), field_(field), border_(border), rule_(rule), order_(rule.size), points_(border.points) {
    for (size_t i = 0; i < points_.size(); ++i) {
      grid_.add(points_[i].x);
      if (border.on_border(static_cast<int>(i))) add_border(static_cast<int>(i));
    }
  }

  std::vector<MeshVertex> run() {
    if (border_edges_.empty()) {
      begin_anywhere();
    } else {
      begin_at_border();
    }
    while (!rows_.empty() || !closings_.empty()) {
      if (points_.size() > kMostPoints) return {};
      // What a row's new points bring goes first; edges to points that were there before wait until the rows have met.
      std::deque<Edge>& queue = rows_.empty() ? closings_ : rows_;
      const Edge e = queue.front();
      queue.pop_front();
      advance(e);
    }
    return std::move(points_);
  }

 private:
  const MeshVertex& at(int i) const { return points_[i]; }
  bool is_fixed(int i) const { return i < static_cast<int>(border_.points.size()); }
  PlaceOrder::Key key(const Edge& e) const { return order_.key(0.5 * (at(e.a).x + at(e.b).x)); }
  void add_border(int a) {
    const MeshVertex &from = at(a), &to = at(border_.next[a]);
    BorderEdges& edges = border_edges_[std::ilogb((to.x - from.x).norm()) + 1];
    for (const MeshVertex* end : {&from, &to}) {
      edges.ends.add(end->x);
      edges.of_end.push_back(a);
    }
  }

  void begin_at_border() {
    for (size_t i = 0; i < border_.points.size(); ++i) {
      if (!border_.on_border(static_cast<int>(i))) continue;
      const Edge e{static_cast<int>(i), border_.next[i]};
      used_.insert(e.a, e.b), used_.insert(e.b, e.a);
      rows_.push_back(e);
    }
    std::sort(rows_.begin(), rows_.end(), [&](const Edge& x, const Edge& y) { return key(x) < key(y); });
  }

  void begin_anywhere();
  std::optional<MeshVertex> drop(const Xyz& x, const MeshVertex& near) const;
  std::optional<MeshVertex> apex(const Edge& e) const;
  void advance(const Edge& e);
  int nearest(const MeshVertex& v, double reach);
  bool faces(int w, const MeshVertex& v) const;
  bool sees(int w, int v) const { return !is_fixed(w) || border_.sees(w, at(v).x); }
  bool meets_border(const Xyz& from, const MeshVertex& v, const Edge& e);
  void close(const Edge& e, int c, std::deque<Edge>& queue);

  int put(const MeshVertex& v) {
    grid_.add(v.x);
    points_.push_back(v);
    return static_cast<int>(points_.size()) - 1;
  }

  const SurfaceProbe& probe_;
  const SizeField& field_;
  const MeshBorder& border_;
  const SizeRule& rule_;
  PlaceOrder order_;
  std::vector<MeshVertex> points_;
  SpaceGrid grid_;
  /// Edges of the border that are no longer than a power of two.
  struct BorderEdges {
    SpaceGrid ends;
    std::vector<int> of_end;  ///< the edge's first point
  };
  std::map<int, BorderEdges> border_edges_;  ///< by the power: a long edge makes no search among short ones long
  EdgeSet used_;
  std::deque<Edge> rows_, closings_;
};

// The place of the face that is nearest to a point far away in a generic direction, and a first edge from there.
void Fronts::begin_anywhere() {
  double extent = rule_.size;
  const UvBox& box = probe_.box();
  for (const double u : {box.u.lo, box.u.middle(), box.u.hi}) {
    for (const double v : {box.v.lo, box.v.middle(), box.v.hi})
      extent = std::max(extent, probe_.position({u, v}).norm());
  }
  // A power of two, because the extent itself depends on where the parameters' middle is.
  const double away = kFarAway * std::exp2(std::ceil(std::log2(extent)));
  const Projection foot = project(probe_.surface(), away * PlaceOrder::first(), box);
  if (!foot.converged) return;
  const SurfaceSample s = probe_.at(foot.uv);
  if (!s.x.allFinite() || !(s.n.squaredNorm() > kLeastNormal)) return;
  MeshVertex first{s.x, s.n, field_.at(s.x, rule_.at(s.curvature)), -1, {foot.uv}, false, false};
  const Xyz way = (PlaceOrder::second() - PlaceOrder::second().dot(s.n) * s.n).normalized();
  const auto second = drop(s.x + first.h * way, first);
  if (!second) return;
  const int a = put(first), b = put(*second);
  used_.insert(a, b), used_.insert(b, a);
  rows_ = {{a, b}, {b, a}};
}

std::optional<MeshVertex> Fronts::drop(const Xyz& x, const MeshVertex& near) const {
  const Projection foot = project_near(probe_.surface(), x, near.uv[0], probe_.box());
  if (!foot.converged || !(foot.distance < near.h)) return std::nullopt;
  const SurfaceSample s = probe_.at(foot.uv);
  if (!s.x.allFinite() || !(s.n.squaredNorm() > kLeastNormal)) return std::nullopt;
  const double bound = near.h + rule_.gradation * (s.x - near.x).norm();
  return MeshVertex{s.x, s.n, field_.at(s.x, std::min(rule_.at(s.curvature), bound)), -1, {foot.uv}, false, false};
}

// The third corner of the triangle to the left of the edge. Its projection begins at the end that comes first in space.
std::optional<MeshVertex> Fronts::apex(const Edge& e) const {
  const MeshVertex &a = at(e.a), &b = at(e.b);
  const Xyz chord = b.x - a.x, n = (a.n + b.n).normalized();
  const double c = chord.norm(), h = std::clamp(kSide * 0.5 * (a.h + b.h), kShortestSide * c, kLongestSide * c);
  const double height = std::sqrt(std::max(h * h - 0.25 * c * c, kLeastHeight * kLeastHeight * c * c));
  const Xyz target = 0.5 * (a.x + b.x) + height * n.cross(chord).normalized();
  if (auto v = drop(target, a)) return v;
  return drop(target, b);
}

void Fronts::advance(const Edge& e) {
  const auto v = apex(e);
  if (!v) return;
  const double h = 0.5 * (at(e.a).h + at(e.b).h);
  const int near = nearest(*v, kApart * std::min(v->h, h));
  if (near >= 0) {
    if (near != e.a && near != e.b) close(e, near, closings_);
    return;
  }
  if (!meets_border(0.5 * (at(e.a).x + at(e.b).x), *v, e)) close(e, put(*v), rows_);
}

int Fronts::nearest(const MeshVertex& v, double reach) {
  int near = -1;
  double least = reach;
  grid_.each_near(v.x, reach, [&](int w) {
    const double d = (at(w).x - v.x).norm();
    if (!(d < least + kAsNear * reach) || !faces(w, v)) return;
    const bool tied = near >= 0 && d > least - kAsNear * reach;
    if (!tied && !(d < least)) return;
    if (tied && !(order_.key(at(w).x) < order_.key(at(near).x))) return;
    near = w;
    least = std::min(d, least);
  });
  return near;
}

// Another sheet of the face may be near in space, or the other side of the border.
bool Fronts::faces(int w, const MeshVertex& v) const {
  if (is_fixed(w) && border_.is_tip[w]) return true;
  if (is_fixed(w) && border_.is_one_of_many[w] && !border_.sees(w, v.x)) return false;
  return at(w).n.dot(v.n) > 0.0;
}

// Whether the border runs between the middle of the edge and the point, or close by the point.
bool Fronts::meets_border(const Xyz& from, const MeshVertex& v, const Edge& e) {
  bool meets = false;
  const Xyz way = v.x - from;
  const auto look_at = [&](int a) {
    if (meets) return;
    const int b = border_.next[a];
    const bool is_same = a == e.a && b == e.b;
    const bool is_other_side = at(a).border == at(e.b).border && at(b).border == at(e.a).border && at(a).border >= 0;
    if (is_same || is_other_side || !(at(a).n.dot(v.n) > 0.0)) return;
    const Xyz p = at(a).x - v.x, s = at(b).x - at(a).x;
    const double k = std::clamp(-p.dot(s) / s.squaredNorm(), 0.0, 1.0);
    if ((p + k * s).norm() < kOffBorder * v.h) {
      meets = true;
      return;
    }
    // Both ways seen along the normal: from + along * way meets a + across * s.
    const Xyz q = at(a).x - from;
    const double det = v.n.dot(way.cross(s)), along = v.n.dot(q.cross(s)) / det, across = v.n.dot(q.cross(way)) / det;
    const auto within = [](double x) { return x > -kCorner && x < 1.0 + kCorner; };
    meets = std::abs(q.dot(v.n)) < v.h && within(along) && within(across);
  };
  // An edge that is as near has an end that is nearer than half its length more.
  const double reach = std::max(std::hypot(way.norm(), v.h), kOffBorder * v.h);
  for (auto& [power, edges] : border_edges_) {
    edges.ends.each_near(v.x, reach + 0.5 * std::exp2(power), [&](int end) { look_at(edges.of_end[end]); });
  }
  return meets;
}

// The triangle e.a, e.b, c is seen; what is behind its other sides comes next. A side between two points of the border
// may cut a corner outside the face: nothing is behind it.
void Fronts::close(const Edge& e, int c, std::deque<Edge>& queue) {
  used_.insert(e.b, c), used_.insert(c, e.a);
  const double h = 0.5 * (at(e.a).h + at(e.b).h);
  std::array<Edge, 2> sides = {Edge{e.a, c}, Edge{c, e.b}};
  if (key(sides[1]) < key(sides[0])) std::swap(sides[0], sides[1]);
  for (const Edge& side : sides) {
    const bool is_short = (at(side.a).x - at(side.b).x).norm() < kLongest * h;
    if (is_short && sees(side.a, side.b) && sees(side.b, side.a) && used_.insert(side.a, side.b)) queue.push_back(side);
  }
}

}  // namespace

std::vector<MeshVertex> fill_by_fronts(const SurfaceProbe& probe, const SizeRule& rule, const SizeField& field,
                                       const MeshBorder& border) {
  return Fronts(probe, rule, field, border).run();
}

}  // namespace geovor
