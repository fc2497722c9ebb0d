#include "delaunay/border.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <string>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "surface/project.h"

namespace geovor {
namespace {

// An edge that wants more segments is asking for a mistake in the units.
constexpr double kMostSegments = 1e6;
// However coarse the rule: a segment turns by no more than this, so that a hole stays a hole.
constexpr double kLargestTurn = std::numbers::pi / 4;
// An edge shorter than this share of the smallest size is an accident of the CAD: its neighbours need not follow.
constexpr double kShortest = 0.02;
// Of a turn that was summed up from chords, in parts of kLargestTurn.
constexpr double kRoundingOfTurn = 1e-6;
// A number of segments is lowered by this part before it is rounded, so that rounding does not decide a tie.
constexpr double kRounding = 1e-9;
// A border point's size is at most this many times the length of its segments.
constexpr double kFollow = 1.3;

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

using StationSizes = std::vector<std::vector<double>>;  // of the edges

// h(x) <= h(y) + gradation * (distance along the edges and straight across narrow faces): Dijkstra's algorithm with the
// stations as nodes.
class Grading {
 public:
  Grading(const CadModel& model, const std::vector<std::optional<EdgeStations>>& stations,
          const std::vector<std::vector<NarrowSizes::Link>>& links, double gradation)
      : model_(model), stations_(stations), links_(links), gradation_(gradation) {}
  void run(StationSizes& sizes, std::vector<double>& vertex);

 private:
  struct Node {
    double h;
    int edge;  // -1: a vertex
    int index;
    bool operator>(const Node& o) const { return std::tie(h, edge, index) > std::tie(o.h, o.edge, o.index); }
  };
  void lower(double& h, double bound, int edge, int index) {
    if (!(bound < h)) return;
    h = bound;
    queue_.push({h, edge, index});
  }
  void from_vertex(const Node& node, StationSizes& sizes);
  void from_station(const Node& node, StationSizes& sizes, std::vector<double>& vertex);

