#include "geodesic/shooting.h"

#include <algorithm>
#include <cmath>

#include "geodesic/integrator.h"

namespace geovor {
namespace {

// Newton's steps: no farther round than this, no shorter than a part of the length and no longer than a multiple.
constexpr double kLargestTurn = 0.5;
constexpr double kShortest = 0.25;
constexpr double kLongest = 2.0;

// While the shot is still off, the integrator's error only has to stay below what Newton's step will leave.
constexpr double kLoosest = 1e-5;
constexpr double kNewton = 0.1;  // the miss after a step, in parts of the miss before, squared
constexpr double kBelowResidual = 0.3;
constexpr double kTrueError = 2.0;  // of a loose shot, in parts of the tolerance that it met

// Residuals differ by this many tolerances without telling anything.
constexpr double kNoise = 2.0;

// Share of the tolerance that the integrator may use; the rest is for the last correction.
constexpr double kIntegratorShare = 0.5;

struct Shot {
  Polar aim;
  GeodesicState state;
  TraceStatus status;
  Xyz tangent, across;      // unit vectors at the end, across = n x tangent
  double a = 0.0, b = 0.0;  // what is missing to the target, along the two
  double residual = 0.0;
  double asked = 0.0;      // the integrator's tolerance
  double tolerance = 0.0;  // the one that it met, which may be far finer
  UvBox reach;
  double missing() const { return residual / aim.s; }
  double error() const { return kTrueError * tolerance; }
};

Shot fire(const Surface& surface, const Ends& ends, Polar aim, double tolerance, int max_steps, int& evaluations) {
  TraceOptions options;
  options.tolerance = tolerance;
  options.max_steps = max_steps;
  options.stop_at_domain = false;
  GeodesicIntegrator path(surface, ends.from, ends.start.at_angle(aim.t), aim.s, options);
  Shot shot;
  shot.aim = aim;
  shot.status = path.advance(aim.s);
  shot.state = path.state();
  shot.reach = path.reach();
  shot.asked = tolerance;
  shot.tolerance = std::min(path.tolerance_met(), tolerance);
  const SpaceState end = path.at();
  evaluations += path.evaluations() + 1;
  shot.tangent = end.tangent;
  shot.across = end.normal.cross(end.tangent);
  const Xyz missing = ends.at_to.S - end.S;
  shot.a = missing.dot(shot.tangent);
  shot.b = missing.dot(shot.across);
  shot.residual = missing.norm();
  return shot;
}

// The step to the target, to second order in the missing piece: about the end the geodesic circle has the curvature
// y'/y, and the circles through the target have y + a y'.
Polar newton_step(const Shot& shot) {
  const double y = shot.state.y, dy = shot.state.dy;
  const double y_there = y + shot.a * dy;
  return {shot.a + 0.5 * shot.b * shot.b * dy / y, shot.b / (y_there * y > 0.0 ? y_there : y)};
}

Polar limited(Polar step, double s) {
  const double k = std::min({1.0, kLargestTurn / std::abs(step.t),
                             step.s < 0.0 ? (1.0 - kShortest) * s / -step.s : (kLongest - 1.0) * s / step.s});
  return {k * step.s, k * step.t};
}

// What the last step may leave undone, so that it needs no shot of its own. All relative to the length.
struct Demand {
  double least;   // no shot is asked to land nearer
  double place;   // residual from which the step, of second order, leaves a part of the tolerance
  double y;       // error allowed in y
  double y_turn;  // how much y changes with the angle, as a rule: by the third power of the length in curvature radii
  double turn_per_miss;
  double finest;  // the integrator's tolerance of the last shot

  Demand(const Shot& shot, const Ends& ends, double tolerance) : finest(kIntegratorShare * tolerance) {
    constexpr double kOfTolerance = 0.1, kErrorsOfY = 1.0;
    const double s = shot.aim.s, bend = ends.curvature * s;
    const double scale = std::min(s, std::abs(shot.state.y) / std::max(1.0, std::abs(shot.state.dy)));
    place = std::sqrt(kOfTolerance * tolerance * scale / s);
    least = kNoise * tolerance;
    y = kErrorsOfY * tolerance;
    y_turn = bend * bend * bend;
    turn_per_miss = std::max(1.0, s / std::abs(shot.state.y));
  }
  // `slope_error`: of the slope by which y is corrected, see YSlope. A miss turns the path by so much more as y is less
  // than the length.
  double miss_allowed(double slope_error) const {
    return std::max(least, std::min(place, y / (slope_error * turn_per_miss)));
  }
};

// dy/dt, from the two shots that tell it best, in parts of the length. Until then it is zero, to the size that Demand
// takes it for; it may be larger, as where the curvature jumps.
struct YSlope {
  double value = 0.0, error = std::numeric_limits<double>::infinity();
  bool learned = false;

