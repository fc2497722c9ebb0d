// Newton's method for the foot of a point P: the least f = |S(u,v) - P|^2 / 2.
//
// It works with lengths in space along the unit vectors eu = Su/|Su|, ev = Sv/|Sv|, so that the steps do not depend on
// how the parameters run: the gradient is (r.eu, r.ev), r = S - P, and the Hessian
//   1 + (r.n) L/E      eu.ev + (r.n) M/(|Su||Sv|)
//                      1 + (r.n) N/G
// in which only the curvature of the surface appears. What the bending of the parameter lines adds to the second
// derivatives has no place in it: it is retract() that turns lengths into parameters (Absil, Mahony, Sepulchre,
// Optimization Algorithms on Matrix Manifolds, 2008, ch. 5 and 6: quadratic with any retraction of first order).
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "surface/project.h"
#include "surface/retraction.h"

namespace geovor {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kEps = std::numeric_limits<double>::epsilon();

// The tangential part of the residual, r.eu, is a difference of coordinates: it can't be made smaller than a few units
// in their last place. Iteration aims at the first bound; a result within the second counts as converged.
constexpr double kAim = 4.0;
constexpr double kAccept = 1e3;
// A derivative is that much less exact, in parts of the surface's size over the box, than a coordinate.
constexpr double kDerivativeNoise = 10.0;

constexpr int kMaxSteps = 60;

// How often an iteration may run into a pole, or the end of a line that stops, and leave it again; one is usual.
constexpr int kRounds = 8;

// The state of the iteration at one parameter. The two entries of an array belong to u and v.
struct Residual {
  SurfaceJet j;
  Xyz r;
  double f;
  Xyz e[2];           // Su/|Su|, Sv/|Sv|; zero where these vanish
  double h[2];        // |Su|, |Sv|
  double g[2];        // r.e
  bool free[2];       // false: at the border of the box, and f falls only outwards
  double tangential;  // the largest |g| over the free directions
  double rounding;    // of positions

  bool moves(int k) const { return free[k] && h[k] > 0.0; }
};

double& at(Uv& p, int k) { return k == 0 ? p.u : p.v; }
double at(const Uv& p, int k) { return k == 0 ? p.u : p.v; }

// What does not change during one projection.
struct Task {
  const Surface& surface;
  const Xyz& point;
  Interval box[2];                   // infinite in periodic directions
  double period[2];                  // infinite where there is none
  double length[2];                  // of the box, or the period
  double extent = 0.0;               // of the surface, as far as it was measured
  bool stopped[2] = {false, false};  // held at the end of the box at which the line stops

  Task(const Surface& s, const Xyz& x, const UvBox& given) : surface(s), point(x) {
    period[0] = s.u_period().value_or(kInf);
    period[1] = s.v_period().value_or(kInf);
    const Interval sides[2] = {given.u, given.v};
    for (int k : {0, 1}) {
      const bool closed = std::isfinite(period[k]);
      box[k] = closed ? Interval{-kInf, kInf} : sides[k];
      length[k] = closed ? period[k] : sides[k].length();
    }
  }

  Uv clamp(Uv p) const { return {box[0].clamp(p.u), box[1].clamp(p.v)}; }

  bool held(int k, Uv p, double g) const {
    return stopped[k] || (at(p, k) <= box[k].lo && g > 0.0) || (at(p, k) >= box[k].hi && g < 0.0);
  }

