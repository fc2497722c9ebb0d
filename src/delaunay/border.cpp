#include "delaunay/border.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <queue>
#include <tuple>

#include "delaunay/arc_length.h"
#include "delaunay/border_curvature.h"
#include "delaunay/surface_probe.h"
#include "surface/project.h"

namespace geovor {
namespace {

// Stations of an edge, where size and turn are looked at: at equal steps of its length.
constexpr double kStationsPerSize = 2.0;
constexpr int kFewestStations = 24;
constexpr int kMostStations = 4000;
// The ends of an edge are looked at these parts of a step inside, since there the speed of a parameter may vanish: the
// second derivatives need more room than the first.
constexpr double kInside = 0.25;
constexpr double kTangentInside = 1e-3;
// The faces' curvature is looked at beside the edge, at this part of the size or of the edge's length.
constexpr double kBeside = 0.1;
// Sizes that curvature asks for are taken in steps of this many an octave, far above the noise of second derivatives,
// so that they are the same under every parameterization; the shift keeps round ratios away from the steps' ends.
constexpr double kStepsPerOctave = 512.0;
constexpr double kShiftOfSteps = 0.3819660112501051;
// A number that is rounded to a whole one is lowered by this part, so that rounding does not decide a tie.
constexpr double kRounding = 1e-9;
// However coarse the rule: a segment turns by no more than this, so that a hole stays a hole.
constexpr double kLargestTurn = std::numbers::pi / 4;

// An edge shorter than this share of the smallest size is an accident of the CAD: its neighbours need not follow.
constexpr double kShortest = 0.02;
// Of a turn that was summed up from chords, in parts of kLargestTurn.
constexpr double kRoundingOfTurn = 1e-6;
// A border point's size is at most this many times the length of its segments.
constexpr double kFollow = 1.3;

struct Use {
  int face;
  const Coedge* coedge;
};

// One edge, looked at closely.
struct Stations {
  std::vector<double> s;  // arc length from the start
  std::vector<double> h;
  std::optional<ArcLength> way;
  double turn = 0.0;  // of the tangent, in all
};

double curve_curvature(const CurveJet<3>& j) {
  const double speed = j.d1.norm();
  const double k = j.d1.cross(j.d2).norm() / (speed * speed * speed);
  return std::isfinite(k) ? k : 0.0;
}

// Below this relative growth of h over a piece its series is exact to rounding.
constexpr double kEven = 1e-8;

// The integral of ds / h over a piece of length s on which h runs linearly from h0 to h1: where the gradation rules it
// does.
double segments_between(double s, double h0, double h1) {
  const double growth = (h1 - h0) / h0;
  return s / h0 * (std::abs(growth) > kEven ? std::log1p(growth) / growth : 1.0 - growth / 2);
}

// The inverse: the share of the piece over which that integral is `count`.
double share_of_segments(double count, double s, double h0, double h1) {
  const double growth = (h1 - h0) / h0, x = count * h0 / s;
  return std::clamp(std::abs(growth) > kEven ? std::expm1(x * growth) / growth : x, 0.0, 1.0);
}

// h <= size, lowered to the next step; values that agree with the size to rounding are the size.
double in_steps(double h, double size) {
  const double steps = std::ceil(kStepsPerOctave * std::log2(size / h) - kShiftOfSteps);
  return steps > 0.0 ? size * std::exp2(-steps / kStepsPerOctave) : size;
}

class Sampler {
 public:
  Sampler(const CadModel& model, const SizeRule& rule, const std::vector<double>& finer)
      : model_(model), rule_(rule), finer_(finer), uses_(model.edges.size()), stations_(model.edges.size()) {}
  BorderPoints run();

 private:
  double surface_curvature(const Use& use, double t, const CurveJet<3>& j, double d) const;
  double size_at(int edge, double t, double d) const;
  void collect_uses();
  void look_at(int edge);
  void grade();
  void place(int edge);
  Xyz position(int edge, double t) const;
  int vertex_point(int vertex, int edge, double t);

