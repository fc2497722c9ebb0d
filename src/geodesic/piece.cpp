#include "geodesic/piece.h"

#include <algorithm>
#include <cmath>

namespace geovor {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// Parameters on a border carry the rounding of the knots and of whole periods.
constexpr double kParameterRounding = 8.0 * std::numeric_limits<double>::epsilon();

double rounding_of(double x) { return std::isfinite(x) ? kParameterRounding * std::abs(x) : 0.0; }

// Whole periods by which a span's interval has to be moved to hold x.
double periods_to(Interval range, double x, std::optional<double> period) {
  if (!period || !std::isfinite(range.lo) || !std::isfinite(range.hi)) return 0.0;
  const double slack = rounding_of(range.lo) + rounding_of(range.hi) + rounding_of(x);
  if (x >= range.lo - slack && x <= range.hi + slack) return 0.0;
  return *period * std::round((x - range.middle()) / *period);
}

// A border of the piece that the path at x runs across at once is none of the surface's own: the outermost piece goes
// on.
void open_border_ahead(Interval& range, double x, double towards) {
  if (towards > 0.0 && x >= range.hi - rounding_of(range.hi)) range.hi = kInf;
  if (towards < 0.0 && x <= range.lo + rounding_of(range.lo)) range.lo = -kInf;
}

void open_domain_borders(Interval& range, Interval domain) {
  if (range.lo <= domain.lo + rounding_of(domain.lo)) range.lo = -kInf;
  if (range.hi >= domain.hi - rounding_of(domain.hi)) range.hi = kInf;
}

Interval intersection(Interval a, Interval b) { return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)}; }

// Smallest s >= 0 with w s + c s^2 / 2 = gap. A path on the border (gap within the slack) crosses it here and now if it
// runs outwards, else where it comes back.
double time_to_cross(double gap, double w, double c, double slack, double look) {
  if (gap <= slack) {
    if (w + look * c > 0.0) return 0.0;
    return c > 0.0 ? -2.0 * w / c : kInf;
  }
  const double discriminant = w * w + 2.0 * c * gap;
  if (!(discriminant >= 0.0)) return kInf;
  const double denominator = w + std::sqrt(discriminant);
  return denominator > 0.0 ? 2.0 * gap / denominator : kInf;
}

// The cubic with values 0 and rise and slopes w0 and w1 at 0 and h, as a function of k = s / h.
struct Cubic {
  double a, b, c;  // a k + b k^2 + c k^3
  Cubic(double rise, double w0, double w1, double h) {
    a = h * w0;
    b = 3.0 * rise - h * (2.0 * w0 + w1);
    c = h * (w0 + w1) - 2.0 * rise;
  }
  double operator()(double k) const { return k * (a + k * (b + k * c)); }
};

// Where in (0, 1) the cubic has its maximum (sign = 1) or minimum (sign = -1); `none` if it has none inside.
double extremum(const Cubic& f, double sign, double none) {
  const double a = sign * f.a, b = sign * f.b, c = sign * f.c;
  const double discriminant = b * b - 3.0 * a * c;
  if (!(discriminant > 0.0)) return none;
  const double root = std::sqrt(discriminant);
  // Of the two extrema the maximum is where 2b + 6ck = -2 root.
  const double k = b > 0.0 ? -(b + root) / (3.0 * c) : a / (root - b);
  return k > 0.0 && k < 1.0 ? k : none;
}

// k in (lo, hi) with f(k) = gap, by bisection, for f(lo) < gap < f(hi).
double crossing_between(const Cubic& f, double gap, double lo, double hi) {
  constexpr int kBisections = 40;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (lo + hi);
    (f(middle) > gap ? hi : lo) = middle;
  }
  return 0.5 * (lo + hi);
}

template <class F>
void for_each_border(const Piece& piece, F&& f) {
  for (int axis = 0; axis < 2; ++axis) {
    const Interval range = piece.range(axis);
    if (std::isfinite(range.lo)) f(Border{axis, -1, range.lo});
    if (std::isfinite(range.hi)) f(Border{axis, 1, range.hi});
  }
}

}  // namespace

Piece::Piece(const Surface& surface, Uv p, UvVec towards, bool bounded)
    : span_(surface.span(p, towards)), box_(span_.box), domain_(surface.domain()) {
  const auto u_period = surface.u_period(), v_period = surface.v_period();
  shift_ = {periods_to(box_.u, p.u, u_period), periods_to(box_.v, p.v, v_period)};
  box_.u = {box_.u.lo + shift_.u, box_.u.hi + shift_.u};
  box_.v = {box_.v.lo + shift_.v, box_.v.hi + shift_.v};
  if (u_period) domain_.u = {-kInf, kInf};
  if (v_period) domain_.v = {-kInf, kInf};
  open_border_ahead(box_.u, p.u, towards.u);
  open_border_ahead(box_.v, p.v, towards.v);
  if (bounded) {
    box_ = {intersection(box_.u, domain_.u), intersection(box_.v, domain_.v)};
  } else {
    open_domain_borders(box_.u, domain_.u);
    open_domain_borders(box_.v, domain_.v);
  }
}