  const CadModel& model_;
  const std::vector<std::optional<EdgeStations>>& stations_;
  const std::vector<std::vector<NarrowSizes::Link>>& links_;  // of the edges; none while these are not known
  double gradation_;
  std::priority_queue<Node, std::vector<Node>, std::greater<>> queue_;
  std::vector<std::vector<std::pair<int, bool>>> at_vertex_;  // edges, and whether they start there
};

void Grading::run(StationSizes& sizes, std::vector<double>& vertex) {
  at_vertex_.resize(model_.vertices.size());
  for (std::size_t e = 0; e < stations_.size(); ++e) {
    if (!stations_[e]) continue;
    const int edge = static_cast<int>(e);
    for (std::size_t i = 0; i < sizes[e].size(); ++i) queue_.push({sizes[e][i], edge, static_cast<int>(i)});
    if (model_.edges[e].first_vertex >= 0) at_vertex_[model_.edges[e].first_vertex].push_back({edge, true});
    if (model_.edges[e].last_vertex >= 0) at_vertex_[model_.edges[e].last_vertex].push_back({edge, false});
  }
  while (!queue_.empty()) {
    const Node node = queue_.top();
    queue_.pop();
    const double h = node.edge < 0 ? vertex[node.index] : sizes[node.edge][node.index];
    if (node.h > h) continue;
    node.edge < 0 ? from_vertex(node, sizes) : from_station(node, sizes, vertex);
  }
}

void Grading::from_vertex(const Node& node, StationSizes& sizes) {
  for (const auto& [e, first] : at_vertex_[node.index]) {
    const int i = first ? 0 : static_cast<int>(sizes[e].size()) - 1;
    lower(sizes[e][i], node.h, e, i);
  }
}

void Grading::from_station(const Node& node, StationSizes& sizes, std::vector<double>& vertex) {
  const std::vector<double>& s = stations_[node.edge]->s;
  std::vector<double>& h = sizes[node.edge];
  const int last = static_cast<int>(h.size()) - 1;
  for (int i : {node.index - 1, node.index + 1}) {
    if (i < 0 || i > last) continue;
    lower(h[i], node.h + gradation_ * std::abs(s[i] - s[node.index]), node.edge, i);
  }
  if (!links_.empty()) {
    const std::vector<NarrowSizes::Link>& across = links_[node.edge];
    auto link = std::lower_bound(across.begin(), across.end(), node.index,
                                 [](const NarrowSizes::Link& l, int station) { return l.station < station; });
    for (; link != across.end() && link->station == node.index; ++link) {
      lower(sizes[link->to_edge][link->to_station], node.h + gradation_ * link->distance, link->to_edge,
            link->to_station);
    }
  }
  const CadEdge& e = model_.edges[node.edge];
  if (node.index == 0 && e.first_vertex >= 0) lower(vertex[e.first_vertex], node.h, -1, e.first_vertex);
  if (node.index == last && e.last_vertex >= 0) lower(vertex[e.last_vertex], node.h, -1, e.last_vertex);
}

// The places on one edge, ends included.
struct Places {
  std::vector<double> t, h;
  std::vector<Xyz> x;
};

// A border that one face alone uses lies on that face, below the edge's own curve (its p-curve may run ahead or behind
// along the edge); a shared one on the curve.
Xyz position(const CadEdge& edge, const std::vector<FaceUse>& uses, double t) {
  const Xyz on_curve = edge.curve->position(t);
  const FaceUse& first = uses.front();
  const bool one_face = std::all_of(uses.begin(), uses.end(), [&](const FaceUse& u) { return u.face == first.face; });
  if (!one_face || !first.probe) return on_curve;
  const Surface& surface = first.probe->surface();
  const auto p = first.coedge->pcurve->position(t);
  const Xyz on_surface = surface.position({p.x(), p.y()});
  const Projection below = project_near(surface, on_curve, {p.x(), p.y()}, surface.domain());
  return below.converged && below.distance <= (on_surface - on_curve).norm() ? below.foot : on_surface;
}

// The size at the way s, linear between the stations.
double size_at(const EdgeStations& st, const std::vector<double>& h, double s) {
  const auto after = std::upper_bound(st.s.begin(), st.s.end() - 1, s);
  if (after == st.s.begin()) return h.front();
  const std::size_t i = static_cast<std::size_t>(after - st.s.begin());
  return h[i - 1] + (s - st.s[i - 1]) / (st.s[i] - st.s[i - 1]) * (h[i] - h[i - 1]);
}

// The piece of an edge between its caps.
struct Between {
  std::vector<double> s, h;
};

Between between_caps(const EdgeStations& st, const std::vector<double>& h, NarrowSizes::Caps caps) {
  if (!(caps.first > 0.0 || caps.last > 0.0)) return {st.s, h};
  const double lo = caps.first, hi = st.way.length() - caps.last;
  Between piece{{lo}, {size_at(st, h, lo)}};
  for (std::size_t i = 0; i < st.s.size(); ++i) {
    if (!(st.s[i] > lo && st.s[i] < hi)) continue;
    piece.s.push_back(st.s[i]);
    piece.h.push_back(h[i]);
  }
  piece.s.push_back(hi);
  piece.h.push_back(size_at(st, h, hi));
  return piece;
}

Places place(const CadEdge& edge, const std::vector<FaceUse>& uses, const EdgeStations& st,
             const std::vector<double>& h, NarrowSizes::Caps caps) {
  const Between piece = between_caps(st, h, caps);
  std::vector<double> work(piece.s.size(), 0.0);  // the integral of ds / h
  for (std::size_t i = 1; i < piece.s.size(); ++i) {
    work[i] = work[i - 1] + segments_between(piece.s[i] - piece.s[i - 1], piece.h[i - 1], piece.h[i]);
  }
  if (!(work.back() < kMostSegments)) {
    throw Error(ErrorCode::Usage, "Face" + std::to_string(uses.front().face + 1) +
                                      ": an edge asks for more than a million segments; raise the size or the "
                                      "smallest size, or loosen the deflection or the angle");
  }
  const bool closed = edge.first_vertex == edge.last_vertex;
  const int least = std::max(closed ? 3 : 1, static_cast<int>(std::ceil(st.turn / kLargestTurn - kRoundingOfTurn)));
  const int n = std::max(least, static_cast<int>(std::lround((1.0 - kRounding) * work.back())));
  Places places{{edge.range.lo}, {h.front()}, {position(edge, uses, edge.range.lo)}};
  const auto add = [&](double s, double size) {
    places.t.push_back(st.way.parameter(s));
    places.h.push_back(size);
    places.x.push_back(position(edge, uses, places.t.back()));
  };
  if (caps.first > 0.0) add(piece.s.front(), piece.h.front());
  std::size_t i = 1;
  for (int k = 1; k < n; ++k) {
    const double target = work.back() * k / n;
    while (i + 1 < work.size() && work[i] < target) ++i;
    const double step = piece.s[i] - piece.s[i - 1];
    const double part = share_of_segments(target - work[i - 1], step, piece.h[i - 1], piece.h[i]);
    add(piece.s[i - 1] + part * step, piece.h[i - 1] + part * (piece.h[i] - piece.h[i - 1]));
  }
  if (caps.last > 0.0) add(piece.s.back(), piece.h.back());
  places.t.push_back(edge.range.hi);
  places.h.push_back(h.back());
  places.x.push_back(position(edge, uses, edge.range.hi));
  return places;
}

// Gives the places their numbers.
class Numbering {
 public:
  Numbering(const CadModel& model, const std::vector<double>& vertex_size)
      : model_(model), vertex_size_(vertex_size), point_of_vertex_(model.vertices.size(), -1) {
    result.edges.resize(model.edges.size());
  }