  Residual residual(Uv p) const {
    Residual s;
    s.j = surface.jet(p);
    s.r = s.j.S - point;
    s.f = 0.5 * s.r.squaredNorm();
    s.tangential = 0.0;
    // Positions are sums of terms as large as the surface is over the box, wherever it lies.
    double size = extent + s.j.S.cwiseAbs().maxCoeff() + point.cwiseAbs().maxCoeff();
    for (int k : {0, 1}) {
      const Xyz& d = k == 0 ? s.j.Su : s.j.Sv;
      s.h[k] = d.norm();
      s.e[k] = s.h[k] > 0.0 ? Xyz(d / s.h[k]) : Xyz(Xyz::Zero());
      s.g[k] = s.r.dot(s.e[k]);
      s.free[k] = !held(k, p, s.g[k]);
      if (s.free[k]) s.tangential = std::max(s.tangential, std::abs(s.g[k]));
      if (std::isfinite(length[k])) size += s.h[k] * length[k];
    }
    s.rounding = kEps * size;
    return s;
  }
};

struct Hessian {
  double uu, uv, vv;
};

// In the direction k alone: along the line, whose curvature counts as a whole.
double along(const Residual& s, int k) {
  const Xyz& d = k == 0 ? s.j.Suu : s.j.Svv;
  return 1.0 + s.r.dot(d - s.e[k].dot(d) * s.e[k]) / (s.h[k] * s.h[k]);
}

Hessian hessian(const Residual& s, bool newton) {
  const double F = s.e[0].dot(s.e[1]);
  if (!newton) return {1.0, F, 1.0};
  if (!s.moves(0) || !s.moves(1)) return {along(s, 0), F, along(s, 1)};
  const Xyz n = s.e[0].cross(s.e[1]);
  const double scale = s.r.dot(n) / n.squaredNorm();
  return {1.0 + scale * n.dot(s.j.Suu) / (s.h[0] * s.h[0]), F + scale * n.dot(s.j.Suv) / (s.h[0] * s.h[1]),
          1.0 + scale * n.dot(s.j.Svv) / (s.h[1] * s.h[1])};
}

// The Levenberg step -(H + lambda)^-1 g over the free directions; false where the matrix is not positive definite.
bool damped_step(const Residual& s, const Hessian& H, double (&way)[2]) {
  if (s.moves(0) && s.moves(1)) {
    const double det = H.uu * H.vv - H.uv * H.uv;
    if (!(H.uu > 0.0 && H.vv > 0.0 && det > kEps * H.uu * H.vv)) return false;
    way[0] = (H.uv * s.g[1] - H.vv * s.g[0]) / det;
    way[1] = (H.uv * s.g[0] - H.uu * s.g[1]) / det;
  } else {
    if ((s.moves(0) && !(H.uu > 0.0)) || (s.moves(1) && !(H.vv > 0.0))) return false;
    way[0] = s.moves(0) ? -s.g[0] / H.uu : 0.0;
    way[1] = s.moves(1) ? -s.g[1] / H.vv : 0.0;
  }
  return std::isfinite(way[0]) && std::isfinite(way[1]);
}

// f is known to |r| times the rounding of positions, so that it resolves the foot to the root of that only: near the
// end a step that leaves f unchanged, to rounding, is good if it lowers the tangential residual. Where the parameters
// run slowly the jet tells less of the surface's size, and so of its rounding: a residual that falls much makes up for
// it. On the way to the end of a line nothing falls any more.
bool better(const Residual& now, const Residual& then, bool to_end) {
  constexpr double kMuch = 0.1, kSlower = 64.0;
  const double noise = kAim * now.rounding * (std::sqrt(2.0 * now.f) + now.rounding);
  if (then.f < now.f - noise) return true;
  if (to_end && then.f <= now.f + noise) return true;
  return then.tangential < now.tangential &&
         then.f <= now.f + (then.tangential < kMuch * now.tangential ? kSlower * noise : noise);
}

struct State {
  Uv p;
  Residual s;
};

// Of the line of the parameter k.
LineSpeed speed(const Residual& s, int k) {
  if (!s.moves(k)) return {};
  return {s.h[k], s.e[k].dot(k == 0 ? s.j.Suu : s.j.Svv) / s.h[k], s.moves(1 - k) ? s.e[k].dot(s.j.Suv) / s.h[k] : 0.0};
}

// A line that stops at the end of the box is followed up to there by steps of ever smaller size. What is left is
// nothing in the end: then the foot is on the border.
void stop_at_end(Task& task, State& at_, const Retraction& step) {
  constexpr double kNothing = 0.3 * kAccept;
  for (int k : {0, 1}) {
    if (!(k == 0 ? step.u_blocked : step.v_blocked)) continue;
    const double x = at(at_.p, k);
    if (!(length_from_stop(x, speed(at_.s, k), task.box[k]) < kNothing * at_.s.rounding)) continue;
    at(at_.p, k) = x - task.box[k].lo < task.box[k].hi - x ? task.box[k].lo : task.box[k].hi;
    task.stopped[k] = true;
    at_.s = task.residual(at_.p);
  }
}

// Where one direction ends before the step does, the other one makes the best of that: the minimum on the border, not
// the part along the border of a step to a minimum beyond it.
void mind_border(const Task& task, const State& now, const LineSpeed (&lines)[2], const Hessian& H, double (&way)[2]) {
  if (!(now.s.moves(0) && now.s.moves(1))) return;
  double room[2];
  for (int k : {0, 1}) {
    const double x = at(now.p, k), to_end = way[k] > 0.0 ? task.box[k].hi - x : x - task.box[k].lo;
    room[k] = to_end * now.s.h[k];
    if (way[k] * lines[k].own < 0.0) room[k] = std::min(room[k], length_from_stop(x, lines[k], task.box[k]));
  }
  const double diagonal[2] = {H.uu, H.vv};
  for (int k : {0, 1}) {
    if (!(std::abs(way[k]) > room[k])) continue;
    const double other = -(now.s.g[1 - k] + H.uv * std::copysign(room[k], way[k])) / diagonal[1 - k];
    if (other * way[1 - k] > 0.0 && std::abs(other) > room[1 - k]) continue;
    way[1 - k] = other;
    return;
  }
}

// One accepted step, by Newton if that works at some damping, else by Gauss-Newton; false where neither lowers f.
bool advance(Task& task, State& now) {
  constexpr double kDampings[] = {0.0, 0.1, 1.0, 10.0, 1e2, 1e4, 1e6};
  const LineSpeed lines[2] = {speed(now.s, 0), speed(now.s, 1)};
  const UvBox box{task.box[0], task.box[1]};
  const UvVec turn{task.period[0], task.period[1]};
  for (const bool newton : {true, false}) {
    Hessian H = hessian(now.s, newton);
    const double uu = H.uu, vv = H.vv;
    for (const double lambda : kDampings) {
      H.uu = uu + lambda;
      H.vv = vv + lambda;
      double way[2];
      if (!damped_step(now.s, H, way)) continue;
      mind_border(task, now, lines, H, way);
      const Retraction step = retract(now.p, way[0], way[1], lines[0], lines[1], box, turn);
      if (step.uv == now.p) continue;
      const State then{step.uv, task.residual(step.uv)};
      if (!better(now.s, then.s, step.u_blocked || step.v_blocked)) continue;
      now = then;
      stop_at_end(task, now, step);
      return true;
    }
  }
  return false;
}

// The parameter at which a line has gone about `length` from p, inwards from the end of the box that is nearer; nothing
// where it goes no faster there than at p, which is no end then at which it stops.
std::optional<double> inwards(Task& task, const State& from, int k, double length) {
  constexpr double kFaster = 30.0, kAbout = 3.0;
  constexpr int kTries = 10;
  const double x = at(from.p, k), L = task.length[k];
  if (!std::isfinite(task.box[k].length())) return std::nullopt;
  const double sign = x - task.box[k].lo < task.box[k].hi - x ? 1.0 : -1.0;
  const auto chord = [&](double t) {
    Uv q = from.p;
    at(q, k) = x + sign * t;
    return (task.surface.position(q) - from.s.j.S).norm();
  };
  double t = 0.5 * L, c = chord(t), power = 2.0;
  if (!(c > kFaster * from.s.h[k] * t && c > kAim * from.s.rounding)) return std::nullopt;
  task.extent = std::max(task.extent, c);
  for (int i = 0; i < kTries && (c > kAbout * length || kAbout * c < length) && c > 0.0; ++i) {
    const double next = std::min(t * std::pow(length / c, 1.0 / power), 0.5 * L);
    if (next == t) break;
    const double went = chord(next);
    power = std::clamp(std::log(went / c) / std::log(next / t), 1.0, 12.0);
    t = next;
    c = went;
  }
  return x + sign * t;
}

// At the end of a line that stops there the gradient vanishes, or rounding has eaten it: go on from a place inside.
bool leave_end(Task& task, State& from, int k) {
  constexpr double kSlow = 1e-3, kShare = 0.1;
  const double distance = std::sqrt(2.0 * from.s.f);
  if (!(from.s.h[k] * task.length[k] < kSlow * distance)) return false;
  const auto x = inwards(task, from, k, kShare * distance);
  if (!x) return false;
  at(from.p, k) = *x;
  from.s = task.residual(from.p);
  return true;
}

// A foot on the border is none if f falls a little inside of it, by more than what that place differs.
bool falls_inside(Task& task, State& from, int k) {
  constexpr double kShare = 1e-6, kSlope = 1e-5;
  const double distance = std::sqrt(2.0 * from.s.f);
  const auto x = inwards(task, from, k, kShare * distance);
  if (!x) return false;
  State inside = from;
  at(inside.p, k) = *x;
  task.stopped[k] = false;
  inside.s = task.residual(inside.p);
  const double slope = *x > at(from.p, k) ? inside.s.g[k] : -inside.s.g[k];
  task.stopped[k] = !(slope < -kSlope * distance);
  if (!task.stopped[k]) from = inside;
  return !task.stopped[k];
}

// Whether the line of the parameter k through p is, against the distance, one point.
bool is_pole(const Task& task, const State& at_, int k) {
  constexpr double kCollapsed = 1e-8, kPoint = 1e-3, kFar = 0.37;
  if (!(at_.s.h[k] <= kCollapsed * at_.s.h[1 - k]) || !std::isfinite(task.length[k])) return false;
  Uv q = at_.p;
  const double x = at(q, k), step = kFar * task.length[k];
  at(q, k) = x + step <= task.box[k].hi ? x + step : x - step;
  return (task.surface.position(q) - at_.s.j.S).norm() <= kPoint * std::sqrt(2.0 * at_.s.f) + kAim * at_.s.rounding;
}

// At a pole one parameter, k, moves nothing, so that the gradient can't say which meridian to take: look at the slopes
// of all of them, and go down the steepest as far as f falls. False where none leads down: the pole is the foot.
bool leave_pole(const Task& task, State& from, int k) {
  constexpr int kMeridians = 24;
  constexpr int kHalvings = 40;
  const int out = 1 - k;
  Interval around = task.box[k];
  if (!std::isfinite(around.length())) around = {0.0, task.period[k]};
  Uv start = from.p;
  double slope = kAim * from.s.rounding, length = 0.0;
  for (int i = 0; i < kMeridians; ++i) {
    Uv q = from.p;
    at(q, k) = around.lo + around.length() * i / kMeridians;
    const Residual s = task.residual(q);
    if (!s.free[out] || !(std::abs(s.g[out]) > slope)) continue;
    slope = std::abs(s.g[out]);
    length = -s.g[out] / s.h[out];
    start = q;
  }
  for (int i = 0; i < kHalvings && length != 0.0; ++i, length *= 0.5) {
    State then{start, {}};
    at(then.p, out) = task.box[out].clamp(at(start, out) + length);
    then.s = task.residual(then.p);
    if (!(then.s.f < from.s.f)) continue;
    from = then;
    return true;
  }
  return false;
}

int pole(const Task& task, const State& s) { return is_pole(task, s, 0) ? 0 : is_pole(task, s, 1) ? 1 : -1; }

void iterate(Task& task, State& now) {
  for (int i = 0; i < kMaxSteps && now.s.tangential > kAim * now.s.rounding; ++i)
    if (!advance(task, now) || pole(task, now) >= 0) break;
}

// Whether there is more to do than to say that the foot is found.
bool leave(Task& task, State& now) {
  if (const int k = pole(task, now); k >= 0) return leave_pole(task, now, k);
  for (int k : {0, 1})
    if (task.stopped[k] && falls_inside(task, now, k)) return true;
  return false;
}

bool settled(const Task& task, const Residual& s) {
  if (!std::isfinite(s.f)) return false;
  for (int k : {0, 1}) {
    // |Su| is known to the rounding of the surface's size over the box.
    const double lost = kDerivativeNoise * std::sqrt(2.0 * s.f) / (s.h[k] * task.length[k]);
    const double bound = std::max(kAccept, kAim * lost) * s.rounding;
    if (s.moves(k) && !(std::abs(s.g[k]) <= bound)) return false;
  }
  return true;
}

}  // namespace

Projection project_near(const Surface& surface, const Xyz& point, Uv guess, const UvBox& box) {
  Task task(surface, point, box);
  State now{task.clamp(guess), {}};
  now.s = task.residual(now.p);
  for (int k : {0, 1}) leave_end(task, now, k);
  if (const int k = pole(task, now); k >= 0) leave_pole(task, now, k);
  for (int round = 0; round < kRounds; ++round) {
    iterate(task, now);
    if (!leave(task, now)) break;
  }
  Projection result;
  result.uv = now.p;
  result.foot = now.s.j.S;
  result.distance = now.s.r.norm();
  result.converged = settled(task, now.s);
  return result;
}

}  // namespace geovor
