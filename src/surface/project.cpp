#include "surface/project.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace geovor {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

// The tangential part of the residual, |r.Su| / |Su|, is a difference of coordinates: it can't be made smaller than a
// few units in their last place. Iteration aims at the first bound; a result within the second counts as converged.
constexpr double kAim = 4.0;
constexpr double kAccept = 1e4;

constexpr int kMaxSteps = 60;

// How often an iteration may run into a pole and leave it on a better meridian; one is usual.
constexpr int kPoles = 8;

// The state of the minimization of f = |S(u,v) - P|^2 / 2 at one parameter.
struct Residual {
  SurfaceJet j;
  Xyz r;
  double f;
  double gu, gv;        // gradient of f
  double hu, hv;        // |Su|, |Sv|
  bool free_u, free_v;  // false: at the border of the box, and f falls only outwards
  double tangential;    // the largest of |gu|/|Su|, |gv|/|Sv| over the free directions
};

// What does not change during one projection.
struct Task {
  const Surface& surface;
  const Xyz& point;
  UvBox box;  // infinite in periodic directions

  bool held(const Interval& range, double x, double g) const {
    return (x <= range.lo && g > 0.0) || (x >= range.hi && g < 0.0);
  }

  Residual at(Uv p) const {
    Residual s;
    s.j = surface.jet(p);
    s.r = s.j.S - point;
    s.f = 0.5 * s.r.squaredNorm();
    s.gu = s.r.dot(s.j.Su);
    s.gv = s.r.dot(s.j.Sv);
    s.hu = s.j.Su.norm();
    s.hv = s.j.Sv.norm();
    s.free_u = !held(box.u, p.u, s.gu);
    s.free_v = !held(box.v, p.v, s.gv);
    const double tu = s.free_u && s.hu > 0.0 ? std::abs(s.gu) / s.hu : 0.0;
    const double tv = s.free_v && s.hv > 0.0 ? std::abs(s.gv) / s.hv : 0.0;
    s.tangential = std::max(tu, tv);
    return s;
  }

  // Near a pole a step that is short in space may be many turns long.
  UvVec shorten(UvVec d) const {
    constexpr double kTurn = 0.25;
    if (const auto period = surface.u_period()) d.u = std::clamp(d.u, -kTurn * *period, kTurn * *period);
    if (const auto period = surface.v_period()) d.v = std::clamp(d.v, -kTurn * *period, kTurn * *period);
    return d;
  }

  double rounding(const Residual& s) const {
    return kEps * (s.j.S.cwiseAbs().maxCoeff() + point.cwiseAbs().maxCoeff());
  }
};

// The Levenberg step -(H + lambda D)^-1 g over the free directions, D = diag(E, G), so that it does not depend on how
// the parameters are scaled. `newton`: H is the full Hessian; otherwise Gauss-Newton's, without the curvature. False
// where the matrix is not positive definite.
bool damped_step(const Residual& s, bool newton, double lambda, UvVec& step) {
  const double E = s.hu * s.hu, F = s.j.Su.dot(s.j.Sv), G = s.hv * s.hv;
  const double curve = newton ? 1.0 : 0.0;
  const double a = E * (1.0 + lambda) + curve * s.r.dot(s.j.Suu);
  const double b = F + curve * s.r.dot(s.j.Suv);
  const double c = G * (1.0 + lambda) + curve * s.r.dot(s.j.Svv);
  if (s.free_u && s.free_v) {
    const double det = a * c - b * b;
    if (!(a > 0.0 && c > 0.0 && det > kEps * a * c)) return false;
    step = {(b * s.gv - c * s.gu) / det, (b * s.gu - a * s.gv) / det};
    return is_finite(step);
  }
  if (s.free_u && !(a > 0.0)) return false;
  if (s.free_v && !(c > 0.0)) return false;
  step = {s.free_u ? -s.gu / a : 0.0, s.free_v ? -s.gv / c : 0.0};
  return is_finite(step);
}

