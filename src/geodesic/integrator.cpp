#include "geodesic/integrator.h"

#include <algorithm>
#include <cmath>

#include "numeric/dop853.h"

namespace geovor {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// Below this the rounding of the jets, not the step, is the error.
constexpr double kSmallestTolerance = 4e-15;

// Step control (Hairer, Norsett and Wanner, II.4). With this factor a step in fifteen is rejected on the wave.
constexpr double kSafety = 0.85;
constexpr double kShrink = 0.2;
constexpr double kGrow = 5.0;

// Steps may be stretched by this to need one step less: less than the safety factor holds back.
constexpr double kStretch = 1.1;

// What the estimate of a step's error (a median) may be, in tolerances; the promise of trace.h allows a little more.
// Most steps stay far below, being a ninth power away from their neighbours.
constexpr double kAllowed = 4.0;

// The share of the length's error that a step may use is its share of the length to this power: signs differ, so that n
// steps do not add up to n times the error of one.
constexpr double kShare = 0.75;

// The first step, in radii of curvature, is this times tolerance^(1/9): where the error meets the tolerance on a wave.
constexpr double kFirstStep = 1.6;

// A step shorter than this part of the length makes no way any more: the metric vanishes ahead (a pole).
constexpr double kSmallestStep = 1e-13;

// A path within this part of its length from a border is on it: integrating on the wrong side of the border as deep as
// that changes nothing that double precision shows.
constexpr double kBorderSlack = 1e-14;

// How far ahead, in parts of the length, a path that runs along a border is looked at to tell on which side it goes on:
// what it may go astray meanwhile, k kLook^2 / 2, is below the slack.
constexpr double kLook = 1e-8;

// A landing on a border by one classical Runge-Kutta step: its error is (delta / h)^5 of a step h that meets the
// tolerance.
double longest_landing(double h, double tolerance) { return h * std::pow(tolerance, 0.2); }

int sign_of(double x) { return (x > 0.0) - (x < 0.0); }

}  // namespace

GeodesicIntegrator::GeodesicIntegrator(const Surface& surface, Uv start, UvVec direction, double length,
                                       const TraceOptions& options)
    : surface_(surface),
      length_(length),
      options_(options),
      piece_(surface, start, direction, options.stop_at_domain),
      x_(to_vector({start, direction, 0.0, 1.0})),
      cap_(kInf),
      reach_{{start.u, start.u}, {start.v, start.v}} {
  options_.tolerance = std::max(options.tolerance, kSmallestTolerance);
  const SurfaceJet j = refresh();
  const double speed = push_forward(j, direction).norm();  // the form would cancel where parameter lines are sheared
  x_[2] /= speed;
  x_[3] /= speed;
  slope_ = geodesic_slope(j, x_, normal_);
  if (!slope_.allFinite()) {
    status_ = TraceStatus::DegenerateMetric;
    return;
  }
  next_h_ = first_step(j);
  if (piece_.has_borders()) status_ = enter_piece();
}

SurfaceJet GeodesicIntegrator::refresh() {
  ++evaluations_;
  const SurfaceJet j = piece_.jet(surface_, {x_[0], x_[1]});
  metric_ = first_form(j);
  slope_ = geodesic_slope(j, x_, normal_);
  fresh_ = true;
  return j;
}

GeodesicVector GeodesicIntegrator::slope_at(const GeodesicVector& x) {
  ++evaluations_;
  return geodesic_slope(piece_.jet(surface_, {x[0], x[1]}), x, last_normal_);
}

// Three lengths over which the equation changes: the radius of curvature, the reach of the parameterization (the
// acceleration in the parameter plane), and the path.
double GeodesicIntegrator::first_step(const SurfaceJet& j) const {
  const double rate = std::max(curvatures(j).largest(), norm(metric_, {slope_[2], slope_[3]}));
  const double h = kFirstStep * std::pow(options_.tolerance, 1.0 / dop853::kErrorOrder) / rate;
  return h < length_ ? h : length_;
}

