#include "voronoi/edge_tracer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "surface/forms.h"
#include "voronoi/foresight.h"
#include "voronoi/free_end.h"
#include "voronoi/vertex_solver.h"

namespace geovor {
namespace {

// Steps, and the way on which a vertex is foreseen, as parts of the radius: over more of it the plane is no guide.
constexpr double kLongestStep = 0.5;
constexpr double kFirstStep = 0.1;
constexpr double kForesight = 2.0;

// Below this part of the longest step the tracer is stuck.
constexpr double kShortestStep = 1e-5;

// A step may turn the edge by this much (radians), and swing the rays from the sites by that much, which is far where
// they spread little: behind bumps, near the sites. A piece up to a foreseen vertex has no swing to heed.
constexpr double kMostTurn = 0.25;
constexpr double kMostSwing = 0.35;
constexpr double kMostTurnToVertex = 0.6;

// A step that turns the edge by less than this may be followed by one twice as long.
constexpr double kLittleTurn = 0.1;

// A step brings the two rays of a cut locus nearer to each other by this part of what is between them.
constexpr double kApproach = 0.3;

// With less than this between the rays of a cut locus (radians) its conjugate point is as near as the square of it, in
// curvature radii, and the rest of the way is straight. Where Newton's method gives up before, as it does where the
// rays spread little, it is looked for from farther away.
constexpr double kOneGeodesic = 0.03;
constexpr double kNearlyOneGeodesic = 0.3;

// See EdgeTracer::predict.
constexpr double kSmallCorrection = 0.3;

// An edge of more steps than this goes round and round.
constexpr int kMostSteps = 20000;

constexpr int kMostRivalsInTurn = 24;

// Two points nearer than this part of the radius have nothing between them.
constexpr double kNoRoom = 1e-6;

// Where the parameters do not tell the metric next to a tip, the last step of a cut locus to it may be this long.
constexpr double kOntoTip = 1e-4;

// The border may be farther off than where a step would have ended, by this factor.
constexpr double kMostOvershoot = 2.0;

// Beside the start, as a part of the step, and onto it, as a part of the radius.
constexpr double kBeside = 0.3;
constexpr double kBackAtStart = 1e-9;

/// Cubic through (0, f0, d0) and (h0, f1, d1), continued to h0 + h.
double extrapolate(double f0, double d0, double f1, double d1, double h0, double h) {
  const double t = 1.0 + h / h0, r = 1.0 - t;
  return r * r * (1 + 2 * t) * f0 + t * t * (3 - 2 * t) * f1 + h0 * t * r * (r * d0 - t * d1);
}

/// Where a ray's angle gets to when its end moves by `step`, as if the surface beyond were a plane.
double turned(const SiteRay& ray, const Xyz& step) {
  return ray.polar.t + ray.polar.s / ray.y * std::atan2(ray.N.dot(step), ray.polar.s + ray.T.dot(step));
}

/// Whether the two rays of a cut locus come together ahead.
bool near_conjugate_point(const BisectorPoint& m, double within) {
  if (m.left.site != m.right.site) return false;
  const double between = wrap_angle(m.left.polar.t - m.right.polar.t);
  const BisectorSlope d = bisector_slope(m);
  return std::abs(between) < within && between * (d.left_angle - d.right_angle) < 0.0;
}

}  // namespace

/// An edge on its way.
struct EdgeTracer::Walk {
  TracedEdge edge;
  double step = 0.0;
  bool starts_on_border = false;
  const BisectorPoint& current() const { return edge.points.back(); }
  bool on_border() const { return starts_on_border && edge.points.size() == 1; }
};

double EdgeTracer::longest_step(const BisectorPoint& m) const {
  const BisectorSlope slope = bisector_slope(m);
  double h = kLongestStep * m.radius();
  h = std::min(h, kMostSwing / std::max(std::abs(slope.left_angle), std::abs(slope.right_angle)));
  if (m.left.site == m.right.site) {
    const double between = std::abs(wrap_angle(m.left.polar.t - m.right.polar.t));
    h = std::min(h, kApproach * between / std::abs(slope.left_angle - slope.right_angle));
  }
  return h;
}

TracedEdge EdgeTracer::trace(const BisectorPoint& start, bool on_border) const {
  Walk walk;
  walk.edge.points = {start};
  walk.starts_on_border = on_border;
  walk.step = kFirstStep * start.radius();
  for (int i = 0; i < kMostSteps; ++i) {
    const Step outcome = advance(walk);
    if (outcome == Step::Ended) return walk.edge;
    if (outcome == Step::Failed) walk.step *= 0.5;
    if (!(walk.step > kShortestStep * longest_step(walk.current()))) break;
  }
  if (near_conjugate_point(walk.current(), kNearlyOneGeodesic) && !end_in_tip(walk, kOntoTip)) end_freely(walk);
  return walk.edge;
}

EdgeTracer::Step EdgeTracer::advance(Walk& walk) const {
  const BisectorPoint cur = walk.current();
  if (near_conjugate_point(cur, kOneGeodesic) && (end_in_tip(walk, kNoRoom) || end_freely(walk))) return Step::Ended;
  walk.step = std::min(walk.step, longest_step(cur));
  const double h = walk.step;
  if (!(h > 0.0)) return Step::Failed;
  if (close(walk, h)) return Step::Ended;
  if (const auto vertex = foreseen_vertex(cur, kForesight * cur.radius())) {
    const Step outcome = take_vertex(walk, *vertex);
    if (outcome != Step::Failed) return outcome;
  }
  const auto next = predict(walk, h);
  if (!next) {
    const auto side = on_border_.straight_on(cur, h, walk.on_border());
    if (side && end_on_border(walk, h, *side)) return Step::Ended;
  }
  if (!next || chord(cur, *next) > 1.5 * h) return Step::Failed;
  const double bend = turn(cur, *next);
  if (!(bend < kMostTurn)) return Step::Failed;
  const auto nearer = sites_.nearer_than(next->radius() * (1.0 - kOneVertex), next->left.uv, {next->left, next->right});
  if (!nearer.empty()) {
    const auto vertex = find_vertex(cur, *next, nearer.front(), 1.5 * h);
    return vertex ? take_vertex(walk, *vertex) : Step::Failed;
  }
  const Step outcome = take_point(walk, *next);
  if (outcome == Step::Going && bend < kLittleTurn) walk.step = 2.0 * h;
  return outcome;
}

std::optional<BisectorPoint> EdgeTracer::predict(const Walk& walk, double h) const {
  const BisectorPoint& cur = walk.current();
  const BisectorSlope d = bisector_slope(cur);
  BisectorCoordinates guess = {cur.radius() + h * d.radius, cur.left.polar.t + h * d.left_angle,
                               cur.right.polar.t + h * d.right_angle};
  if (walk.edge.points.size() > 1) {
    const BisectorPoint& prev = walk.edge.points[walk.edge.points.size() - 2];
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

// The sites' own rays turn about their ends as in the plane; the third site's ray is aimed along the straight line.
std::optional<EdgeTracer::Vertex> EdgeTracer::foreseen_vertex(const BisectorPoint& from, double reach) const {
  const auto seen = foresee(sites_, rays_, from, reach);
  if (!seen) return std::nullopt;
  const Xyz step = seen->way * from.tangent();
  const SurfaceJet j = rays_.surface().jet(from.left.uv);
  const Uv place = from.left.uv + tangent_components(j, step);
  const auto rival = rays_.roughly_to(seen->site, place);
  if (!rival) return std::nullopt;
  BisectorPoint guess = from;
  for (SiteRay* ray : {&guess.left, &guess.right}) {
    ray->polar.t = turned(*ray, step);
    ray->polar.s = (ray->polar.s * ray->T + step).norm();
  }
  const auto vertex = find_vertex(from, guess, *rival, 1.5 * seen->way);
  if (!vertex || !(turn(from, vertex->point) < kMostTurnToVertex)) return std::nullopt;
  return vertex;
}

// The vertex with the rival that was noticed first needn't be the first vertex on the way: as long as some other
// generator is nearer there, that one takes the rival's place.
std::optional<EdgeTracer::Vertex> EdgeTracer::find_vertex(const BisectorPoint& from, const BisectorPoint& guess,
                                                          SiteRay rival, double reach) const {
  BisectorCoordinates c = coordinates(guess);
  for (int i = 0; i < kMostRivalsInTurn; ++i) {
    const auto solved = solve_vertex(
        rays_, {{{from.left.site, c.left_angle}, {from.right.site, c.right_angle}, {rival.site, rival.polar.t}}},
        c.radius);
    if (!solved) return std::nullopt;
    const auto& r = *solved;
    const Xyz way = r[0].x - from.position();
    const double radius = r[0].polar.s;
    if (!(from.tangent().dot(way) > kOneVertex * c.radius) || way.norm() > reach) return std::nullopt;
    if (!(std::abs(radius - from.radius()) <= reach)) return std::nullopt;  // no distance changes faster than one moves
    if (same_generator(r[0], r[1]) || same_generator(r[0], r[2]) || same_generator(r[1], r[2])) return std::nullopt;
    const auto nearer = sites_.nearer_than(radius * (1.0 + kTieWindow), r[0].uv, {r[0], r[1], r[2]});
    if (nearer.empty() || nearer.front().polar.s >= radius * (1.0 - kOneVertex)) {
      Vertex vertex{{r.begin(), r.end()}, {r[0], r[1]}};
      vertex.generators.insert(vertex.generators.end(), nearer.begin(), nearer.end());
      sort_around(vertex.generators);
      return vertex;
    }
    rival = nearer.front();
    c = {radius, r[0].polar.t, r[1].polar.t};
  }
  return std::nullopt;
}

// A generator that is nearer half way to the vertex cuts the edge before.
EdgeTracer::Step EdgeTracer::take_vertex(Walk& walk, const Vertex& found) const {
  const BisectorPoint cur = walk.current();
  Vertex vertex = found;
  for (int i = 0; i < kMostRivalsInTurn; ++i) {
    const double way = chord(cur, vertex.point);
    std::optional<BisectorPoint> middle;
    if (way > kNoRoom * cur.radius()) {
      middle = halfway(rays_, cur, vertex.point);
      if (!middle) return Step::Failed;
      const auto nearer =
          sites_.nearer_than(middle->radius() * (1.0 - kOneVertex), middle->left.uv, {middle->left, middle->right});
      if (!nearer.empty()) {
        const auto before = find_vertex(cur, *middle, nearer.front(), way);
        if (!before) return Step::Failed;
        vertex = *before;
        continue;
      }
      const Step outcome = take_point(walk, *middle);
      if (outcome != Step::Going) return outcome;
    }
    const Step outcome = take_point(walk, vertex.point);
    if (outcome == Step::Failed && middle) walk.edge.points.pop_back();
    if (outcome != Step::Going) return outcome;
    walk.edge.generators = vertex.generators;
    walk.edge.end = TraceEnd::Vertex;
    return Step::Ended;
  }
  return Step::Failed;
}

EdgeTracer::Step EdgeTracer::take_point(Walk& walk, const BisectorPoint& next) const {
  if (!goes_on(walk.current(), next)) return Step::Failed;
  if (const auto crossing = on_border_.first_crossing(walk.current(), next, walk.on_border())) {
    return end_on_border(walk, chord(walk.current(), next), *crossing) ? Step::Ended : Step::Failed;
  }
  walk.edge.points.push_back(next);
  return Step::Going;
}

// The way to `next` passes by the start, whose section plane is then a better one to step into than any other.
bool EdgeTracer::close(Walk& walk, double h) const {
  if (walk.edge.points.size() < 3) return false;
  const BisectorPoint &start = walk.edge.points.front(), &cur = walk.current();
  const Xyz to_start = start.position() - cur.position();
  const double ahead = cur.tangent().dot(to_start);
  if (!(ahead > 0.0 && ahead < 1.5 * h) || to_start.norm() > (1.0 + kBeside) * ahead) return false;
  if (!(start.tangent().dot(cur.tangent()) > 0.0)) return false;
  const BisectorCoordinates guess = {start.radius(), start.left.polar.t, start.right.polar.t};
  const BisectorSlope d = bisector_slope(cur);
  const auto same = [&](const SiteRay& a, const SiteRay& b, double slope) {
    return std::abs(wrap_angle(a.polar.t + ahead * slope - b.polar.t) * b.y) < kBeside * ahead;
  };
  if (!same(cur.left, start.left, d.left_angle) || !same(cur.right, start.right, d.right_angle)) return false;
  const Xyz normal = start.tangent();
  const auto back =
      correct_bisector(rays_, start.left.site, start.right.site, guess, {normal, normal.dot(start.position())});
  if (!back || chord(*back, start) > kBackAtStart * start.radius()) return false;
  walk.edge.points.push_back(start);
  walk.edge.end = TraceEnd::Closed;
  return true;
}

bool EdgeTracer::end_freely(Walk& walk) const {
  const BisectorPoint& cur = walk.current();
  const auto end = free_end(rays_, cur.left, cur.right);
  if (!end) return false;
  walk.edge.points.push_back({*end, *end});
  walk.edge.end = TraceEnd::FreeEnd;
  return true;
}

bool EdgeTracer::end_in_tip(Walk& walk, double reach) const {
  const BisectorPoint& cur = walk.current();
  const auto end = end_at_tip(rays_, cur.left, cur.right, reach * cur.radius());
  if (!end) return false;
  walk.edge.points.push_back({*end, *end});
  walk.edge.end = TraceEnd::FreeEnd;
  return true;
}

bool EdgeTracer::end_on_border(Walk& walk, double h, const EdgeOnBorder::Crossing& crossing) const {
  BorderPlace place;
  const auto point = on_border_.point(crossing, place);
  if (!point || chord(walk.current(), *point) > kMostOvershoot * h) return false;
  const double radius = point->radius();
  const auto nearer = sites_.nearer_than(radius * (1.0 + kTieWindow), point->left.uv, {point->left, point->right});
  if (!nearer.empty() && nearer.front().polar.s < radius * (1.0 - kTieWindow)) return false;
  walk.edge.points.push_back(*point);
  walk.edge.generators = {point->left, point->right};
  walk.edge.generators.insert(walk.edge.generators.end(), nearer.begin(), nearer.end());
  sort_around(walk.edge.generators);
  walk.edge.place = place;
  walk.edge.end = TraceEnd::Border;
  return true;
}

}  // namespace geovor