// f is known to |r| times the rounding of the coordinates, so that it resolves the foot to the root of that only: near
// the end a step that leaves f unchanged, to rounding, is good if it lowers the tangential residual.
bool better(const Task& task, const Residual& now, const Residual& then) {
  const double rounding = task.rounding(now);
  const double noise = kAim * rounding * (std::sqrt(2.0 * now.f) + rounding);
  if (then.f < now.f - noise) return true;
  return then.f <= now.f + noise && then.tangential < now.tangential;
}

// One accepted step, by Newton if that works at some damping, else by Gauss-Newton; false where neither lowers f.
bool advance(const Task& task, Uv& p, Residual& s) {
  constexpr double kDampings[] = {0.0, 0.1, 1.0, 10.0, 1e2, 1e4, 1e6};
  for (const bool newton : {true, false}) {
    for (const double lambda : kDampings) {
      UvVec step;
      if (!damped_step(s, newton, lambda, step)) continue;
      const Uv q = task.box.clamp(p + task.shorten(step));
      if (q == p) continue;
      const Residual then = task.at(q);
      if (!better(task, s, then)) continue;
      p = q;
      s = then;
      return true;
    }
  }
  return false;
}

bool is_degenerate(const Residual& s) {
  constexpr double kCollapsed = 1e-8;
  return std::min(s.hu, s.hv) <= kCollapsed * std::max(s.hu, s.hv);
}

// At a pole one parameter moves nothing, so that the gradient can't say which meridian to take: look at the slopes of
// all of them, and go down the steepest as far as f falls. False where no meridian leads down: the pole is the foot.
bool leave_pole(const Task& task, Uv& p, Residual& s) {
  constexpr int kMeridians = 24;
  constexpr int kHalvings = 40;
  const bool u_collapsed = s.hu < s.hv;
  const UvBox domain = task.surface.domain();
  Interval around = u_collapsed ? task.box.u : task.box.v;
  if (!std::isfinite(around.length())) around = u_collapsed ? domain.u : domain.v;
  if (!std::isfinite(around.length())) return false;

  Uv start = p;
  double slope = kAim * task.rounding(s), length = 0.0;
  for (int i = 0; i < kMeridians; ++i) {
    const double turn = around.lo + around.length() * i / kMeridians;
    const Uv q = u_collapsed ? Uv{turn, p.v} : Uv{p.u, turn};
    const Residual at = task.at(q);
    const double h = u_collapsed ? at.hv : at.hu, g = u_collapsed ? at.gv : at.gu;
    if (!(u_collapsed ? at.free_v : at.free_u) || !(std::abs(g) > slope * h)) continue;
    slope = std::abs(g) / h;
    length = -g / (h * h);
    start = q;
  }
  for (int i = 0; i < kHalvings && length != 0.0; ++i, length *= 0.5) {
    const Uv q = task.box.clamp(start + (u_collapsed ? UvVec{0.0, length} : UvVec{length, 0.0}));
    const Residual then = task.at(q);
    if (!(then.f < s.f)) continue;
    p = q;
    s = then;
    return true;
  }
  return false;
}

void iterate(const Task& task, Uv& p, Residual& s) {
  for (int i = 0; i < kMaxSteps && s.tangential > kAim * task.rounding(s); ++i)
    if (!advance(task, p, s) || is_degenerate(s)) break;
}

