// With A(u,v) = integral of W from u0 to u along the line of v, dA/du = W, so by Green's theorem the integral of W over
// a region with its border counter-clockwise is the integral of A dv around the border. No root is sought and no region
// is cut up: holes, seams and poles are loops like any other. The price is that A reaches across holes and notches,
// where the surface is defined all the same.
#include "brep/face_area.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "brep/face_loops.h"
#include "numeric/gauss_legendre.h"
#include "numeric/lobatto.h"

namespace geovor {
namespace {

/// The rule whose value counts. Over a cubic span with moderate stretch it is exact to 1e-10.
const GaussRule& fine_rule() {
  constexpr int kNodes = 7;
  return gauss_legendre(kNodes);
}

/// The rule that the fine one is compared with: Lobatto's with nodes at the ends. Two Gauss rules would agree on a kink
/// that lies beyond the outermost nodes of both, and be wrong together.
const GaussRule& coarse_rule() {
  static const GaussRule rule = [] {
    constexpr int kDegree = 4;
    // Off the ends, on which a surface with creases may answer for the neighbour.
    constexpr double kInwards = 1.0 - 1e-10;
    const LobattoRule lobatto = lobatto_rule(kDegree);
    GaussRule on_both_sides;
    for (int i = 0; i <= kDegree; ++i) {
      on_both_sides.nodes.push_back(kInwards * (2.0 * lobatto.nodes[i] - 1.0));
      on_both_sides.weights.push_back(2.0 * lobatto.weights[i]);
    }
    return on_both_sides;
  }();
  return rule;
}

/// Surface evaluations after which nothing is refined any more: some tenths of a second. A face that would need more
/// says so in its error.
constexpr long kBudget = 1'500'000;
/// Bisections of a panel at most: beyond, rounding of t takes over.
constexpr int kDeepest = 30;
/// The same inside A: a kink's error falls by four a bisection, so this leaves 1e-12 of it.
constexpr int kDeepestInner = 20;
/// Of the target, the part that A's own error may take.
constexpr double kInnerShare = 0.1;

/// A stretch of a border curve between the lines where A is not smooth.
struct Panel {
  const Coedge* coedge;
  double from, to;
  int depth = 0;
  double value = 0.0, difference = 0.0;
};

class GreenIntegral {
 public:
  GreenIntegral(const Surface& surface, const UvBox& box)
      : surface_(surface), box_(box), u_knots_(knots(true)), v_knots_(knots(false)) {}

  /// The panels of one coedge: cut at its own breaks and where it crosses a knot line.
  void cut(const Coedge& coedge, std::vector<Panel>& out) const;
  void evaluate(Panel& panel);
  /// From here on A itself is refined, to this error a unit of u. A folded parameterization has kinks of W along lines
  /// that cross the panels: no other remedy would meet them.
  void refine_inside(double tolerance) { inner_tolerance_ = tolerance; }
  long evaluations() const { return evaluations_; }
  const UvBox& box() const { return box_; }

 private:
  std::vector<double> knots(bool in_u) const;
  double around(const Panel& panel, const GaussRule& rule);
  double A(double u, double v, const GaussRule& rule);
  double strip(double a, double b, double v, const GaussRule& rule);
  double refined_strip(double a, double b, double v, int depth);