  static double noise(double errors, double stretch, double turn) {
    return (errors + stretch * stretch) / std::abs(turn);
  }
  void learn(const Shot& before, const Shot& shot) {
    const double s = shot.aim.s, ds = s - before.aim.s, turn = shot.aim.t - before.aim.t;
    const double slope = (shot.state.y - before.state.y - 0.5 * (before.state.dy + shot.state.dy) * ds) / (turn * s);
    const double noise_here = noise(before.error() + shot.error(), ds / s, turn);
    const double error_here = noise_here + std::max(expected_, std::abs(slope)) * std::abs(turn);
    if (!(error_here < error || (!learned && error_here < std::abs(slope)))) return;
    learned = true;
    error = error_here;
    // On a sphere, say, there is none, and noise must not be taken for one.
    value = std::abs(slope) < kNoise * noise_here ? 0.0 : slope;
  }
  void expect(double y_turn) {
    expected_ = y_turn;
    if (!learned) error = y_turn;
  }
  // After a step to a shot whose error is that of the last one.
  double error_after(const Shot& shot, Polar step) const {
    const double size = std::max(expected_, std::abs(value));
    return std::min(error, noise(shot.error(), step.s / shot.aim.s, step.t) + size * std::abs(step.t));
  }

 private:
  double expected_ = 0.0;
};

// Of the next shot: the finest as soon as that will be the last one. Before, as loose as the miss of the next shot
// allows, and such that the one after it can be the last.
double next_tolerance(const Shot& shot, Polar step, const Demand& demand, const YSlope& y_slope) {
  const double loosest = std::max(kLoosest, demand.finest);
  if (shot.tolerance <= demand.finest) return shot.asked;  // which will meet the finest once more
  const double rest = kNewton * shot.missing() * shot.missing();
  const double allowed = demand.miss_allowed(y_slope.error_after(shot, step));
  if (rest + shot.error() <= allowed) return demand.finest;
  constexpr double kMargin = 0.5;
  const double wanted = rest > allowed ? kBelowResidual * rest : kMargin * allowed / kTrueError;
  return std::clamp(wanted, demand.finest, loosest);
}

bool leaves(const Surface& surface, const UvBox& reach, const Ends& ends, double length) {
  // Paths along a border stray over it by rounding.
  constexpr double kStray = 1e-9;
  const UvBox domain = surface.domain();
  const double W = std::sqrt(first_form(ends.at_from).W2());
  const double du = kStray * length * ends.at_from.Sv.norm() / W, dv = kStray * length * ends.at_from.Su.norm() / W;
  const bool out_u = !surface.u_period() && (reach.u.lo < domain.u.lo - du || reach.u.hi > domain.u.hi + du);
  const bool out_v = !surface.v_period() && (reach.v.lo < domain.v.lo - dv || reach.v.hi > domain.v.hi + dv);
  return out_u || out_v;
}

// The direction in the parameter plane; zero at a pole, where there is none.
UvVec direction_of(const SurfaceJet& j, const Xyz& tangent) {
  const UvVec d = tangent_components(j, tangent);
  const double speed = push_forward(j, d).norm();
  return is_finite(d) && speed > 0.0 ? (1.0 / speed) * d : UvVec{};
}

// The connection that ends at the target: the shot, moved by the step that it lacks. Where all geodesics meet (y = 0)
// the step's turn is noise.
Connection corrected(const Surface& surface, const Ends& ends, const Shot& shot, double y_slope) {
  constexpr double kNoTurn = 1e-3;
  const Polar aim = shot.aim;
  Polar step = newton_step(shot);
  if (!(std::abs(step.t) < kNoTurn)) step.t = 0.0;
  if (!(std::abs(step.s - shot.a) <= std::abs(shot.b))) step.s = shot.a;
  Connection c;
  c.status = ConnectStatus::Converged;
  c.length = aim.s + step.s;
  c.angle = std::remainder(aim.t + step.t, 2.0 * M_PI);
  c.start_direction = direction_of(ends.at_from, ends.start.at_angle(c.angle));
  c.end_direction = direction_of(ends.at_to, shot.tangent + step.t * shot.state.dy * shot.across);
  c.y = shot.state.y + shot.a * shot.state.dy + y_slope * aim.s * step.t;
  c.residual = shot.residual * shot.residual / c.length;
  c.leaves_domain = leaves(surface, shot.reach, ends, c.length);
  return c;
}

// tangent_frame, without its second jet where the first will do.
TangentFrame frame_at(const Surface& surface, Uv p, const SurfaceJet& j) {
  constexpr double kSheared = 1e-3;
  const Xyz n = j.Su.cross(j.Sv);
  const double su = j.Su.norm(), sv = j.Sv.norm(), W = n.norm();
  if (!(W > kSheared * std::max(su, sv) * std::max(su, sv))) return tangent_frame(surface, p);
  TangentFrame f{j.S, j.Su / su, {}, n / W};
  f.e2 = f.n.cross(f.e1);
  return f;
}

}  // namespace

Ends::Ends(const Surface& surface, Uv from_point, Uv to_point)
    : from(from_point),
      to(to_point),
      at_from(surface.jet(from_point)),
      at_to(surface.jet(to_point)),
      start(frame_at(surface, from_point, at_from)),
      finish(frame_at(surface, to_point, at_to)),
      curvature(0.0) {
  for (const SurfaceJet* j : {&at_from, &at_to}) {
    const double k = curvatures(*j).largest();
    if (std::isfinite(k)) curvature = std::max(curvature, k);
  }
}

Connection shoot(const Surface& surface, const Ends& ends, Polar guess, const ConnectOptions& options) {
  Connection last;
  Polar aim = guess, step;
  double tolerance = std::max(kLoosest, kIntegratorShare * options.tolerance);
  double best = std::numeric_limits<double>::infinity();
  std::optional<Shot> before;
  YSlope y_slope;
  int evaluations = 0;
  for (int i = 1; i <= options.max_iterations; ++i) {
    const Shot shot = fire(surface, ends, aim, tolerance, options.max_steps, evaluations);
    last.length = aim.s;
    last.angle = aim.t;
    last.residual = shot.residual;
    last.iterations = i;
    if (shot.status == TraceStatus::DegenerateMetric) {
      last.status = ConnectStatus::DegenerateMetric;
      last.degenerate_at = shot.state.p;
    }
    const Demand demand(shot, ends, options.tolerance);
    y_slope.expect(demand.y_turn);
    if (before) y_slope.learn(*before, shot);
    if (shot.tolerance <= demand.finest && shot.missing() <= demand.miss_allowed(y_slope.error)) {
      last = corrected(surface, ends, shot, y_slope.value);
      last.iterations = i;
      break;
    }
    // A residual is known to the integrator's tolerance only: below that it need not fall.
    if (shot.status == TraceStatus::Converged && shot.residual < best) {
      best = std::max(shot.residual, kNoise * shot.error() * aim.s);
      step = limited(newton_step(shot), aim.s);
      tolerance = next_tolerance(shot, step, demand, y_slope);
      before = shot;
    } else {
      aim = {aim.s - step.s, aim.t - step.t};
      step = {0.5 * step.s, 0.5 * step.t};
      // Halving a step that does not matter any more leads nowhere; NaN leaves too.
      constexpr double kSmallestStep = 1e-3;
      if (!(std::hypot(step.s / aim.s, step.t) > kSmallestStep * std::min(1.0, best / aim.s))) break;
    }
    aim = {aim.s + step.s, aim.t + step.t};
  }
  last.evaluations = evaluations;
  return last;
}

// With T the tangent, B = n x T and II the second form, x'' = II(T,T) n and x''' . B = -II(T,T) II(T,B), so the chord c
// of a path of length s has c . B = s^3 x'''/6 (taken at s/4, the centre of the integral's weight) and |c| = s - s^3
// k^2/24.
std::optional<ChordGuess> guess_from_chord(const Ends& ends) {
  constexpr double kGuided = 0.7;      // curvature radii
  constexpr double kComparable = 4.0;  // of the parameter line's length to the chord's
  const Xyz chord = ends.at_to.S - ends.at_from.S;
  const double c = chord.norm();
  const UvVec way = ends.to - ends.from;
  const double line = 0.5 * (push_forward(ends.at_from, way).norm() + push_forward(ends.at_to, way).norm());
  if (!(c > 0.0 && c * ends.curvature < kGuided && line < kComparable * c)) return std::nullopt;
  struct Bend {
    Xyz T, B;
    double along, twist;
  };
  const auto bend_of = [&chord](const SurfaceJet& j) -> Bend {
    const Xyz n = unit_normal(j), T = (chord - chord.dot(n) * n).normalized(), B = n.cross(T);
    const UvVec t = tangent_components(j, T), b = tangent_components(j, B);
    const auto [L, M, N] = second_form(j);
    const double along = L * t.u * t.u + 2.0 * M * t.u * t.v + N * t.v * t.v;
    return {T, B, along, along * (L * t.u * b.u + M * (t.u * b.v + t.v * b.u) + N * t.v * b.v)};
  };
  const Bend first = bend_of(ends.at_from), last = bend_of(ends.at_to);
  const double along = 0.5 * (first.along + last.along), length = c * (1.0 + along * along * c * c / 24.0);
  const auto turned = [&](const Bend& near, const Bend& far) -> Xyz {
    const double turn = (0.75 * near.twist + 0.25 * far.twist) * c * c / 6.0;
    return length * (near.T + turn * near.B).normalized();
  };
  const ChordGuess guess{turned(first, last), turned(last, first)};
  if (!(guess.first.allFinite() && guess.last.allFinite())) return std::nullopt;
  return guess;
}

Polar polar_of(const Ends& ends, const ChordGuess& guess) {
  return {guess.first.norm(), ends.start.angle_of(guess.first)};
}

Polar guess_across(const Ends& ends) { return {ends.chord(), ends.start.angle_of(ends.at_to.S - ends.at_from.S)}; }

Polar guess_from_parameters(const Surface& surface, const Ends& ends) {
  const UvVec way = ends.to - ends.from;
  const double middle = push_forward(surface.jet(lerp(ends.from, ends.to, 0.5)), way).norm();
  const double first = push_forward(ends.at_from, way).norm(), last = push_forward(ends.at_to, way).norm();
  return {(first + 4.0 * middle + last) / 6.0, ends.start.angle_of(push_forward(ends.at_from, way))};
}

}  // namespace geovor