// Parameters, along one direction of `box`, at which to look for a start: a few in each analytic piece.
std::vector<double> samples(const Surface& surface, const UvBox& box, bool along_u, double reach) {
  constexpr int kPerSpan = 3, kLeast = 16, kMost = 128;
  const Interval given = along_u ? box.u : box.v;
  const Interval other = along_u ? box.v : box.u;
  const Interval range{std::max(given.lo, -reach), std::min(given.hi, reach)};
  const double fixed = other.clamp(0.0);
  int spans = 0;
  for (double x = range.lo; spans < kMost && x < range.hi; ++spans) {
    const Span s = surface.span(along_u ? Uv{x, fixed} : Uv{fixed, x}, {1.0, 1.0});
    const double next = along_u ? s.box.u.hi : s.box.v.hi;
    if (!(next > x)) break;
    x = next;
  }
  const int n = std::clamp(kPerSpan * spans, kLeast, kMost);
  std::vector<double> x(n + 1);
  for (int i = 0; i <= n; ++i) x[i] = range.lo + range.length() * i / n;
  return x;
}

struct Start {
  Uv p;
  double d2;
};

// The grid points that are no farther from the point than their neighbours, nearest first.
std::vector<Start> starts(const Surface& surface, const Xyz& point, const UvBox& box) {
  // In an infinite direction, look as far as the point is away.
  const double reach = 2.0 * (1.0 + point.norm() + surface.position(box.clamp({0.0, 0.0})).norm());
  const std::vector<double> u = samples(surface, box, true, reach), v = samples(surface, box, false, reach);
  const int nu = static_cast<int>(u.size()), nv = static_cast<int>(v.size());
  std::vector<double> d2(static_cast<size_t>(nu) * nv);
  for (int i = 0; i < nu; ++i)
    for (int k = 0; k < nv; ++k) d2[i * nv + k] = (surface.position({u[i], v[k]}) - point).squaredNorm();
  auto is_lowest = [&](int i, int k) {
    for (int a = std::max(i - 1, 0); a <= std::min(i + 1, nu - 1); ++a)
      for (int b = std::max(k - 1, 0); b <= std::min(k + 1, nv - 1); ++b)
        if (d2[a * nv + b] < d2[i * nv + k]) return false;
    return true;
  };
  std::vector<Start> lowest;
  for (int i = 0; i < nu; ++i)
    for (int k = 0; k < nv; ++k)
      if (is_lowest(i, k)) lowest.push_back({{u[i], v[k]}, d2[i * nv + k]});
  std::stable_sort(lowest.begin(), lowest.end(), [](const Start& a, const Start& b) { return a.d2 < b.d2; });
  return lowest;
}

// Moves x by whole periods into [lo, lo + period).
double wrap(double x, double lo, double period) { return x - std::floor((x - lo) / period) * period; }

}  // namespace

Projection project_near(const Surface& surface, const Xyz& point, Uv guess, const UvBox& box) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  Task task{surface, point, box};
  if (surface.u_period()) task.box.u = {-kInf, kInf};
  if (surface.v_period()) task.box.v = {-kInf, kInf};

  Uv p = task.box.clamp(guess);
  Residual s = task.at(p);
  bool at_rest = false;
  for (int round = 0; round < kPoles && !at_rest; ++round) {
    if (is_degenerate(s)) at_rest = !leave_pole(task, p, s);
    if (!at_rest) iterate(task, p, s);
    if (!is_degenerate(s)) at_rest = true;
  }
  Projection result;
  result.uv = p;
  result.foot = s.j.S;
  result.distance = s.r.norm();
  result.converged = std::isfinite(s.f) && s.tangential <= kAccept * task.rounding(s);
  return result;
}

Projection project(const Surface& surface, const Xyz& point, const UvBox& box) {
  constexpr size_t kTries = 6;
  Projection best;
  best.distance = std::numeric_limits<double>::infinity();
  const std::vector<Start> from = starts(surface, point, box);
  for (size_t i = 0; i < std::min(kTries, from.size()); ++i) {
    const Projection candidate = project_near(surface, point, from[i].p, box);
    if (candidate.distance < best.distance) best = candidate;
  }
  if (surface.u_period()) best.uv.u = wrap(best.uv.u, box.u.lo, *surface.u_period());
  if (surface.v_period()) best.uv.v = wrap(best.uv.v, box.v.lo, *surface.v_period());
  return best;
}

}  // namespace geovor
