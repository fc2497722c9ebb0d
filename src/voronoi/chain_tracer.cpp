#include "voronoi/chain_tracer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "surface/forms.h"
#include "voronoi/rival_watch.h"
#include "voronoi/vertex_solver.h"

namespace geovor {
namespace {

// Lengths of steps as parts of the lattice's reach: the longest keeps a chord within two neighbouring cells, whose
// candidates are known; the first is careful because no earlier point helps the prediction; below the shortest the
// chain is stuck.
constexpr double kLongestStep = 0.5;
constexpr double kFirstStep = 0.05;
constexpr double kShortestStep = 1e-9;

// A step may turn the edge by this much (radians) at most.
constexpr double kMostTurn = 0.25;

// Nor may a step swing the geodesics from the sites by more than this (radians), as happens near the sites.
constexpr double kMostSwing = 0.2;

// See ChainTracer::predict.
constexpr double kSmallCorrection = 0.3;

// A chain of more steps than this goes round and round.
constexpr int kMostSteps = 200000;

// Part of the first chord of a chain that starts on the border in which the start itself would be met.
constexpr double kOffBorder = 1e-3;

// A chain that makes this many steps, each below kCreep of the longest, gets nowhere.
constexpr double kCreep = 1e-3;
constexpr int kMostCreeping = 200;

// A cut locus ends in a conjugate point of its site, where its two geodesics become one. With less than this between
// their directions (radians) the rest is shorter than about its square, in radii of curvature, and hard to follow.
constexpr double kOneGeodesic = 0.02;

constexpr int kBorderIterations = 30;
constexpr int kMostRivalsInTurn = 12;

double chord(const BisectorPoint& a, const BisectorPoint& b) { return (b.position() - a.position()).norm(); }

double turn(const BisectorPoint& a, const BisectorPoint& b) {
  const Xyz s = a.tangent(), t = b.tangent();
  return std::atan2(s.cross(t).norm(), s.dot(t));
}

/// Cubic through (0, f0, d0) and (h0, f1, d1), continued to h0 + h.
double extrapolate(double f0, double d0, double f1, double d1, double h0, double h) {
  const double t = 1.0 + h / h0, r = 1.0 - t;
  return r * r * (1 + 2 * t) * f0 + t * t * (3 - 2 * t) * f1 + h0 * t * r * (r * d0 - t * d1);
}

BisectorCoordinates between(const BisectorPoint& a, const BisectorPoint& b, double k) {
  const auto mix = [k](double x, double y) { return x + k * (y - x); };
  return {mix(a.radius(), b.radius()), mix(a.left.polar.t, b.left.polar.t), mix(a.right.polar.t, b.right.polar.t)};
}

/// The chord from cur to next comes by the start of the chain, which so closes.
bool passes(const BisectorPoint& start, const BisectorPoint& cur, const BisectorPoint& next) {
  const Xyz way = next.position() - cur.position(), to_start = start.position() - cur.position();
  const double k = way.dot(to_start) / way.squaredNorm();
  constexpr double kBeside = 0.05;
  if (!(k > 0.0 && k <= 1.0) || (to_start - k * way).norm() > kBeside * way.norm()) return false;
  const auto same = [&](const SiteRay& a, const SiteRay& b) {
    return std::abs(wrap_angle(a.polar.t - b.polar.t) * b.y) < 2.0 * way.norm();
  };
  return same(cur.left, start.left) && same(cur.right, start.right) && start.tangent().dot(cur.tangent()) > 0.0;
}

bool near_conjugate_point(const BisectorPoint& m) {
  return m.left.site == m.right.site && std::abs(wrap_angle(m.left.polar.t - m.right.polar.t)) < kOneGeodesic;
}

}  // namespace

void sort_around(std::vector<SiteRay>& g) {
  const Xyz first = -g.front().T, n = g.front().T.cross(g.front().N);
  const auto angle = [&](const SiteRay& ray) { return turn_between(first, -ray.T, n); };
  std::stable_sort(g.begin() + 1, g.end(), [&](const auto& a, const auto& b) { return angle(a) < angle(b); });
}

/// A chain on its way.
struct ChainTracer::Walk {
  Walk(const CandidateLabels& labels, const BisectorPoint& start) : watch(labels, start) { chain.points = {start}; }
  const BisectorPoint& current() const { return chain.points.back(); }
  Chain chain;
  RivalWatch watch;
  double step = 0.0;
  bool starts_on_border = false;
};

double ChainTracer::longest_step(const BisectorPoint& m) const {
  double reach = 0.0;
  for (int corner : labels_.lattice().corners(m.left.uv)) reach = std::max(reach, labels_.lattice().reach(corner));
  return kLongestStep * reach;
}

Chain ChainTracer::trace(const BisectorPoint& start, bool on_border) const {
  Walk walk(labels_, start);
  walk.starts_on_border = on_border;
  walk.step = kFirstStep * longest_step(start);
  const double longest = longest_step(start);
  int creeping = 0;
  for (int i = 0; i < kMostSteps && walk.step > kShortestStep * longest && creeping < kMostCreeping; ++i) {
    if (near_conjugate_point(walk.current())) break;
    const Step outcome = advance(walk);
    if (outcome == Step::Ended) return walk.chain;
    if (outcome == Step::Failed) walk.step *= 0.5;
    creeping = walk.step < kCreep * longest ? creeping + 1 : 0;
  }
  return walk.chain;
}

std::optional<BisectorPoint> ChainTracer::predict(const Walk& walk, double h) const {
  const BisectorPoint& cur = walk.current();
  const BisectorSlope d = bisector_slope(cur);
  BisectorCoordinates guess = {cur.radius() + h * d.radius, cur.left.polar.t + h * d.left_angle,
                               cur.right.polar.t + h * d.right_angle};
  if (walk.chain.points.size() > 1) {
    const BisectorPoint& prev = walk.chain.points[walk.chain.points.size() - 2];
    const BisectorSlope e = bisector_slope(prev);
    const double h0 = chord(prev, cur);
    // The cubic through the last two points is a better guess only where it is a small correction of the straight one.
    const auto improve = [&](double& g, double f0, double d0, double f1, double d1) {
      const double cubic = extrapolate(f0, d0, f1, d1, h0, h);
      if (std::abs(cubic - g) < kSmallCorrection * h * std::abs(d1)) g = cubic;
    };
    improve(guess.radius, prev.radius(), e.radius, cur.radius(), d.radius);
    improve(guess.left_angle, prev.left.polar.t, e.left_angle, cur.left.polar.t, d.left_angle);
    improve(guess.right_angle, prev.right.polar.t, e.right_angle, cur.right.polar.t, d.right_angle);
  }
  const Xyz tangent = cur.tangent();
  return correct_bisector(rays_, cur.left.site, cur.right.site, guess, {tangent, tangent.dot(cur.position()) + h});
}

// One step: predict and correct, shorten where the edge bends too much, then see what came first: another generator,
// the border, or the start of the chain.
ChainTracer::Step ChainTracer::advance(Walk& walk) const {
  const BisectorPoint cur = walk.current();
  const BisectorSlope slope = bisector_slope(cur);
  const double swing = std::max(std::abs(slope.left_angle), std::abs(slope.right_angle));
  walk.step = std::min({walk.step, longest_step(cur), kMostSwing / swing});
  const double h = walk.step;
  const auto next = predict(walk, h);
  if (!next || chord(cur, *next) > 1.5 * h) return Step::Failed;
  const double bend = turn(cur, *next), sag = h * bend / 8.0;
  if (sag > tolerance_ || !(bend < kMostTurn)) return Step::Failed;
  const RivalVerdict verdict = walk.watch.look(*next);
  if (verdict.kind == RivalVerdict::Unsure) return Step::Failed;
  if (verdict.kind == RivalVerdict::Nearer) {
    const auto vertex = find_vertex(cur, *next, verdict.rival, verdict.fraction);
    if (!vertex) return Step::Failed;
    if (leaves_face(walk, vertex->point)) return end_on_border(walk, vertex->point) ? Step::Ended : Step::Failed;
    walk.chain.points.push_back(vertex->point);
    walk.chain.generators = vertex->generators;
    walk.chain.end = ChainEnd::Vertex;
    return Step::Ended;
  }
  if (leaves_face(walk, *next)) return end_on_border(walk, *next) ? Step::Ended : Step::Failed;
  if (walk.chain.points.size() > 2 && passes(walk.chain.points.front(), cur, *next)) {
    walk.chain.points.push_back(walk.chain.points.front());
    walk.chain.end = ChainEnd::Closed;
    return Step::Ended;
  }
  walk.watch.accept(*next);
  walk.chain.points.push_back(*next);
  constexpr double kShrink = 0.5, kGrowth = 2.0, kSafety = 0.8;
  constexpr double kStraight = std::numeric_limits<double>::min();  // no sag at all: grow as far as allowed
  walk.step = h * std::clamp(kSafety * std::sqrt(tolerance_ / std::max(sag, kStraight)), kShrink, kGrowth);
  return Step::Going;
}

std::optional<FaceBorder::Crossing> ChainTracer::leaves_face(const Walk& walk, const BisectorPoint& next) const {
  const BisectorPoint& cur = walk.current();
  const Uv from = domain_.to_principal(cur.left.uv);
  const Uv to = from + nearest_copy(rays_.surface(), cur.left.uv, next.left.uv);
  const bool leaves_border = walk.starts_on_border && walk.chain.points.size() == 1;
  const auto crossing = border_.first_crossing(from, to, leaves_border ? kOffBorder : 0.0);
  if (crossing || domain_.contains(to)) return crossing;
  const auto place = border_.nearest(to);
  if (!place) return std::nullopt;
  return FaceBorder::Crossing{*place, 1.0};
}

bool ChainTracer::end_on_border(Walk& walk, const BisectorPoint& next) const {
  const auto crossing = leaves_face(walk, next);
  BorderPlace place = crossing->place;
  const BisectorPoint& near = crossing->fraction < 0.5 ? walk.current() : next;
  const auto point = border_point(near, place);
  if (!point || chord(walk.current(), *point) > 2.0 * chord(walk.current(), next)) return false;
  walk.chain.points.push_back(*point);
  walk.chain.place = place;
  walk.chain.end = ChainEnd::Border;
  return true;
}

// Newton's method for d_left = d_right along the border polyline.
std::optional<BisectorPoint> ChainTracer::border_point(const BisectorPoint& near, BorderPlace& place) const {
  BisectorPoint m = near;
  const double n = border_.segment_count(place.cycle);
  for (int i = 0; i < kBorderIterations; ++i) {
    const Uv uv = border_.uv(place);
    const SurfaceJet j = rays_.surface().jet(uv);
    const auto left = rays_.to(m.left.site, uv, carry(m.left, j.S));
    const auto right = rays_.to(m.right.site, uv, carry(m.right, j.S));
    if (!left || !right) return std::nullopt;
    m = {*left, *right};
    const double f = left->polar.s - right->polar.s;
    if (std::abs(f) <= kBisectorTolerance * m.radius()) return m;
    const double slope = (left->T - right->T).dot(push_forward(j, border_.direction(place)));
    double step = -f / slope;
    if (!std::isfinite(step)) return std::nullopt;
    place.parameter += std::clamp(step, -0.5 * n, 0.5 * n);
    place.parameter -= n * std::floor(place.parameter / n);
  }
  return std::nullopt;
}

// The vertex with the rival that was noticed first needn't be the first vertex on the way: as long as some other
// generator is nearer there, that one takes the rival's place.
std::optional<ChainTracer::Vertex> ChainTracer::find_vertex(const BisectorPoint& from, const BisectorPoint& next,
                                                            const SiteRay& first_rival, double fraction) const {
  BisectorCoordinates c = between(from, next, fraction);
  SiteRay rival = first_rival;
  Xyz place = from.position() + fraction * (next.position() - from.position());
  for (int i = 0; i < kMostRivalsInTurn; ++i) {
    const auto solved = solve_vertex(
        rays_,
        {{{from.left.site, c.left_angle}, {from.right.site, c.right_angle}, {rival.site, carry(rival, place).t}}},
        c.radius);
    if (!solved) return std::nullopt;
    const auto& r = *solved;
    if (!(from.tangent().dot(r[0].x - from.position()) > kOneVertex * c.radius)) return std::nullopt;
    if ((r[0].x - from.position()).norm() > 1.5 * chord(from, next)) return std::nullopt;
    Vertex vertex{{r.begin(), r.end()}, {r[0], r[1]}};
    const SiteRay* nearer = nullptr;
    const auto around = labels_.around(r[0].uv);
    for (const SiteRay& other : around) {
      const auto same = [&](const SiteRay& g) { return same_generator(g, other); };
      if (std::any_of(vertex.generators.begin(), vertex.generators.end(), same)) continue;
      const double gap = (other.polar.s - r[0].polar.s) / r[0].polar.s;
      if (gap < -kOneVertex) nearer = nearer ? nearer : &other;
      if (std::abs(gap) <= kOneVertex) vertex.generators.push_back(other);
    }
    if (!nearer) {
      sort_around(vertex.generators);
      return vertex;
    }
    rival = *nearer;
    place = r[0].x;
    c = {r[0].polar.s, r[0].polar.t, r[1].polar.t};
  }
  return std::nullopt;
}

}  // namespace geovor