  const Surface& surface_;
  UvBox box_;
  std::vector<double> u_knots_, v_knots_;
  double inner_tolerance_ = 0.0;
  long evaluations_ = 0;
};

/// The lines between the surface's pieces inside the box, ascending. Pieces form a grid, so one walk along the middle
/// of the box meets them all.
std::vector<double> GreenIntegral::knots(bool in_u) const {
  const Interval range = in_u ? box_.u : box_.v;
  const std::optional<double> period = in_u ? surface_.u_period() : surface_.v_period();
  const double other = in_u ? box_.v.middle() : box_.u.middle();
  std::vector<double> found;
  double x = range.lo;
  while (x < range.hi) {
    const Span span = in_u ? surface_.span({x, other}, {1.0, 0.0}) : surface_.span({other, x}, {0.0, 1.0});
    const Interval piece = in_u ? span.box.u : span.box.v;
    double next = piece.hi;
    // A periodic surface may name its pieces in the principal period only.
    if (period && std::isfinite(piece.lo)) next += *period * std::floor((x - piece.lo) / *period);
    if (!(next > x && next < range.hi)) break;
    found.push_back(next);
    x = next;
  }
  return found;
}

/// Where `value(t)`, monotone or nearly so from a to b, passes x.
template <typename Function>
double bisect(const Function& value, double a, double b, double x) {
  const bool rising = value(b) > value(a);
  constexpr int kHalvings = 52;  // of a double
  for (int i = 0; i < kHalvings; ++i) {
    const double m = 0.5 * (a + b);
    ((value(m) < x) == rising ? a : b) = m;
  }
  return 0.5 * (a + b);
}

void GreenIntegral::cut(const Coedge& coedge, std::vector<Panel>& out) const {
  std::vector<double> ends = coedge.pcurve->breaks(coedge.range);
  ends.insert(ends.begin(), coedge.range.lo);
  ends.push_back(coedge.range.hi);
  std::vector<double> t = ends;
  // Crossings are looked for between a few samples: two crossings between neighbours stay unseen and cost bisections
  // only.
  constexpr int kSamples = 8;
  for (int axis = 0; axis < 2; ++axis) {
    const auto value = [&](double s) { return coedge.pcurve->position(s)[axis]; };
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      double a = ends[i], value_a = value(a);
      for (int k = 1; k <= kSamples; ++k) {
        const double b = ends[i] + (ends[i + 1] - ends[i]) * k / kSamples, value_b = value(b);
        for (const double knot : axis == 0 ? u_knots_ : v_knots_) {
          if ((value_a < knot && knot < value_b) || (value_b < knot && knot < value_a))
            t.push_back(bisect(value, a, b, knot));
        }
        a = b;
        value_a = value_b;
      }
    }
  }
  std::sort(t.begin(), t.end());
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    if (t[i] < t[i + 1]) out.push_back({&coedge, t[i], t[i + 1]});
  }
}

double GreenIntegral::strip(double a, double b, double v, const GaussRule& rule) {
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  double sum = 0.0;
  for (int i = 0; i < static_cast<int>(rule.nodes.size()); ++i) {
    const SurfaceJet j = surface_.jet({middle + half * rule.nodes[i], v});
    sum += rule.weights[i] * j.Su.cross(j.Sv).norm();
  }
  evaluations_ += static_cast<long>(rule.nodes.size());
  return half * sum;
}

double GreenIntegral::refined_strip(double a, double b, double v, int depth) {
  const double value = strip(a, b, v, fine_rule());
  const double difference = std::abs(value - strip(a, b, v, coarse_rule()));
  if (!(difference > inner_tolerance_ * (b - a)) || depth == 0) return value;
  const double middle = 0.5 * (a + b);
  return refined_strip(a, middle, v, depth - 1) + refined_strip(middle, b, v, depth - 1);
}

double GreenIntegral::A(double u, double v, const GaussRule& rule) {
  const double lo = std::min(box_.u.lo, u), hi = std::max(box_.u.lo, u);
  double sum = 0.0, a = lo;
  auto knot = std::upper_bound(u_knots_.begin(), u_knots_.end(), lo);
  while (a < hi) {
    const double b = knot != u_knots_.end() && *knot < hi ? *knot++ : hi;
    sum += inner_tolerance_ > 0.0 ? refined_strip(a, b, v, kDeepestInner) : strip(a, b, v, rule);
    a = b;
  }
  return u < box_.u.lo ? -sum : sum;
}

double GreenIntegral::around(const Panel& panel, const GaussRule& rule) {
  const double middle = 0.5 * (panel.from + panel.to), half = 0.5 * (panel.to - panel.from);
  // A p-curve along u whose dv is rounding would cost as much as the others and add nothing.
  constexpr double kNoMotion = 1e-16;
  double sum = 0.0;
  for (int i = 0; i < static_cast<int>(rule.nodes.size()); ++i) {
    const CurveJet<2> c = panel.coedge->pcurve->jet(middle + half * rule.nodes[i]);
    const double dv = half * rule.weights[i] * c.d1[1];
    if (std::abs(dv) > kNoMotion * box_.v.length()) sum += dv * A(c.C[0], c.C[1], rule);
  }
  return panel.coedge->reversed ? -sum : sum;
}