  const CadModel& model_;
  const SizeRule& rule_;
  const std::vector<double>& finer_;
  std::vector<std::optional<SurfaceProbe>> probes_;  // of the faces
  std::vector<std::vector<Use>> uses_;
  std::vector<Stations> stations_;
  std::vector<double> vertex_size_;
  std::vector<int> point_of_vertex_;
  BorderPoints result_;
};

void Sampler::collect_uses() {
  probes_.resize(model_.faces.size());
  for (size_t f = 0; f < model_.faces.size(); ++f) {
    if (model_.faces[f].surface) probes_[f].emplace(*model_.faces[f].surface, parameter_box(model_.faces[f]));
    for (const TrimLoop& loop : model_.faces[f].loops) {
      for (const Coedge& c : loop.coedges) uses_[c.edge].push_back({static_cast<int>(f), &c});
    }
  }
}

double Sampler::surface_curvature(const Use& use, double t, const CurveJet<3>& j, double d) const {
  if (!probes_[use.face]) return 0.0;
  const CurveJet<2> p = use.coedge->pcurve->jet(t);
  const double left = use.coedge->reversed ? -1.0 : 1.0;
  return curvature_beside(*probes_[use.face],
                          {{p.C.x(), p.C.y()}, left * UvVec{-p.d1.y(), p.d1.x()}, j.C, j.d1.normalized()}, d);
}

double Sampler::size_at(int edge, double t, double d) const {
  const CurveJet<3> j = model_.edges[edge].curve->jet(t);
  double curvature = curve_curvature(j);
  for (const Use& use : uses_[edge]) curvature = std::max(curvature, surface_curvature(use, t, j, d));
  return in_steps(rule_.at(curvature), rule_.size) / finer_[edge];
}

void Sampler::look_at(int edge) {
  const CadEdge& e = model_.edges[edge];
  Stations& st = stations_[edge];
  st.way.emplace(*e.curve, e.range);
  const double length = st.way->length();
  const double wanted = std::ceil((1.0 - kRounding) * kStationsPerSize * length / rule_.size);
  const int steps = static_cast<int>(std::clamp<double>(wanted, kFewestStations, kMostStations));
  const double step = length / steps, beside = kBeside * std::min(rule_.size, length);
  const auto inside = [&](double s, double part) {
    return st.way->parameter(std::clamp(s, part * step, length - part * step));
  };
  Xyz last_tangent = Xyz::Zero();
  for (int k = 0; k <= steps; ++k) {
    const double s = length * k / steps, t = inside(s, kInside);
    const Xyz tangent = e.curve->jet(k == 0 || k == steps ? inside(s, kTangentInside) : t).d1.normalized();
    if (k > 0) st.turn += std::atan2(last_tangent.cross(tangent).norm(), last_tangent.dot(tangent));
    last_tangent = tangent;
    st.s.push_back(s);
    st.h.push_back(size_at(edge, t, beside));
  }
  // An edge shorter than its size is one segment, and its neighbours must be allowed to be as short.
  for (double& h : st.h) h = std::min(h, std::max(length, kShortest * rule_.min_size));
}

// h(x) <= h(y) + gradation * (distance along the edges): Dijkstra's algorithm with the stations as nodes.
void Sampler::grade() {
  vertex_size_.assign(model_.vertices.size(), rule_.size);
  struct Node {
    double h;
    int edge;  // -1: a vertex
    int index;
    bool operator>(const Node& o) const { return std::tie(h, edge, index) > std::tie(o.h, o.edge, o.index); }
  };
  std::priority_queue<Node, std::vector<Node>, std::greater<>> queue;
  std::vector<std::vector<std::pair<int, bool>>> at_vertex(model_.vertices.size());
  for (size_t e = 0; e < stations_.size(); ++e) {
    for (size_t i = 0; i < stations_[e].s.size(); ++i)
      queue.push({stations_[e].h[i], static_cast<int>(e), static_cast<int>(i)});
    if (model_.edges[e].first_vertex >= 0)
      at_vertex[model_.edges[e].first_vertex].push_back({static_cast<int>(e), true});
    if (model_.edges[e].last_vertex >= 0)
      at_vertex[model_.edges[e].last_vertex].push_back({static_cast<int>(e), false});
  }
  const auto lower = [&queue](double& h, double bound, int edge, int index) {
    if (bound < h) {
      h = bound;
      queue.push({h, edge, index});
    }
  };
  while (!queue.empty()) {
    const Node n = queue.top();
    queue.pop();
    if (n.edge < 0) {
      if (n.h > vertex_size_[n.index]) continue;
      for (const auto& [e, first] : at_vertex[n.index]) {
        Stations& st = stations_[e];
        if (st.s.empty()) continue;
        const int i = first ? 0 : static_cast<int>(st.s.size()) - 1;
        lower(st.h[i], n.h, e, i);
      }
      continue;
    }
    Stations& st = stations_[n.edge];
    if (n.h > st.h[n.index]) continue;
    const int last = static_cast<int>(st.s.size()) - 1;
    for (int i : {n.index - 1, n.index + 1}) {
      if (i < 0 || i > last) continue;
      lower(st.h[i], n.h + rule_.gradation * std::abs(st.s[i] - st.s[n.index]), n.edge, i);
    }
    const CadEdge& e = model_.edges[n.edge];
    if (n.index == 0 && e.first_vertex >= 0) lower(vertex_size_[e.first_vertex], n.h, -1, e.first_vertex);
    if (n.index == last && e.last_vertex >= 0) lower(vertex_size_[e.last_vertex], n.h, -1, e.last_vertex);
  }
}

// A border that one face alone uses lies on that face, below the edge's own curve (its p-curve may run ahead or behind
// along the edge); a shared one on the curve.
Xyz Sampler::position(int edge, double t) const {
  const Xyz on_curve = model_.edges[edge].curve->position(t);
  const auto& uses = uses_[edge];
  const bool one_face =
      !uses.empty() && std::all_of(uses.begin(), uses.end(), [&](const Use& u) { return u.face == uses[0].face; });
  if (!one_face || !model_.faces[uses[0].face].surface) return on_curve;
  const Surface& surface = *model_.faces[uses[0].face].surface;
  const auto p = uses[0].coedge->pcurve->position(t);
  const Xyz on_surface = surface.position({p.x(), p.y()});
  const Projection below = project_near(surface, on_curve, {p.x(), p.y()}, surface.domain());
  return below.converged && below.distance <= (on_surface - on_curve).norm() ? below.foot : on_surface;
}

int Sampler::vertex_point(int vertex, int edge, double t) {
  if (vertex >= 0 && point_of_vertex_[vertex] >= 0) return point_of_vertex_[vertex];
  const bool degenerate = model_.edges[edge].degenerate();
  result_.points.push_back(degenerate ? model_.vertices[vertex].position : position(edge, t));
  result_.size.push_back(vertex >= 0 ? vertex_size_[vertex] : rule_.size);
  const int id = static_cast<int>(result_.points.size()) - 1;
  if (vertex >= 0) point_of_vertex_[vertex] = id;
  return id;
}

void Sampler::place(int edge) {
  const CadEdge& e = model_.edges[edge];
  BorderPoints::Edge& out = result_.edges[edge];
  if (e.degenerate()) return;
  const Stations& st = stations_[edge];
  std::vector<double> work(st.s.size(), 0.0);  // the integral of ds / h
  for (size_t i = 1; i < st.s.size(); ++i) {
    work[i] = work[i - 1] + segments_between(st.s[i] - st.s[i - 1], st.h[i - 1], st.h[i]);
  }
  const bool closed = e.first_vertex == e.last_vertex;
  const int least = std::max(closed ? 3 : 1, static_cast<int>(std::ceil(st.turn / kLargestTurn - kRoundingOfTurn)));
  const int n = std::max(least, static_cast<int>(std::lround((1.0 - kRounding) * work.back())));
  out.points.push_back(vertex_point(e.first_vertex, edge, e.range.lo));
  out.t.push_back(e.range.lo);
  size_t i = 1;
  for (int k = 1; k < n; ++k) {
    const double target = work.back() * k / n;
    while (i + 1 < work.size() && work[i] < target) ++i;
    const double part = share_of_segments(target - work[i - 1], st.s[i] - st.s[i - 1], st.h[i - 1], st.h[i]);
    const double t = st.way->parameter(st.s[i - 1] + part * (st.s[i] - st.s[i - 1]));
    out.t.push_back(t);
    out.points.push_back(static_cast<int>(result_.points.size()));
    result_.points.push_back(position(edge, t));
    result_.size.push_back(st.h[i - 1] + part * (st.h[i] - st.h[i - 1]));
  }
  out.points.push_back(closed ? out.points.front() : vertex_point(e.last_vertex, edge, e.range.hi));
  out.t.push_back(e.range.hi);
  // Where the points had to be closer than the rule asks, the mesh beside them has to follow.
  for (int k = 0; k < n; ++k) {
    const int a = out.points[k], b = out.points[k + 1];
    const double spacing =
        std::max(kFollow * (result_.points[b] - result_.points[a]).norm(), kShortest * rule_.min_size);
    result_.size[a] = std::min(result_.size[a], spacing);
    result_.size[b] = std::min(result_.size[b], spacing);
  }
}

BorderPoints Sampler::run() {
  collect_uses();
  for (size_t e = 0; e < model_.edges.size(); ++e) {
    if (!model_.edges[e].degenerate()) look_at(static_cast<int>(e));
  }
  grade();
  result_.edges.resize(model_.edges.size());
  point_of_vertex_.assign(model_.vertices.size(), -1);
  for (size_t e = 0; e < model_.edges.size(); ++e) place(static_cast<int>(e));
  // Poles last: most of them are ends of other edges already.
  for (size_t e = 0; e < model_.edges.size(); ++e) {
    const CadEdge& edge = model_.edges[e];
    if (!edge.degenerate() || edge.first_vertex < 0) continue;
    result_.edges[e].points = {vertex_point(edge.first_vertex, static_cast<int>(e), 0.0)};
    result_.edges[e].t = {0.0};
  }
  return result_;
}

}  // namespace

BorderPoints sample_border(const CadModel& model, const SizeRule& rule, const std::vector<double>& finer) {
  return Sampler(model, rule, finer).run();
}

}  // namespace geovor
