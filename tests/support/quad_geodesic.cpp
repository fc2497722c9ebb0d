#include "support/quad_geodesic.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace geovor::testing {
namespace {

// u, v, the momenta T . Su and T . Sv of the unit tangent T, y, y'.
using State = std::array<Float128, 6>;
using Piece = std::array<int, 2>;

const Float128 kTolerance = Float128(1e-13) * Float128(1e-13);  // of a step
const Float128 kOnLine = Float128(1e-14) * Float128(1e-14);     // in a parameter
constexpr int kRows = 11;                                       // of the extrapolation: order 22
const Float128 kFirstStep = Float128(1) / 8;
// Where there are knot lines, so that no two turns of u or of v fall into one step.
const Float128 kLongestStep = Float128(1) / 32;
constexpr int kMostSteps = 20000;
constexpr int kMostCuts = 200;

State combine(const State& a, const Float128& k, const State& b) {
  State out;
  for (int i = 0; i < 6; ++i) out[i] = a[i] + k * b[i];
  return out;
}

struct Metric {
  Float128 E, F, G;
  explicit Metric(const QuadJet& j) : E(dot(j.Su, j.Su)), F(dot(j.Su, j.Sv)), G(dot(j.Sv, j.Sv)) {}
  Float128 W2() const { return E * G - F * F; }
  std::array<Float128, 2> velocity(const Float128& p, const Float128& q) const {
    return {(G * p - F * q) / W2(), (E * q - F * p) / W2()};
  }
};

// With H = g^ij p_i p_j / 2: p_i' = T . dT/du_i at fixed velocity.
State slope(const QuadSurface& surface, Piece piece, const State& x) {
  const QuadJet j = surface.jet(x[0], x[1], piece);
  const Metric g(j);
  const auto [du, dv] = g.velocity(x[2], x[3]);
  const QuadVec T = du * j.Su + dv * j.Sv, n = cross(j.Su, j.Sv);
  const Float128 L = dot(n, j.Suu), M = dot(n, j.Suv), N = dot(n, j.Svv), W2 = g.W2();
  return {du,
          dv,
          dot(T, du * j.Suu + dv * j.Suv),
          dot(T, du * j.Suv + dv * j.Svv),
          x[5],
          -(L * N - M * M) / (W2 * W2) * x[4]};
}

// Gragg's modified midpoint rule with n steps over h.
State midpoint_rule(const QuadSurface& surface, Piece piece, const State& x, const State& f, const Float128& h, int n) {
  const Float128 part = h / n;
  State before = x, here = combine(x, part, f);
  for (int i = 1; i < n; ++i) {
    const State next = combine(before, 2 * part, slope(surface, piece, here));
    before = here;
    here = next;
  }
  return here;
}

// One extrapolated step; nothing if it does not settle.
std::optional<State> leap(const QuadSurface& surface, Piece piece, const State& x, const Float128& h) {
  const State f = slope(surface, piece, x);
  std::vector<State> last;
  for (int k = 0; k < kRows; ++k) {
    std::vector<State> row{midpoint_rule(surface, piece, x, f, h, 2 * (k + 1))};
    Float128 change = 1;
    for (int j = 1; j <= k; ++j) {
      const Float128 ratio = Float128(k + 1) / Float128(k + 1 - j), factor = 1 / (ratio * ratio - 1);
      State better;
      change = 0;
      for (int i = 0; i < 6; ++i) {
        const Float128 correction = (row[j - 1][i] - last[j - 1][i]) * factor;
        better[i] = row[j - 1][i] + correction;
        change = std::max(change, Float128(abs(correction)));
      }
      row.push_back(better);
    }
    if (k > 2 && change < kTolerance) return row.back();
    last = std::move(row);
  }
  return std::nullopt;
}

class Walker {
 public:
  Walker(const QuadSurface& surface, const std::array<Float128, 2>& start, const std::array<Float128, 2>& d)
      : surface_(surface), piece_{piece_at(0, start[0], d[0]), piece_at(1, start[1], d[1])} {
    const QuadJet j = surface.jet(start[0], start[1], piece_);
    const QuadVec T = normalized(d[0] * j.Su + d[1] * j.Sv);
    x_ = {start[0], start[1], dot(T, j.Su), dot(T, j.Sv), 0, 1};
  }