bool Piece::has_borders() const {
  return std::isfinite(box_.u.lo) || std::isfinite(box_.u.hi) || std::isfinite(box_.v.lo) || std::isfinite(box_.v.hi);
}

bool Piece::ends_domain(const Border& border) const {
  const Interval domain = border.axis == 0 ? domain_.u : domain_.v;
  return border.side > 0 ? border.at >= domain.hi - rounding_of(domain.hi)
                         : border.at <= domain.lo + rounding_of(domain.lo);
}

bool Piece::blocks(const GeodesicVector& x, UvVec towards, const BorderSlack& slack) const {
  const double ahead[2] = {towards.u, towards.v};
  bool blocked = false;
  for_each_border(*this, [&](const Border& b) {
    const double gap = b.side * (b.at - x[b.axis]);
    const double beyond = slack.along[b.axis];
    if (ends_domain(b) && (gap < -beyond || (gap <= beyond && b.side * ahead[b.axis] > 0.0))) blocked = true;
  });
  return blocked;
}

Interval swept(double x0, double x1, double slope0, double slope1, double h) {
  const Cubic f(x1 - x0, slope0, slope1, h);
  const double top = f(extremum(f, 1.0, 1.0)), bottom = f(extremum(f, -1.0, 1.0));
  return {x0 + std::min({0.0, f(1.0), bottom}), x0 + std::max({0.0, f(1.0), top})};
}

Exit predict_exit(const Piece& piece, const GeodesicVector& x, const GeodesicVector& slope, const BorderSlack& slack) {
  Exit first;
  for_each_border(piece, [&](const Border& b) {
    const double s = time_to_cross(b.side * (b.at - x[b.axis]), b.side * slope[b.axis], b.side * slope[b.axis + 2],
                                   slack.along[b.axis], slack.look);
    if (s < first.s) first = {s, b};
  });
  return first;
}

Exit find_exit(const Piece& piece, const GeodesicVector& x0, const GeodesicVector& x1, double h,
               const BorderSlack& slack) {
  Exit first;
  for_each_border(piece, [&](const Border& b) {
    const double gap = b.side * (b.at - x0[b.axis]), w0 = b.side * x0[b.axis + 2], w1 = b.side * x1[b.axis + 2];
    const Cubic f(b.side * (x1[b.axis] - x0[b.axis]), w0, w1, h);
    const double top = extremum(f, 1.0, 1.0), beyond = slack.along[b.axis];
    if (f(top) <= gap + beyond && f(1.0) <= gap + beyond) return;
    // A path that starts on the border runs inwards first.
    const double bottom = gap <= beyond && w0 <= 0.0 ? extremum(f, -1.0, 0.0) : 0.0;
    const double upper = f(top) > gap && top > bottom ? top : 1.0;
    const double s = h * crossing_between(f, std::max(gap, 0.0), bottom, upper);
    if (s < first.s) first = {s, b};
  });
  return first;
}

// The cubic's error is x'''' s^2 (h - s)^2 / 24, at most x'''' h^4 / 384, and x'' at the start lacks x'''' h^2 / 12.
std::vector<Exit> doubtful_turns(const Piece& piece, const GeodesicVector& x0, const GeodesicVector& slope,
                                 const GeodesicVector& x1, double h, const BorderSlack& slack) {
  constexpr double kCubicError = 1.0 / 32.0;
  // The fourth derivative changes over a step, by less than this factor; and where it vanishes at the start the error
  // is still a small part of the cubic's own bend.
  constexpr double kChange = 8.0, kPartOfBend = 1e-3;
  std::vector<Exit> turns;
  for_each_border(piece, [&](const Border& b) {
    const double w0 = b.side * x0[b.axis + 2], w1 = b.side * x1[b.axis + 2];
    if (!(w0 > 0.0 && w1 < 0.0)) return;
    const double gap = b.side * (b.at - x0[b.axis]);
    const Cubic f(b.side * (x1[b.axis] - x0[b.axis]), w0, w1, h);
    const double k = extremum(f, 1.0, 1.0);
    const double lacking = std::abs(h * h * b.side * slope[b.axis + 2] - 2.0 * f.b);
    const double margin =
        kChange * kCubicError * lacking + kPartOfBend * (std::abs(f.b) + std::abs(f.c)) + slack.along[b.axis];
    if (k < 1.0 && f(k) <= gap + slack.along[b.axis] && f(k) > gap - margin) turns.push_back({h * k, b});
  });
  return turns;
}

double length_to_border(const Border& b, const GeodesicVector& x, const GeodesicVector& slope) {
  const double gap = b.at - x[b.axis], w = slope[b.axis], c = slope[b.axis + 2];
  const double discriminant = w * w + 2.0 * c * gap;
  if (!(discriminant >= 0.0)) return gap / w;
  return 2.0 * gap / (w + std::copysign(std::sqrt(discriminant), w));
}

}  // namespace geovor