  void add(int edge, const Places& places, double shortest) {
    const CadEdge& e = model_.edges[edge];
    BorderPoints::Edge& out = result.edges[edge];
    const std::size_t last = places.t.size() - 1;
    out.t = places.t;
    out.points.push_back(vertex(e.first_vertex, places.x[0], places.h[0]));
    for (std::size_t k = 1; k < last; ++k) out.points.push_back(point(places.x[k], places.h[k]));
    out.points.push_back(e.first_vertex == e.last_vertex ? out.points.front()
                                                         : vertex(e.last_vertex, places.x[last], places.h[last]));
    // Where the points had to be closer than the rule asks, the mesh beside them has to follow.
    for (std::size_t k = 0; k < last; ++k) {
      const int a = out.points[k], b = out.points[k + 1];
      const double spacing = std::max(kFollow * (result.points[b] - result.points[a]).norm(), shortest);
      result.size[a] = std::min(result.size[a], spacing);
      result.size[b] = std::min(result.size[b], spacing);
    }
  }

  void add_pole(int edge) {
    const int v = model_.edges[edge].first_vertex;
    if (v < 0) return;
    result.edges[edge].points = {vertex(v, model_.vertices[v].position, vertex_size_[v])};
    result.edges[edge].t = {0.0};
  }

  BorderPoints result;

 private:
  int point(const Xyz& x, double h) {
    result.points.push_back(x);
    result.size.push_back(h);
    return static_cast<int>(result.points.size()) - 1;
  }
  int vertex(int v, const Xyz& x, double h) {
    if (v < 0) return point(x, h);
    if (point_of_vertex_[v] < 0) point_of_vertex_[v] = point(x, vertex_size_[v]);
    return point_of_vertex_[v];
  }