  QuadEnd walk(const Float128& length) {
    const bool smooth = surface_.lines(0).empty() && surface_.lines(1).empty();
    Float128 done = 0, h = smooth ? kFirstStep : kLongestStep;
    for (int i = 0; done < length; ++i) {
      if (i == kMostSteps) throw std::runtime_error("the quad geodesic makes no way");
      done += step(std::min(Float128(length - done), h), h);
      if (!smooth) h = std::min(h, kLongestStep);
    }
    return end();
  }

 private:
  int piece_at(int axis, const Float128& x, const Float128& towards) const {
    const auto& lines = surface_.lines(axis);
    return static_cast<int>(
        std::count_if(lines.begin(), lines.end(), [&](double line) { return x > line || (x == line && towards > 0); }));
  }

  Float128 velocity(const State& x, int axis) const {
    return Metric(surface_.jet(x[0], x[1], piece_)).velocity(x[2], x[3])[axis];
  }

  // Goes on by at most `most`; what it went. `h` is the step to try next.
  Float128 step(Float128 most, Float128& h) {
    std::optional<State> to;
    while (!(to = leap(surface_, piece_, x_, most))) h = most = most / 2;
    if (most == h) h *= Float128(3) / 2;
    for (int axis = 0; axis < 2; ++axis) stop_at_turn(axis, most, *to);
    for (int axis = 0; axis < 2; ++axis) stop_at_line(axis, most, *to);
    x_ = *to;
    for (int axis = 0; axis < 2; ++axis) cross_line(axis);
    return most;
  }

  // Between two stops u and v are monotone, so that no line is crossed to and fro unseen.
  void stop_at_turn(int axis, Float128& most, State& to) const {
    if (surface_.lines(axis).empty()) return;
    const Float128 before = velocity(x_, axis), after = velocity(to, axis);
    if (before * after >= 0 || abs(before) < kOnLine) return;
    cut(most, to, [&](const State& x) { return velocity(x, axis) * (before > 0 ? -1 : 1); });
  }

  void stop_at_line(int axis, Float128& most, State& to) const {
    const auto& lines = surface_.lines(axis);
    const int k = piece_[axis];
    if (k < static_cast<int>(lines.size()) && to[axis] > lines[k] && x_[axis] < lines[k])
      cut(most, to, [&](const State& x) { return x[axis] - lines[k]; });
    else if (k > 0 && to[axis] < lines[k - 1] && x_[axis] > lines[k - 1])
      cut(most, to, [&](const State& x) { return lines[k - 1] - x[axis]; });
  }

  // Shortens the step to where f, negative at its start and positive at its end, is zero: false position with the
  // Illinois rule.
  template <class F>
  void cut(Float128& most, State& to, const F& f) const {
    Float128 a = 0, fa = f(x_), b = most, fb = f(to);
    for (int last = 0, i = 0; i < kMostCuts; ++i) {
      const Float128 s = (a * fb - b * fa) / (fb - fa);
      const std::optional<State> x = leap(surface_, piece_, x_, s);
      if (!x) throw std::runtime_error("a shorter step fails where a longer one did not");
      const Float128 fs = f(*x);
      if (abs(fs) < kOnLine || b - a < kOnLine) {
        most = s;
        to = *x;
        return;
      }
      const int side = fs > 0 ? 1 : -1;
      (side > 0 ? b : a) = s;
      (side > 0 ? fb : fa) = fs;
      if (side == last) (side > 0 ? fa : fb) /= 2;
      last = side;
    }
    throw std::runtime_error("no place found where the path meets a knot line");
  }

  void cross_line(int axis) {
    const auto& lines = surface_.lines(axis);
    const int k = piece_[axis];
    const Float128 way = velocity(x_, axis);
    const bool up = k < static_cast<int>(lines.size()) && abs(x_[axis] - lines[k]) < 4 * kOnLine && way > 0;
    const bool down = k > 0 && abs(x_[axis] - lines[k - 1]) < 4 * kOnLine && way < 0;
    if (!up && !down) return;
    x_[axis] = lines[up ? k : k - 1];
    piece_[axis] += up ? 1 : -1;
    ++crossed_;
    refract(axis, way);
  }

