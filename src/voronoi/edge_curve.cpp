#include "voronoi/edge_curve.h"

#include <algorithm>
#include <cmath>

#include "numeric/gauss_legendre.h"

namespace geovor {
namespace {

// A fraction this near to a stored point is that point.
constexpr double kAtPoint = 1e-12;

// Rules of Gauss and Legendre whose difference tells the error of the smaller.
constexpr int kNodes = 5, kMoreNodes = 8;
constexpr int kMostHalvings = 20;

// What two rules may differ by: the smaller one's error, and the larger one is far better.
constexpr double kRulesDiffer = 1e-9;

// An S about the chord has no distance from it in the middle but a slope there: over the chord h a cubic with the slope
// p in its middle goes 0.19 h p astray.
constexpr double kBow = 0.2;

// What a cubic over a piece misses is this part of what it bends, as a rule.
constexpr double kCubicMiss = 0.05;

// A point between two others is no farther from either than this times their chord, and its angles no farther from the
// cubics than a part of their change, or of the whole turn where that is nothing.
constexpr double kFar = 1.5;
constexpr double kSameRay = 0.5;
constexpr double kNoChange = 1e-3;

double chord(const EdgePoint& a, const EdgePoint& b) { return (b.xyz - a.xyz).norm(); }

/// The cubic over [0, h] with f(0) = 0, f(h) = change and the slopes d0, d1, at k h.
double hermite(double change, double d0, double d1, double h, double k) {
  const double r = 1.0 - k;
  return k * k * (3.0 - 2.0 * k) * change + h * k * r * (r * d0 - k * d1);
}

bool is_free_end(const DiagramEdge& edge, const EdgePoint& p) {
  return edge.kind == EdgeKind::CutLocus && p.left_angle == p.right_angle;
}

/// Towards a free end, `distance` away from it of `whole`, an angle goes as q x + (1 - q) x^2 of its change from there,
/// x the root of the distance's part: the root from geometry, the square from the slope at the other end.
double rooted(double change, double slope, double whole, double distance) {
  const double x = std::sqrt(std::max(distance / whole, 0.0));
  const double at_whole = change == 0.0 ? 0.5 : 2.0 * whole * slope / change;  // d angle / d x over the change
  const double q = std::clamp(2.0 - at_whole, 0.0, 2.0);
  return change * x * (q + (1.0 - q) * x);
}

struct Prediction {
  BisectorCoordinates at;
  double miss;  ///< as a part of the radius
  double left_change, right_change;
};

// From its free end a cut locus goes on away from the site.
Prediction predict(const DiagramEdge& edge, const EdgePoint& a, const EdgePoint& b, double k) {
  const bool a_free = is_free_end(edge, a), b_free = is_free_end(edge, b);
  const double slope_a = a_free ? 1.0 : a.radius_slope, slope_b = b_free ? -1.0 : b.radius_slope;
  const double h = chord(a, b), left = wrap_angle(b.left_angle - a.left_angle),
               right = wrap_angle(b.right_angle - a.right_angle);
  Prediction p{{a.radius + hermite(b.radius - a.radius, slope_a, slope_b, h, k),
                a.left_angle + hermite(left, a.left_slope, b.left_slope, h, k),
                a.right_angle + hermite(right, a.right_slope, b.right_slope, h, k)},
               0.0,
               left,
               right};
  const double bend = std::abs(slope_b - slope_a) / a.radius + std::abs(b.left_slope - a.left_slope) +
                      std::abs(b.right_slope - a.right_slope);
  p.miss = kCubicMiss * bend * h;
  if (b_free) {
    p.at.left_angle = b.left_angle + rooted(-left, -a.left_slope, h, (1.0 - k) * h);
    p.at.right_angle = b.right_angle + rooted(-right, -a.right_slope, h, (1.0 - k) * h);
    p.miss = kMissOfPredictor;
  } else if (a_free) {
    p.at.left_angle = a.left_angle + rooted(left, b.left_slope, h, k * h);
    p.at.right_angle = a.right_angle + rooted(right, b.right_slope, h, k * h);
    p.miss = kMissOfPredictor;
  }
  return p;
}

bool same_ray(double angle, double predicted, double change) {
  return std::abs(wrap_angle(angle - predicted)) <= kSameRay * std::abs(change) + kNoChange;
}

}  // namespace

EdgeCurve::EdgeCurve(const SiteRays& rays, const DiagramEdge& edge) : rays_(rays), edge_(edge), chords_{0.0} {
  for (size_t i = 1; i < edge.points.size(); ++i) {
    chords_.push_back(chords_.back() + chord(edge.points[i - 1], edge.points[i]));
  }
}

std::optional<EdgePoint> EdgeCurve::at(double x) const {
  const double whole = chords_.back(), s = std::clamp(x, 0.0, 1.0) * whole;
  const size_t last = edge_.points.size() - 1;
  const size_t i = std::clamp<size_t>(std::upper_bound(chords_.begin(), chords_.end(), s) - chords_.begin(), 1, last);
  const EdgePoint &a = edge_.points[i - 1], &b = edge_.points[i];
  if (s - chords_[i - 1] <= kAtPoint * whole) return a;
  if (chords_[i] - s <= kAtPoint * whole) return b;
  const auto m = between(a, b, (s - chords_[i - 1]) / (chords_[i] - chords_[i - 1]));
  if (!m) return std::nullopt;
  return m->point;
}

std::optional<EdgeCurve::Between> EdgeCurve::between(const EdgePoint& a, const EdgePoint& b, double k) const {
  const Prediction guess = predict(edge_, a, b, k);
  const double h = chord(a, b);
  const Xyz normal = (b.xyz - a.xyz) / h;
  const auto m =
      correct_bisector(rays_, edge_.left, edge_.right, guess.at, {normal, normal.dot(a.xyz) + k * h}, guess.miss);
  if (!m || !((m->position() - a.xyz).norm() <= kFar * h && (m->position() - b.xyz).norm() <= kFar * h)) {
    return std::nullopt;
  }
  if (!same_ray(m->left.polar.t, guess.at.left_angle, guess.left_change) ||
      !same_ray(m->right.polar.t, guess.at.right_angle, guess.right_change)) {
    return std::nullopt;
  }
  const BisectorSlope d = bisector_slope(*m);
  const EdgePoint& near = k < 0.5 ? a : b;
  const Uv uv = near.uv + nearest_copy(rays_.surface(), near.uv, m->left.uv);
  return Between{
      {uv, m->position(), m->radius(), m->left.polar.t, m->right.polar.t, d.radius, d.left_angle, d.right_angle},
      m->tangent()};
}

double EdgeCurve::length() const {
  double sum = 0.0;
  for (size_t i = 1; i < edge_.points.size(); ++i) {
    sum += length_between(edge_.points[i - 1], edge_.points[i], kMostHalvings);
  }
  return sum;
}

// The sections advance along the chord by h dk, the edge by that over the cosine of the angle between the two.
std::optional<double> EdgeCurve::length_by_rule(const EdgePoint& a, const EdgePoint& b, int nodes) const {
  const double h = chord(a, b);
  const Xyz way = (b.xyz - a.xyz) / h;
  double sum = 0.0;
  const GaussRule& rule = gauss_legendre(nodes);
  for (int i = 0; i < nodes; ++i) {
    const auto m = between(a, b, 0.5 + 0.5 * rule.nodes[i]);
    if (!m) return std::nullopt;
    sum += 0.5 * rule.weights[i] * h / m->tangent.dot(way);
  }
  return sum;
}

double EdgeCurve::length_between(const EdgePoint& a, const EdgePoint& b, int halvings) const {
  const double h = chord(a, b);
  if (!(h > 0.0)) return 0.0;
  const auto few = length_by_rule(a, b, kNodes), more = few ? length_by_rule(a, b, kMoreNodes) : few;
  if (few && more && (std::abs(*few - *more) <= kRulesDiffer * *more || halvings == 0)) return *more;
  const auto middle = halvings > 0 ? between(a, b, 0.5) : std::nullopt;
  if (!middle) return h;
  return length_between(a, middle->point, halvings - 1) + length_between(middle->point, b, halvings - 1);
}

std::vector<EdgePoint> EdgeCurve::polyline(double tolerance) const {
  std::vector<EdgePoint> line = {edge_.points.front()};
  for (size_t i = 1; i < edge_.points.size(); ++i) fill(edge_.points[i], tolerance, kMostHalvings, line);
  return line;
}

void EdgeCurve::fill(const EdgePoint& b, double tolerance, int halvings, std::vector<EdgePoint>& line) const {
  const EdgePoint a = line.back();
  const double h = chord(a, b);
  const auto m = halvings > 0 && h > tolerance ? between(a, b, 0.5) : std::nullopt;
  if (m) {
    const Xyz way = (b.xyz - a.xyz) / h, off = m->point.xyz - 0.5 * (a.xyz + b.xyz);
    const double slope = (m->tangent - m->tangent.dot(way) * way).norm();
    if (off.norm() + kBow * h * slope > tolerance) {
      fill(m->point, tolerance, halvings - 1, line);
      fill(b, tolerance, halvings - 1, line);
      return;
    }
  }
  line.push_back(b);
}

}  // namespace geovor