  const CadModel& model_;
  const std::vector<double>& vertex_size_;
  std::vector<int> point_of_vertex_;
};

// The length below which an edge counts as an accident of the CAD.
double shortest(const std::vector<FaceUse>& uses) {
  double least = std::numeric_limits<double>::infinity();
  for (const FaceUse& use : uses) least = std::min(least, use.rule->min_size);
  return kShortest * least;
}

}  // namespace

struct BorderSampler::Sizes {
  StationSizes h;
  std::vector<double> vertex;
};

BorderSampler::BorderSampler(const CadModel& model, std::vector<SizeRule> rules, const ForEach& for_each)
    : model_(model),
      rules_(std::move(rules)),
      for_each_(for_each),
      probes_(model.faces.size()),
      uses_(model.edges.size()),
      stations_(model.edges.size()) {
  for_each_(static_cast<int>(model.faces.size()), [&](int f) {
    if (model.faces[f].surface) probes_[f].emplace(*model.faces[f].surface, parameter_box(model.faces[f]));
  });
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    for (const TrimLoop& loop : model.faces[f].loops) {
      for (const Coedge& c : loop.coedges) {
        uses_[c.edge].push_back({static_cast<int>(f), &c, probes_[f] ? &*probes_[f] : nullptr, &rules_[f]});
      }
    }
  }
  for_each_(static_cast<int>(model.edges.size()), [&](int e) {
    if (!model.edges[e].degenerate() && !uses_[e].empty()) stations_[e].emplace(look_along(model.edges[e], uses_[e]));
  });
  look_across();
}

void BorderSampler::look_across() {
  const Sizes sizes = graded_sizes(std::vector<double>(model_.edges.size(), 1.0));
  std::vector<NarrowFace> narrow(model_.faces.size());
  for_each_(static_cast<int>(model_.faces.size()), [&](int f) {
    if (probes_[f]) narrow[f] = narrow_places(model_, f, *probes_[f], rules_[f], uses_, stations_, sizes.h);
  });
  narrow_ = NarrowSizes(model_, narrow, uses_, stations_);
}

BorderSampler::Sizes BorderSampler::graded_sizes(const std::vector<double>& finer) const {
  const int edges = static_cast<int>(model_.edges.size());
  Sizes sizes{StationSizes(edges),
              std::vector<double>(model_.vertices.size(), std::numeric_limits<double>::infinity())};
  for (int e = 0; e < edges; ++e) {
    if (model_.edges[e].degenerate() && model_.edges[e].first_vertex >= 0) {
      double& pole = sizes.vertex[model_.edges[e].first_vertex];
      for (const FaceUse& use : uses_[e]) pole = std::min(pole, use.rule->size);
    }
    if (!stations_[e]) continue;
    // An edge shorter than its size is one segment, and its neighbours must be allowed to be as short.
    const double most = std::max(stations_[e]->way.length(), shortest(uses_[e]));
    for (double h : stations_[e]->h) sizes.h[e].push_back(std::min(h / finer[e], most));
  }
  if (!rules_.empty()) Grading(model_, stations_, narrow_.links(), rules_.front().gradation).run(sizes.h, sizes.vertex);
  return sizes;
}

BorderPoints BorderSampler::sample(const std::vector<double>& finer) const {
  const int edges = static_cast<int>(model_.edges.size());
  Sizes sizes = graded_sizes(finer);
  const std::vector<NarrowSizes::Caps> caps = narrow_.lower_in_corners(stations_, sizes.vertex, sizes.h);
  if (!narrow_.corners().empty()) {
    Grading(model_, stations_, narrow_.links(), rules_.front().gradation).run(sizes.h, sizes.vertex);
  }
  std::vector<Places> places(edges);
  for_each_(edges, [&](int e) {
    if (stations_[e]) places[e] = place(model_.edges[e], uses_[e], *stations_[e], sizes.h[e], caps[e]);
  });
  Numbering numbering(model_, sizes.vertex);
  for (int e = 0; e < edges; ++e) {
    if (stations_[e]) numbering.add(e, places[e], shortest(uses_[e]));
  }
  // Poles last: most of them are ends of other edges already.
  for (int e = 0; e < edges; ++e) {
    if (model_.edges[e].degenerate() && !uses_[e].empty()) numbering.add_pole(e);
  }
  return std::move(numbering.result);
}

BorderPoints sample_border(const CadModel& model, const SizeRule& rule, const std::vector<double>& finer) {
  const auto one_by_one = [](int n, const std::function<void(int)>& body) {
    for (int i = 0; i < n; ++i) body(i);
  };
  return BorderSampler(model, std::vector<SizeRule>(model.faces.size(), rule), one_by_one).sample(finer);
}

}  // namespace geovor