  // Along the line Su (or Sv) is the same on both sides, and so is its momentum; the other follows from |T| = 1:
  // with u' known, p = E u' + F v' and q = F u' + G v', E G - F^2 times u'^2 is G - q^2.
  void refract(int axis, const Float128& way) {
    const Metric g(surface_.jet(x_[0], x_[1], piece_));
    const Float128 along = x_[2 + (1 - axis)], own = axis == 0 ? g.G : g.E;
    const Float128 speed = sqrt(std::max(Float128((own - along * along) / g.W2()), Float128(0)));
    const Float128 d = way > 0 ? speed : -speed, other = (along - g.F * d) / own;
    x_[2 + axis] = (axis == 0 ? g.E : g.G) * d + g.F * other;
  }

  QuadEnd end() const {
    const QuadJet j = surface_.jet(x_[0], x_[1], piece_);
    const auto [du, dv] = Metric(j).velocity(x_[2], x_[3]);
    QuadEnd e{x_[0], x_[1], j.S, du * j.Su + dv * j.Sv, {}, x_[4], x_[5], crossed_};
    e.across = cross(normalized(cross(j.Su, j.Sv)), e.tangent);
    return e;
  }

  const QuadSurface& surface_;
  Piece piece_;
  State x_;
  int crossed_ = 0;
};

}  // namespace

QuadEnd quad_geodesic(const QuadSurface& surface, const std::array<Float128, 2>& start,
                      const std::array<Float128, 2>& direction, const Float128& length) {
  return Walker(surface, start, direction).walk(length);
}

QuadEnd quad_geodesic(const QuadSurface& surface, Uv start, UvVec direction, const Float128& length) {
  return quad_geodesic(surface, {Float128(start.u), Float128(start.v)}, {Float128(direction.u), Float128(direction.v)},
                       length);
}

Float128 neighbours_spread(const QuadSurface& surface, Uv start, UvVec direction, const Float128& length) {
  const QuadJet j = quad_jet(surface, start);
  const Metric g(j);
  const QuadVec T = normalized(Float128(direction.u) * j.Su + Float128(direction.v) * j.Sv);
  const QuadVec N = cross(normalized(cross(j.Su, j.Sv)), T);
  const auto at = [&](const Float128& t) {
    const QuadVec d = cos(t) * T + sin(t) * N;
    return quad_geodesic(surface, {Float128(start.u), Float128(start.v)}, g.velocity(dot(d, j.Su), dot(d, j.Sv)),
                         length)
        .x;
  };
  // Central differences of sixth order.
  const Float128 h = Float128(1) / 4096;
  const QuadVec d1 = at(h) - at(-h), d2 = at(2 * h) - at(-2 * h), d3 = at(3 * h) - at(-3 * h);
  const QuadVec spread = (1 / (60 * h)) * (Float128(45) * d1 - Float128(9) * d2 + d3);
  return dot(spread, quad_geodesic(surface, start, direction, length).across);
}

QuadJet quad_jet(const QuadSurface& surface, Uv p) {
  std::array<int, 2> piece;
  for (int axis = 0; axis < 2; ++axis) {
    const auto& lines = surface.lines(axis);
    const double x = axis == 0 ? p.u : p.v;
    piece[axis] = static_cast<int>(std::upper_bound(lines.begin(), lines.end(), x) - lines.begin());
  }
  return surface.jet(Float128(p.u), Float128(p.v), piece);
}

TraceErrors errors_of(const QuadSurface& surface, const QuadEnd& truth, const GeodesicState& state) {
  const QuadJet j = quad_jet(surface, state.p);
  const QuadVec T = Float128(state.d.u) * j.Su + Float128(state.d.v) * j.Sv;
  return {static_cast<double>(norm(j.S - truth.x)), static_cast<double>(norm(T - truth.tangent)),
          static_cast<double>(abs(state.y - truth.y))};
}

}  // namespace geovor::testing
