// Between two stored points the edge is taken as a cubic in normal coordinates X = s cos t, Y = s sin t about each
// site, with the ends' slopes from the system (13): where the surface is flat an edge is a straight line there and the
// cubic is exact. The ends of the two rays to the middle of the cubics tell how good they are, and correct them.
#include "voronoi/edge_walk.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "numeric/gauss_legendre.h"
#include "numeric/worst_of.h"
#include "voronoi/bisector.h"
#include "voronoi/site_ray.h"

namespace geovor {
namespace {

using Plane2 = Eigen::Vector2d;

// A middle whose rays end this far apart, relative to the radius, is made a station of its own, and what is left is
// halved; else one correction leaves the square.
constexpr double kHalve = 1e-6;
constexpr int kDeepest = 8;

// Nearer to a conjugate point (y / radius) than this, angles can't be had from places.
constexpr double kConjugate = 1e-5;

// Stored points are walked over in stretches no longer than a part of the radius, and seen from either site under no
// more than that angle. In a flat cell Simpson's rule is exact; with q, what the sector lacks of s^2 / 2, its error
// goes like q times the fourth power of the stretch. With these numbers it is some 1e-8 of the area.
constexpr double kStretch = 0.05;
constexpr double kLongestStretch = 0.4;

// The two rays of a cut locus come no nearer to each other on a stretch than by this part of what is between them:
// towards its free end they change like the root of the way.
constexpr double kApproach = 0.3;

// Points nearer to each other than this part of the radius do not tell a direction.
constexpr double kSeen = 1e-8;

// Rays on the way from the last regular point to a free end.
constexpr int kEndNodes = 5;

// A place between two points is corrected until it changes by less than this part of the radius.
constexpr double kSettled = 1e-13;
constexpr int kMostCorrections = 6;

// From so near to a place, in lengths of the stretch, corrections lead to the edge.
constexpr double kNear = 0.1;

/// A place of the edge with both rays to it.
struct Station {
  std::array<RayEnd, 2> rays;
  std::array<Plane2, 2> slope;  ///< d(X,Y) for each length of the edge
  Xyz tangent = Xyz::Zero();
  bool regular = true;  ///< no conjugate point
  double radius() const { return 0.5 * (rays[0].polar.s + rays[1].polar.s); }
};

Plane2 chart_point(const Polar& p) { return {p.s * std::cos(p.t), p.s * std::sin(p.t)}; }
Polar polar_near(const Plane2& P, double t) { return {P.norm(), t + wrap_angle(std::atan2(P.y(), P.x()) - t)}; }
double cross2(const Plane2& a, const Plane2& b) { return a.x() * b.y() - a.y() * b.x(); }

SiteRay site_ray(int site, const RayEnd& e) { return {site, e.polar, {}, e.x, e.T, e.N, e.y}; }

class Walker {
 public:
  Walker(const Surface& surface, const CurvatureMap& curvature, const VoronoiDiagram& diagram, const DiagramEdge& edge)
      : surface_(surface), curvature_(curvature), diagram_(diagram), edge_(edge) {}

  EdgeWalk walk();

 private:
  Station stored(const EdgePoint& p) const;
  Station ends_at(const EdgePoint& p) const;
  void stretch(const Station& a, const Station& b, bool to_free_end);
  bool ends_stretch(int i, const Station& start, const EdgePoint& next) const;
  bool free_end(int vertex) const { return vertex >= 0 && diagram_.vertices[vertex].sites.size() == 1; }
  Station at(Polar left, Polar right) const;
  void complete(Station& s) const;
  bool found(const Station& s) const { return s.rays[0].found && s.rays[1].found; }
  void note_stored(const EdgePoint& p, const Station& s);
  void go(const Station& a, const Station& b, int depth);
  void go_to_free_end(const Station& a, const Station& b, int depth);
  std::optional<Station> half_the_turn(const Station& a, const Station& b) const;
  void add_area_by_angle(const Station& a, const Station& b, int side);
  Station middle(const Station& a, const Station& b, double h) const;
  Station aimed(Station m, const Station& a, const Station& b, double h) const;
  bool correct(Station& m, const Xyz& along, double h) const;
  Station settled(Station m, const Xyz& along, double h, double apart) const;
  void add_area(const Station& a, const Station& m, const Station& b, double h);
  void note_turn(const Station& a, const Station& b, bool from_free_end, bool to_free_end);
  void look_between(const Station& a, const Station& b);
  double gap_of(const Station& s, const Xyz& place) const;
  void finish();