BorderSlack GeodesicIntegrator::slack() const {
  constexpr double kRounding = 16.0 * std::numeric_limits<double>::epsilon();
  const double per_W = kBorderSlack * length_ / std::sqrt(metric_.W2());
  return {{std::max(kRounding * std::abs(x_[0]), per_W * std::sqrt(metric_.G)),
           std::max(kRounding * std::abs(x_[1]), per_W * std::sqrt(metric_.E))},
          kLook * length_};
}

// At a border the side on which the path goes on is told by its direction and, along the border, by its curvature
// there.
TraceStatus GeodesicIntegrator::enter_piece() {
  const UvVec d{x_[2], x_[3]};
  const UvVec towards = d + kLook * length_ * UvVec{slope_[2], slope_[3]};
  if (sign_of(towards.u) != sign_of(d.u) || sign_of(towards.v) != sign_of(d.v)) {
    piece_ = Piece(surface_, {x_[0], x_[1]}, towards, options_.stop_at_domain);
    refresh();
  }
  if (options_.stop_at_domain && piece_.blocks(x_, towards, slack())) return TraceStatus::LeftDomain;
  return TraceStatus::Converged;
}

TraceStatus GeodesicIntegrator::advance(double s) {
  constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
  while (status_ == TraceStatus::Converged && s - covered_ > kRounding * s) {
    if (steps_ >= options_.max_steps) return status_ = TraceStatus::StepLimit;
    ++steps_;
    status_ = step(s - covered_);
  }
  return status_;
}

// Errors in position and y count relative to the length, those in the derivatives as the turn that carries over the
// whole length.
double GeodesicIntegrator::error_of(const GeodesicVector& e, double h) const {
  const double place = norm(metric_, {e[0], e[1]}), turn = norm(metric_, {e[2], e[3]});
  const double difference = std::max((place + std::abs(e[4])) / length_, turn + std::abs(e[5]));
  const double allowed = kAllowed * options_.tolerance * std::pow(h / length_, kShare);
  return dop853::error_estimate(difference) / allowed;
}

TraceStatus GeodesicIntegrator::step(double remaining) {
  if (!fresh_) refresh();
  const bool bordered = piece_.has_borders();
  const BorderSlack beyond = bordered ? slack() : BorderSlack{};
  const Exit ahead = bordered ? predict_exit(piece_, x_, slope_, beyond) : Exit{};
  if (ahead.s == 0.0) {
    x_[ahead.border.axis] = ahead.border.at;
    return cross(ahead.border);
  }
  // Equal steps to the end rather than full ones and a short last one.
  const double even = remaining / std::ceil(remaining / (kStretch * next_h_));
  const double h = std::min({even, ahead.s, cap_});
  cap_ = kInf;
  const auto trial = dop853::step(x_, slope_, h, [this](const GeodesicVector& x) { return slope_at(x); });
  const double error = error_of(trial.error5, h);
  // The last stage stands at the step's end. A normal that has turned about there means a pole run over unseen.
  const bool regular = last_normal_.dot(normal_) > 0.0;
  const double factor = kSafety * std::pow(error, -1.0 / dop853::kErrorOrder);
  if (!(error <= 1.0 && regular)) {
    next_h_ = h * (regular && factor > kShrink ? factor : kShrink);  // kShrink also for NaN
    return next_h_ > kSmallestStep * length_ ? TraceStatus::Converged : TraceStatus::DegenerateMetric;
  }
  worst_error_ = std::max(worst_error_, error);
  // A step cut short by a border or the end says little about how long one may be.
  next_h_ = std::max(h * std::min(factor, kGrow), h < next_h_ ? next_h_ : 0.0);

  const Exit passed = bordered ? find_exit(piece_, x_, trial.state, h, beyond) : Exit{};
  if (!(passed.s < h) && h < ahead.s) {
    accept(trial.state, h);
    return TraceStatus::Converged;
  }
  const Border border = passed.s < h ? passed.border : ahead.border;
  const GeodesicVector slope = slope_at(trial.state);
  if (land(border, trial.state, slope, h, remaining)) return cross(border);
  if (passed.s < h) {
    cap_ = passed.s;
  } else {
    accept(trial.state, h);
  }
  return TraceStatus::Converged;
}