void GreenIntegral::evaluate(Panel& panel) {
  panel.value = around(panel, fine_rule());
  panel.difference = std::abs(panel.value - around(panel, coarse_rule()));
}

/// The loops with the gaps between neighbouring coedges closed by straight lines: Green's theorem wants closed loops.
std::vector<Coedge> closed_chains(const std::vector<TrimLoop>& loops) {
  std::vector<Coedge> all;
  const auto end = [](const Coedge& c, bool last) {
    const Eigen::Vector2d p = c.pcurve->position(last != c.reversed ? c.range.hi : c.range.lo);
    return Uv{p[0], p[1]};
  };
  for (const TrimLoop& loop : loops) {
    for (std::size_t i = 0; i < loop.coedges.size(); ++i) {
      const Coedge& coedge = loop.coedges[i];
      const Coedge& next = loop.coedges[(i + 1) % loop.coedges.size()];
      if (!coedge.pcurve || !next.pcurve) {
        throw Error(ErrorCode::FaceRejected, "an edge has no p-curve on the face; repair the face");
      }
      all.push_back(coedge);
      const Uv from = end(coedge, true), to = end(next, false);
      if (!(from == to)) all.push_back({-1, std::make_shared<UvLine>(from, to), {0.0, 1.0}, false});
    }
  }
  return all;
}

UvBox sampled_bounds(const std::vector<Coedge>& coedges) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  constexpr int kSamples = 32;  // the box only names the knots and the origin of A: what bulges out of it is no harm
  UvBox box{{kInf, -kInf}, {kInf, -kInf}};
  for (const Coedge& c : coedges) {
    for (int i = 0; i <= kSamples; ++i) {
      const Eigen::Vector2d p = c.pcurve->position(c.range.lo + c.range.length() * i / kSamples);
      if (!p.allFinite()) {
        throw Error(ErrorCode::FaceRejected, "a p-curve has a point that is not a number; repair the face");
      }
      box.u = {std::min(box.u.lo, p[0]), std::max(box.u.hi, p[0])};
      box.v = {std::min(box.v.lo, p[1]), std::max(box.v.hi, p[1])};
    }
  }
  return box;
}

Area sum_of(const std::vector<Panel>& panels) {
  Area area;
  for (const Panel& panel : panels) {
    area.value += panel.value;
    area.error += panel.difference;
  }
  return area;
}

/// Bisects the panels that differ most until their differences add up to this part of the area, or the budget is spent.
/// The differences are those of the coarse rule: the value itself is mostly better by orders of magnitude.
void refine(GreenIntegral& integral, std::vector<Panel>& panels, double relative) {
  const auto size = [](const UvBox& box) { return box.u.length() * box.v.length(); };
  integral.refine_inside(kInnerShare * relative * std::abs(sum_of(panels).value) / size(integral.box()));
  for (bool refined = true; refined;) {
    refined = false;
    const Area area = sum_of(panels);
    const double target = relative * std::abs(area.value);
    if (!(area.error > target)) return;
    const double share = target / static_cast<double>(panels.size());
    const std::size_t count = panels.size();
    for (std::size_t i = 0; i < count && integral.evaluations() < kBudget; ++i) {
      if (!(panels[i].difference > share) || panels[i].depth == kDeepest) continue;
      Panel first = panels[i], second = panels[i];
      first.to = second.from = 0.5 * (first.from + first.to);
      first.depth = ++second.depth;
      integral.evaluate(first);
      integral.evaluate(second);
      panels[i] = first;
      panels.push_back(second);
      refined = true;
    }
  }
}

}  // namespace

Area face_area(const CadModel&, const CadFace& face, double relative) {
  const std::vector<Coedge> coedges = closed_chains(loops_or_whole_domain(face));
  GreenIntegral integral(*face.surface, sampled_bounds(coedges));
  std::vector<Panel> panels;
  for (const Coedge& coedge : coedges) integral.cut(coedge, panels);
  for (Panel& panel : panels) integral.evaluate(panel);
  refine(integral, panels, relative);
  const Area area = sum_of(panels);
  if (!std::isfinite(area.value)) {
    throw Error(ErrorCode::FaceRejected, "the surface has a point inside the face that is not a number; repair it");
  }
  return area;
}

}  // namespace geovor