  RayEnd ray(int side, Polar to, RayParts parts) const {
    return trace_ray(surface_, diagram_.sites[side == 0 ? edge_.left : edge_.right].uv, to, curvature_, parts);
  }

  const Surface& surface_;
  const CurvatureMap& curvature_;
  const VoronoiDiagram& diagram_;
  const DiagramEdge& edge_;
  EdgeWalk out_;
  double worst_ = 0.0;
  bool complete_ = true;
  bool looked_between_ = false;
};

Station Walker::at(Polar left, Polar right) const {
  Station s;
  s.rays = {ray(0, left, RayParts::WithSector), ray(1, right, RayParts::WithSector)};
  if (found(s)) complete(s);
  return s;
}

Station Walker::stored(const EdgePoint& p) const { return at({p.radius, p.left_angle}, {p.radius, p.right_angle}); }

/// The rays' ends alone.
Station Walker::ends_at(const EdgePoint& p) const {
  Station s;
  s.rays = {ray(0, {p.radius, p.left_angle}, RayParts::EndAlone),
            ray(1, {p.radius, p.right_angle}, RayParts::EndAlone)};
  for (const RayEnd& ray : s.rays) s.regular = s.regular && std::abs(ray.y) > kConjugate * ray.polar.s;
  return s;
}

void Walker::complete(Station& s) const {
  const BisectorPoint m{site_ray(edge_.left, s.rays[0]), site_ray(edge_.right, s.rays[1])};
  const BisectorSlope d = bisector_slope(m);
  s.tangent = m.tangent();
  for (int side = 0; side < 2; ++side) {
    const auto& [r, t] = s.rays[side].polar;
    const double turn = side == 0 ? d.left_angle : d.right_angle;
    s.slope[side] = d.radius * Plane2(std::cos(t), std::sin(t)) + r * turn * Plane2(-std::sin(t), std::cos(t));
    s.regular = s.regular && std::abs(s.rays[side].y) > kConjugate * r;
  }
}

/// Difference of the two radial lengths at a place, relative to the radius.
double Walker::gap_of(const Station& s, const Xyz& place) const {
  const double gap = std::abs(distance_beside(s.rays[0], place) - distance_beside(s.rays[1], place));
  return larger_of(0.0, gap - kCoordinateRounding * place.lpNorm<Eigen::Infinity>()) / s.radius();
}

void Walker::note_stored(const EdgePoint& p, const Station& s) {
  const double off = larger_of((s.rays[0].x - p.xyz).norm(), (s.rays[1].x - p.xyz).norm()) / s.radius();
  const double gap = gap_of(s, p.xyz);
  if (!(gap <= worst_)) worst_ = gap, out_.worst = p.uv;
  out_.radial_gap = larger_of(out_.radial_gap, gap);
  out_.place_gap = larger_of(out_.place_gap, off);
}

/// Arc length of a cubic arc with these end tangents, to the fourth order in its bend.
double arc_length(const Station& a, const Station& b) {
  const Xyz chord = b.rays[0].x - a.rays[0].x;
  const double length = chord.norm();
  const Xyz e = chord / length, p = a.tangent - a.tangent.dot(e) * e, q = b.tangent - b.tangent.dot(e) * e;
  const double bend = (p.squaredNorm() + q.squaredNorm()) / 15.0 - p.dot(q) / 30.0;
  return length * (1.0 + (std::isfinite(bend) ? bend : 0.0));
}

Station Walker::middle(const Station& a, const Station& b, double h) const {
  std::array<Polar, 2> aim;
  for (int side = 0; side < 2; ++side) {
    const Plane2 P = chart_point(a.rays[side].polar), Q = chart_point(b.rays[side].polar);
    const Plane2 m = 0.5 * (P + Q) + h / 8.0 * (a.slope[side] - b.slope[side]);
    aim[side] = polar_near(m, a.rays[side].polar.t);
  }
  return at(aim[0], aim[1]);
}

// To the place x_p + a T_p + b N_p in the plane across the chord where both radial lengths agree, to the square of what
// was missing. Where both rays have nearly one direction, that may be anywhere: not farther than the chord is long.
bool Walker::correct(Station& m, const Xyz& along, double h) const {
  const RayEnd &p = m.rays[0], &q = m.rays[1];
  const double lag = distance_beside(q, p.x) - p.polar.s;  // a (1 - <T_q, T_p>) - b <T_q, N_p> = lag
  const double qa = 1.0 - q.T.dot(p.T), qb = -q.T.dot(p.N), ca = along.dot(p.T), cb = along.dot(p.N);
  const double determinant = qa * cb - qb * ca, a = lag * cb / determinant, b = -lag * ca / determinant;
  if (!m.regular || !(std::hypot(a, b) <= h)) return false;
  const double radius = p.polar.s + a;
  const Xyz place = p.x + a * p.T + b * p.N;
  for (RayEnd& ray : m.rays) {
    ray.sector += (radius - ray.polar.s) * ray.y;
    ray.polar = {radius, ray.polar.t + ray.N.dot(place - ray.x) / ray.y};
    ray.x = place;
  }
  return radius > 0.0;
}

// Corrected, with rays traced anew each time, until their ends are no farther apart than this part of the radius. Near
// a conjugate point once is not enough: the square of what was missing counts as divided by y there.
Station Walker::settled(Station m, const Xyz& along, double h, double apart) const {
  for (int i = 0; i < kMostCorrections && found(m); ++i) {
    const double lag = std::abs(m.rays[0].polar.s - m.rays[1].polar.s);
    const double gap = std::max((m.rays[0].x - m.rays[1].x).norm(), lag) / m.radius();
    if (gap <= apart || !correct(m, along, h)) break;
    m = at(m.rays[0].polar, m.rays[1].polar);
  }
  return m;
}

// Where rays come together (y small) an angle may change by far more in one half of the way than in the other, and the
// cubic of the angles misses by more than the way is long; that of the places does not. Each ray is turned, by Newton's
// method between its angles at both ends, until it comes near to the place.
Station Walker::aimed(Station m, const Station& a, const Station& b, double h) const {
  const Xyz place = 0.5 * (a.rays[0].x + b.rays[0].x) + h / 8.0 * (a.tangent - b.tangent);
  const auto off = [&] { return larger_of((m.rays[0].x - place).norm(), (m.rays[1].x - place).norm()); };
  for (int i = 0; i < kMostCorrections && m.regular && found(m) && off() > kNear * h; ++i) {
    std::array<Polar, 2> aim;
    for (int side = 0; side < 2; ++side) {
      const RayEnd& ray = m.rays[side];
      const Xyz miss = place - ray.x;
      const double t = ray.polar.t, turn = ray.N.dot(miss) / ray.y;
      const double rest = wrap_angle(
          (turn * wrap_angle(b.rays[side].polar.t - a.rays[side].polar.t) > 0.0 ? b : a).rays[side].polar.t - t);
      aim[side] = {ray.polar.s + ray.T.dot(miss), t + (std::abs(turn) < std::abs(rest) ? turn : 0.5 * rest)};
    }
    m = at(aim[0], aim[1]);
  }
  return m;
}

/// dR/dt of the cell's border s = R(t); zero at a free end.
double slope_in_angle(const Station& s, int side) {
  const Polar& p = s.rays[side].polar;
  const Plane2 e(std::cos(p.t), std::sin(p.t));
  const double slope = s.regular ? p.s * s.slope[side].dot(e) / cross2(e, s.slope[side]) : 0.0;
  return std::isfinite(slope) ? slope : 0.0;
}

void Walker::go(const Station& a, const Station& b, int depth) {
  const double h = arc_length(a, b);
  const Xyz along = (b.rays[0].x - a.rays[0].x).normalized();
  if (!(h > 0.0)) return;  // a vertex on the edge's first point
  Station m = middle(a, b, h);
  if (!found(m)) {
    complete_ = false;
    return;
  }
  const double gap = (m.rays[0].x - m.rays[1].x).norm() / m.radius();
  const bool corrected = correct(m, along, h);
  if (!(gap <= kHalve) && depth < kDeepest) {
    const Station start = corrected ? at(m.rays[0].polar, m.rays[1].polar) : aimed(m, a, b, h);
    const Station anew = settled(start, along, h, kHalve);
    if (found(anew) && anew.regular) {
      go(a, anew, depth + 1);
      go(anew, b, depth + 1);
      return;
    }
  }
  out_.jump = larger_of(out_.jump, gap);
  add_area(a, m, b, h);
}

// Simpson's rule for (sector / s^2) (X dY - Y dX), which is sector dt.
void Walker::add_area(const Station& a, const Station& m, const Station& b, double h) {
  for (int side = 0; side < 2; ++side) {
    const Plane2 A = chart_point(a.rays[side].polar), M = chart_point(m.rays[side].polar),
                 B = chart_point(b.rays[side].polar);
    const Plane2 across = 1.5 / h * (B - A) - 0.25 * (a.slope[side] + b.slope[side]);
    const auto density = [](const RayEnd& ray, const Plane2& P, const Plane2& d) {
      return ray.sector / P.squaredNorm() * cross2(P, d);
    };
    const double sum = density(a.rays[side], A, a.slope[side]) + 4.0 * density(m.rays[side], M, across) +
                       density(b.rays[side], B, b.slope[side]);
    out_.seen[side].area += (side == 0 ? 1.0 : -1.0) * sum * h / 6.0;
  }
}

void Walker::note_turn(const Station& a, const Station& b, bool from_free_end, bool to_free_end) {
  for (int side = 0; side < 2; ++side) {
    ChartPiece& seen = out_.seen[side];
    const RayEnd &from = a.rays[side], &to = b.rays[side];
    const double turn = (side == 0 ? 1.0 : -1.0) * wrap_angle(to.polar.t - from.polar.t);
    seen.turn += turn;
    seen.back = larger_of(seen.back, -turn * std::abs(to.y) / to.polar.s);
    for (const RayEnd* ray : {&from, &to}) {
      seen.shortest = seen.shortest > 0.0 ? smaller_of(seen.shortest, ray->polar.s) : ray->polar.s;
    }
    if (!from_free_end) seen.least_y = smaller_of(seen.least_y, from.y / from.polar.s);
    if (!to_free_end) seen.least_y = smaller_of(seen.least_y, to.y / to.polar.s);
  }
}

/// The cell's border s = R(t) as the cubic that has its values and slopes at two stations, at the part k of the turn.
double cubic_in_angle(const Station& a, const Station& b, int side, double k) {
  const Polar &p = a.rays[side].polar, &q = b.rays[side].polar;
  const double turn = wrap_angle(q.t - p.t), rest = 1.0 - k;
  return rest * rest * (1.0 + 2.0 * k) * p.s + k * k * (3.0 - 2.0 * k) * q.s +
         turn * (k * rest * rest * slope_in_angle(a, side) - k * k * rest * slope_in_angle(b, side));
}

// Towards a free end the angles go like the square root of the way, but the cell's border there is a smooth curve
// s = R(t), with R' = 0 at the end: a cubic in t, each site for itself. Where a place of the edge half way is beside
// it, that place is made a station.
void Walker::go_to_free_end(const Station& a, const Station& b, int depth) {
  const std::optional<Station> m = depth < kDeepest ? half_the_turn(a, b) : std::nullopt;
  if (m) {
    double off = 0.0;
    for (int side = 0; side < 2; ++side) {
      const double from = a.rays[side].polar.t, turn = wrap_angle(b.rays[side].polar.t - from);
      const Polar& p = m->rays[side].polar;
      off = larger_of(off, std::abs(cubic_in_angle(a, b, side, wrap_angle(p.t - from) / turn) - p.s) / p.s);
    }
    if (!(off <= kHalve)) {
      go_to_free_end(a, *m, depth + 1);
      go_to_free_end(*m, b, depth + 1);
      return;
    }
  }
  for (int side = 0; side < 2; ++side) add_area_by_angle(a, b, side);
}

/// The place of the edge to which both rays have turned by about half; none where it can't be told, next to the end.
std::optional<Station> Walker::half_the_turn(const Station& a, const Station& b) const {
  const Xyz way = b.rays[0].x - a.rays[0].x;
  const double h = way.norm();
  if (!(h > kSeen * a.radius())) return std::nullopt;
  std::array<Polar, 2> aim;
  for (int side = 0; side < 2; ++side) {
    const double from = a.rays[side].polar.t, turn = wrap_angle(b.rays[side].polar.t - from);
    aim[side] = {cubic_in_angle(a, b, side, 0.5), from + 0.5 * turn};
  }
  Station m = settled(at(aim[0], aim[1]), way / h, h, kHalve);
  const auto between = [&](int side) {
    const double from = a.rays[side].polar.t, turn = wrap_angle(b.rays[side].polar.t - from);
    const double k = wrap_angle(m.rays[side].polar.t - from) / turn;
    return k > 0.0 && k < 1.0;
  };
  const bool met = found(m) && (m.rays[0].x - m.rays[1].x).norm() <= kHalve * m.radius();
  return met && correct(m, way / h, h) && between(0) && between(1) ? std::optional(m) : std::nullopt;
}

void Walker::add_area_by_angle(const Station& a, const Station& b, int side) {
  const GaussRule& rule = gauss_legendre(kEndNodes);
  const double from = a.rays[side].polar.t, turn = wrap_angle(b.rays[side].polar.t - from);
  double sum = 0.0;
  for (int i = 0; i < kEndNodes; ++i) {
    const double k = 0.5 * (1.0 + rule.nodes[i]);
    const RayEnd end = ray(side, {cubic_in_angle(a, b, side, k), from + k * turn}, RayParts::WithSector);
    complete_ = complete_ && end.found;
    sum += 0.5 * rule.weights[i] * end.sector;
  }
  out_.seen[side].area += (side == 0 ? 1.0 : -1.0) * sum * turn;
}

/// A place between the points, corrected with rays traced anew each time. Two rays that meet beside the edge have
/// different lengths.
void Walker::look_between(const Station& a, const Station& b) {
  const Xyz along = (b.rays[0].x - a.rays[0].x).normalized();
  const double h = arc_length(a, b);
  if (!a.regular || !b.regular || !(h > 0.0)) return;
  const Station m = settled(middle(a, b, h), along, h, kSettled);
  out_.gap_between = found(m) ? gap_of(m, 0.5 * (m.rays[0].x + m.rays[1].x)) : 1.0;
}

void Walker::finish() {
  for (int side = 0; side < 2; ++side) {
    ChartPiece& seen = out_.seen[side];
    seen.found = complete_ && std::isfinite(seen.area);
    const EdgePoint &p = edge_.points.front(), &q = edge_.points.back();
    seen.first = {p.radius, side == 0 ? p.left_angle : p.right_angle};
    seen.last = {q.radius, side == 0 ? q.left_angle : q.right_angle};
    const EdgePoint& m = edge_.points[edge_.points.size() / 2];
    seen.middle = {m.radius, side == 0 ? m.left_angle : m.right_angle};
  }
  std::swap(out_.seen[1].first, out_.seen[1].last);
}

void Walker::stretch(const Station& a, const Station& b, bool to_free_end) {
  const Xyz way = b.rays[0].x - a.rays[0].x;
  if (to_free_end || !a.regular || !b.regular) {
    go_to_free_end(a, b, 0);
    return;
  }
  if (!(way.norm() <= kSeen * a.radius()))
    out_.left_is_left = out_.left_is_left && (a.tangent + b.tangent).dot(way) >= 0.0;
  if (!looked_between_) look_between(a, b);
  looked_between_ = true;
  go(a, b, 0);
}

/// How long a stretch may be that begins at the rays' ends, as a part of the radius.
double stretch_from(const Station& s) {
  double q = 0.0;
  for (const RayEnd& ray : s.rays) q = std::max(q, std::abs(2.0 * ray.sector / (ray.polar.s * ray.polar.s) - 1.0));
  return std::min(kLongestStretch, kStretch / std::sqrt(std::sqrt(q)));
}

/// Whether point i has to end a stretch that begins at `start`, because the next point would be too far.
bool Walker::ends_stretch(int i, const Station& start, const EdgePoint& next) const {
  const int last = static_cast<int>(edge_.points.size()) - 1;
  if (i == last || (i + 1 == last && free_end(edge_.to)) || (i == 1 && free_end(edge_.from))) return true;
  const double turn = std::max(std::abs(wrap_angle(next.left_angle - start.rays[0].polar.t)),
                               std::abs(wrap_angle(next.right_angle - start.rays[1].polar.t)));
  const double longest = stretch_from(start);
  const double between = std::abs(wrap_angle(start.rays[0].polar.t - start.rays[1].polar.t));
  if (edge_.left == edge_.right && !(turn <= kApproach * between)) return true;
  return !(turn <= longest && (next.xyz - start.rays[0].x).norm() <= longest * start.radius());
}

EdgeWalk Walker::walk() {
  const auto& points = edge_.points;
  const int count = static_cast<int>(points.size());
  Station start = stored(points[0]), last = start;
  out_.seen[1].last_y = start.rays[1].y;
  complete_ = found(start);
  if (complete_) note_stored(points[0], start);
  for (int i = 1; i < count && complete_; ++i) {
    const bool end = ends_stretch(i, start, points[std::min(i + 1, count - 1)]);
    const Station next = end ? stored(points[i]) : ends_at(points[i]);
    complete_ = found(next);
    if (!complete_) break;
    note_stored(points[i], next);
    const bool from_free_end = i == 1 && free_end(edge_.from), to_free_end = i + 1 == count && free_end(edge_.to);
    note_turn(last, next, from_free_end, to_free_end);
    if (end) {
      stretch(start, next, from_free_end || to_free_end);
      start = next;
    }
    last = next;
  }
  out_.seen[0].last_y = last.rays[0].y;
  finish();
  return out_;
}

}  // namespace

EdgeWalk walk_edge(const Surface& surface, const CurvatureMap& curvature, const VoronoiDiagram& diagram, int edge) {
  return Walker(surface, curvature, diagram, diagram.edges[edge]).walk();
}

}  // namespace geovor