// From a point close to the border, on either side, to the border by a classical Runge-Kutta step along the parabola's
// length and a linear correction of what that misses. False if the border is not that close, or behind the path's end.
bool GeodesicIntegrator::land(const Border& border, GeodesicVector x, const GeodesicVector& slope, double s,
                              double remaining) {
  const double delta = length_to_border(border, x, slope);
  const double limit = longest_landing(next_h_, options_.tolerance);
  if (!(std::abs(delta) <= limit)) return false;
  if (delta != 0.0) {
    const GeodesicVector k2 = slope_at(x + 0.5 * delta * slope);
    const GeodesicVector k3 = slope_at(x + 0.5 * delta * k2);
    const GeodesicVector k4 = slope_at(x + delta * k3);
    x += delta / 6.0 * (slope + 2.0 * k2 + 2.0 * k3 + k4);
  }
  const double rest = (border.at - x[border.axis]) / x[border.axis + 2];
  // Linear is enough for a thousandth of a step that itself was short; a path that turns at the border fails here.
  constexpr double kLinear = 1e-3;
  const double landed = s + delta + rest;
  if (!(std::abs(rest) <= kLinear * limit && landed > 0.0 && landed <= remaining)) return false;
  x += rest * slope;
  x[border.axis] = border.at;
  accept(x, landed);
  return true;
}

TraceStatus GeodesicIntegrator::cross(const Border& border) {
  if (options_.stop_at_domain && piece_.ends_domain(border)) return TraceStatus::LeftDomain;
  const SurfaceJet before = surface_.continuity() == 0 ? piece_.jet(surface_, {x_[0], x_[1]}) : SurfaceJet{};
  piece_ = Piece(surface_, {x_[0], x_[1]}, {x_[2], x_[3]}, options_.stop_at_domain);
  if (surface_.continuity() == 0) refract(border, before);
  refresh();
  return slope_.allFinite() ? enter_piece() : TraceStatus::DegenerateMetric;
}

// Across a crease the path goes on straight in the unfolding of the two tangent planes: its angle to the crease is
// kept. The crease carries the curvature kg_before + kg_after a unit of its length (Gauss-Bonnet on a strip about it,
// kg its geodesic curvature seen from either side), and a beam of width y covers y / sin(angle) of it.
void GeodesicIntegrator::refract(const Border& border, const SurfaceJet& before) {
  const SurfaceJet after = piece_.jet(surface_, {x_[0], x_[1]});
  ++evaluations_;
  const bool along_v = border.axis == 0;
  const auto along = [&](const SurfaceJet& j) -> const Xyz& { return along_v ? j.Sv : j.Su; };
  const auto across = [&](const SurfaceJet& j) -> const Xyz& { return along_v ? j.Su : j.Sv; };
  const auto bend = [&](const SurfaceJet& j) -> const Xyz& { return along_v ? j.Svv : j.Suu; };
  const Xyz crease = along(before).normalized();
  // The unit vectors from the crease into the face before (with -1) and after (with +1) it.
  const auto into = [&](const SurfaceJet& j, int direction) {
    const Xyz a = across(j) - crease.dot(across(j)) * crease;
    return Xyz(direction * border.side * a / a.norm());
  };
  const Xyz m_before = into(before, -1), m_after = into(after, 1);
  const Xyz w = push_forward(before, {x_[2], x_[3]});
  const double sine = -w.dot(m_before);
  const UvVec d = tangent_components(after, w.dot(crease) * crease + sine * m_after);
  x_[2] = d.u;
  x_[3] = d.v;
  const double bend_scale = along(before).squaredNorm();
  const double curvature = (bend(before).dot(m_before) + bend(after).dot(m_after)) / bend_scale;
  x_[5] -= x_[4] * curvature / sine;
}

void GeodesicIntegrator::accept(const GeodesicVector& x, double h) {
  fresh_ = false;
  for (int axis = 0; axis < 2; ++axis) {
    Interval& reach = axis == 0 ? reach_.u : reach_.v;
    const Interval step = swept(x_[axis], x[axis], x_[axis + 2], x[axis + 2], h);
    reach = {std::min(reach.lo, step.lo), std::max(reach.hi, step.hi)};
  }
  x_ = x;
  covered_ += h;
}

GeodesicState GeodesicIntegrator::state() const { return to_state(x_); }

}  // namespace geovor
