#include "geodesic/integrator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geodesic/pole_passage.h"
#include "numeric/dop853.h"
#include "numeric/root.h"

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

// The metric fades if it changes by its size within the length, and this many times within a radius of curvature; or,
// as at a tip, where curvature grows as fast, this many times within the length.
constexpr double kSteep = 3.0;
constexpr double kDeep = 30.0;

// The metric's rate is at most the inverse of the distance from a pole that it comes from, but for curvature.
constexpr double kPole = 4.0;

// A path runs towards a line where the metric vanishes by this part of the way that the metric's fall predicts, which
// is the way itself or, in the slowed time, more of it the higher the power with which the metric vanishes.
constexpr double kPartOfWay = 0.7;

// Where the metric falls so fast that it will be gone within this part of the length the path is at its end.
constexpr double kBadLine = 1e-12;

// So it is within the first of these where only steps of the second part of the way meet the tolerance: what is left of
// the metric is the rounding of the jets. (The normal at d from a tip, of jets exact to eps, is exact to eps / d.)
constexpr double kBlurred = 1e-6;
constexpr double kPartOfBlurredWay = 0.05;

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
      charts_(surface.poles()),
      length_(length),
      options_(options),
      piece_(surface, start, direction, options.stop_at_domain),
      cap_(kInf),
      reach_{{start.u, start.u}, {start.v, start.v}} {
  options_.tolerance = std::max(options.tolerance, kSmallestTolerance);
  const PoleChart* chart = nullptr;
  if (!charts_.empty()) {
    const SurfaceJet j = surface.jet(start);
    ++evaluations_;
    chart = chart_near(start, j.S);
    if (chart != nullptr) begin_on_chart(*chart, start, push_forward(j, direction));
  }
  if (chart == nullptr) begin(start, direction);
}

GeodesicIntegrator::GeodesicIntegrator(const Surface& surface, Uv start, const Xyz& tangent, double length,
                                       const TraceOptions& options)
    : surface_(surface),
      charts_(surface.poles()),
      length_(length),
      options_(options),
      piece_(surface, start, {}, options.stop_at_domain),
      cap_(kInf),
      reach_{{start.u, start.u}, {start.v, start.v}} {
  options_.tolerance = std::max(options.tolerance, kSmallestTolerance);
  const SurfaceJet j = surface.jet(start);
  ++evaluations_;
  if (const PoleChart* chart = chart_near(start, j.S)) {
    begin_on_chart(*chart, start, tangent);
    return;
  }
  // On a line between pieces the parameters' directions belong to the piece that the path runs into.
  piece_ = Piece(surface, start, tangent_components(j, tangent), options.stop_at_domain);
  begin(start, tangent_components(piece_.jet(surface, start), tangent));
}

void GeodesicIntegrator::begin(Uv start, UvVec direction) {
  x_ = to_vector({start, direction, 0.0, 1.0});
  const SurfaceJet j = refresh();
  const double speed = length_of(direction);
  if (!(speed > 0.0) || !slope_.allFinite()) {
    status_ = TraceStatus::DegenerateMetric;
    return;
  }
  x_[2] /= speed;
  x_[3] /= speed;
  begin_steps(j);
}

void GeodesicIntegrator::begin_on_chart(const PoleChart& chart, Uv start, const Xyz& tangent) {
  chart_ = &chart;
  base_ = start;
  const Uv ab = chart.from_base(start);
  const UvVec d = tangent_components(chart.jet(ab), tangent);
  piece_ = Piece(chart, ab, d, false);
  begin(ab, d);
}

void GeodesicIntegrator::begin_steps(const SurfaceJet& j) {
  slope_ = geodesic_slope(j, x_, normal_);
  if (!slope_.allFinite()) {
    status_ = TraceStatus::DegenerateMetric;
    return;
  }
  next_h_ = first_step(j);
  if (piece_.has_borders()) status_ = enter_piece();
}

const PoleChart* GeodesicIntegrator::chart_near(Uv p, const Xyz& S) const {
  for (const auto& chart : charts_)
    if (enters_chart(*chart, p, S)) return chart.get();
  return nullptr;
}

const Surface& GeodesicIntegrator::map() const {
  return chart_ != nullptr ? static_cast<const Surface&>(*chart_) : surface_;
}

SurfaceJet GeodesicIntegrator::refresh() {
  ++evaluations_;
  SurfaceJet j = piece_.jet(map(), {x_[0], x_[1]});
  S_ = j.S;
  Su_ = j.Su;
  Sv_ = j.Sv;
  slope_ = geodesic_slope(j, x_, normal_);
  rate_ = chart_ == nullptr ? metric_rate(j, x_[2], x_[3]) : 0.0;
  fading_ = metric_fades(j);
  fresh_ = true;
  return j;
}

// A pole explains what of the metric vanishes with the distance to it; that is passed in its chart.
bool GeodesicIntegrator::metric_fades(const SurfaceJet& j) const {
  const double rate = std::abs(rate_), fall = rate * length_;
  if (!(fall > kDeep || (fall > 1.0 && rate > kSteep * curvatures(j).largest()))) return false;
  const auto explains = [&](const auto& chart) { return (S_ - chart->pole()).norm() * rate < kPole; };
  return std::none_of(charts_.begin(), charts_.end(), explains);
}

GeodesicVector GeodesicIntegrator::slope_at(const GeodesicVector& x) {
  ++evaluations_;
  return geodesic_slope(piece_.jet(map(), {x[0], x[1]}), x, last_normal_);
}

// Three lengths over which the equation changes: the radius of curvature, the reach of the parameterization (the
// acceleration in the parameter plane), and the path.
double GeodesicIntegrator::first_step(const SurfaceJet& j) const {
  const double rate = std::max(curvatures(j).largest(), length_of({slope_[2], slope_[3]}));
  const double h = kFirstStep * std::pow(options_.tolerance, 1.0 / dop853::kErrorOrder) / rate;
  return h < length_ ? h : length_;
}

BorderSlack GeodesicIntegrator::slack() const {
  constexpr double kRounding = 16.0 * std::numeric_limits<double>::epsilon();
  const double per_W = kBorderSlack * length_ / normal_.norm();
  return {{std::max(kRounding * std::abs(x_[0]), per_W * Sv_.norm()),
           std::max(kRounding * std::abs(x_[1]), per_W * Su_.norm())},
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

bool GeodesicIntegrator::advance_step(double s) {
  constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
  if (!(status_ == TraceStatus::Converged && s - covered_ > kRounding * s)) return false;
  if (steps_ >= options_.max_steps) {
    status_ = TraceStatus::StepLimit;
    return false;
  }
  ++steps_;
  status_ = step(s - covered_);
  return true;
}

TraceStatus GeodesicIntegrator::advance(double s) {
  while (advance_step(s)) {
  }
  return status_;
}

// Errors in position and y count relative to the length, those in the derivatives as the turn that carries over the
// whole length.
double GeodesicIntegrator::error_of(double place, double turn, double h) const {
  const double difference = std::max(place / length_, turn);
  return dop853::error_estimate(difference) / allowed_error(h);
}

// Rounding looks the same, but that it does not fall with the step: what has not fallen by the third power after a
// rejection is taken for it from then on.
double GeodesicIntegrator::unsettled_error_of(const dop853::Step<GeodesicVector>& step, double h) {
  constexpr double kRounding = 4.0, kLeast = 2.0 * std::numeric_limits<double>::epsilon();
  const auto size = [this](const GeodesicVector& e) {
    return std::max((length_of({e[0], e[1]}) + std::abs(e[4])) / length_, length_of({e[2], e[3]}) + std::abs(e[5]));
  };
  const double difference = size(step.error5);
  if (!(difference > std::max(kLeast, kRounding * rounding_ * h))) return 0.0;
  const double error = dop853::unsettled_error(difference, size(step.error3)) / allowed_error(h);
  const double per_cube = error > 1.0 ? difference / (h * h * h) : 0.0, before = std::exchange(unsettled_, per_cube);
  if (!(error > 1.0 && before > 0.0 && per_cube >= before)) return error;
  rounding_ = difference / h;
  return 0.0;
}

double GeodesicIntegrator::allowed_error(double h) const {
  return kAllowed * options_.tolerance * std::pow(h / length_, kShare);
}

// Near a pole the path goes on in its chart: there the surface's own parameters turn ever faster.
void GeodesicIntegrator::change_map() {
  const Uv here = base_point();
  const Xyz T = Su_ * x_[2] + Sv_ * x_[3];
  if (chart_ == nullptr) {
    const PoleChart* chart = chart_near(here, S_);
    if (chart == nullptr) return;
    chart_ = chart;
    base_ = here;
    const Uv ab = chart->from_base(here);
    x_.head<2>() << ab.u, ab.v;
  } else {
    if (!leaves_chart(*chart_, x_)) return;
    chart_ = nullptr;
    x_.head<2>() << here.u, here.v;
  }
  const Uv p{x_[0], x_[1]};
  const UvVec d = tangent_components(map().jet(p), T);
  ++evaluations_;
  x_[2] = d.u;
  x_[3] = d.v;
  piece_ = Piece(map(), p, d, chart_ == nullptr && options_.stop_at_domain);
  refresh();
}

double GeodesicIntegrator::room() const {
  if (chart_ != nullptr) return room_on_chart(*chart_, x_);
  double room = kInf;
  for (const auto& chart : charts_) room = std::min(room, room_before_pole(*chart, S_, Su_ * x_[2] + Sv_ * x_[3]));
  return room;
}

// A step that failed: the next one shorter. False if that makes no way any more.
bool GeodesicIntegrator::reject(double h, double factor, bool regular) {
  next_h_ = h * (regular && factor > kShrink ? factor : kShrink);  // kShrink also for NaN
  return next_h_ > kSmallestStep * length_;
}

TraceStatus GeodesicIntegrator::step(double remaining) {
  if (!fresh_) refresh();
  if (!charts_.empty()) change_map();
  const bool bordered = piece_.has_borders();
  const BorderSlack beyond = bordered ? slack() : BorderSlack{};
  const Exit ahead = bordered ? predict_exit(piece_, x_, slope_, beyond) : Exit{};
  if (ahead.s == 0.0) {
    x_[ahead.border.axis] = ahead.border.at;
    return cross(ahead.border);
  }
  if (fading_)
    if (const auto done = slowed_step(remaining, beyond)) return *done;
  // Equal steps to the end rather than full ones and a short last one.
  const double even = remaining / std::ceil(remaining / (kStretch * next_h_));
  const double h = std::min({even, ahead.s, cap_, room()});
  cap_ = kInf;
  const auto trial = dop853::step(x_, slope_, h, [this](const GeodesicVector& x) { return slope_at(x); });
  const GeodesicVector& e = trial.error5;
  const double settled =
      error_of(length_of({e[0], e[1]}) + std::abs(e[4]), length_of({e[2], e[3]}) + std::abs(e[5]), h);
  const double error = std::max(settled, unsettled_error_of(trial, h));
  // The last stage stands at the step's end. A normal that has turned about there means a singular line run over
  // unseen.
  const bool regular = last_normal_.dot(normal_) > 0.0;
  const double factor = kSafety * std::pow(error, -1.0 / dop853::kErrorOrder);
  if (!(error <= 1.0 && regular))
    return reject(h, factor, regular) ? TraceStatus::Converged : TraceStatus::DegenerateMetric;
  worst_error_ = std::max(worst_error_, error);
  // A step cut short by a border or the end says little about how long one may be.
  next_h_ = std::max(h * std::min(factor, kGrow), h < next_h_ ? next_h_ : 0.0);

  next_t_ = 0.0;

  if (leaves_wedge(trial.state)) return stop_at_wedge(h);
  const Exit passed = bordered ? exit_of(trial.state, h, beyond) : Exit{};
  if (!(passed.s < h) && h < ahead.s) {
    accept(trial.state, h);
    return TraceStatus::Converged;
  }
  const Border border = passed.s < h ? passed.border : ahead.border;
  const GeodesicVector slope = slope_at(trial.state);
  if (land(border, trial.state, slope, h, remaining)) return cross(border);
  if (passed.s < h) {
    // Of a path that leaves a border along it, by the third power or slower, the cubic of a long step claims a way back
    // at once; its error falls with the step. So no step is cut at once to what the claim of a long one says.
    cap_ = std::max(passed.s, kShrink * h);
  } else {
    accept(trial.state, h);
  }
  return TraceStatus::Converged;
}

// None where a border is near: those are met by steps in the arc length.
std::optional<TraceStatus> GeodesicIntegrator::slowed_step(double remaining, const BorderSlack& beyond) {
  const double W = normal_.norm(), fall = std::max(-rate_, 0.0);
  if (fall * kBadLine * length_ >= 1.0) return TraceStatus::DegenerateMetric;
  SlowedStep step(surface_, piece_, x_, slope_, normal_, rate_);
  double t = next_t_ > 0.0 ? next_t_ : next_h_ / W;
  if (fall > 0.0) t = std::min(t, kPartOfWay / (fall * W));
  bool good = step.run(t);
  if (good && step.arc_length() > remaining) good = step.run_to(remaining, t * remaining / step.arc_length());
  evaluations_ += step.evaluations();
  if (good && piece_.has_borders() && step.meets_border(beyond)) return std::nullopt;
  const double h = good ? step.arc_length() : W * t;
  const SlowedVector& e = step.error5();
  const double place = length_of({e[0], e[1]}) + std::abs(e[7]) + std::abs(e[5]);
  const double error = error_of(place, e.segment<3>(2).norm() + std::abs(e[6]), h);
  const double factor = kSafety * std::pow(error, -1.0 / dop853::kErrorOrder);
  if (!(good && error <= 1.0)) {
    next_t_ = t * (good && factor > kShrink ? factor : kShrink);
    const bool blurred = fall * kBlurred * length_ > 1.0 && fall * W * next_t_ < kPartOfBlurredWay;
    const bool makes_way = W * next_t_ > kSmallestStep * length_ && !blurred;
    return makes_way ? TraceStatus::Converged : TraceStatus::DegenerateMetric;
  }
  worst_error_ = std::max(worst_error_, error);
  next_t_ = step.time() * std::min(factor, kGrow);
  accept(step.end(), std::min(h, remaining), &step);
  return TraceStatus::Converged;
}

Exit GeodesicIntegrator::exit_of(const GeodesicVector& end, double h, const BorderSlack& beyond) {
  Exit first = find_exit(piece_, x_, end, h, beyond);
  for (const Exit& turn : doubtful_turns(piece_, x_, slope_, end, h, beyond)) {
    const Exit dip = dip_at(turn, beyond);
    if (dip.s < first.s) first = dip;
  }
  return first;
}

// The turn itself, by Newton's method on the step run again as far as there: its depth is then as exact as the step.
// The line is crossed where the parabola about the turn meets it.
Exit GeodesicIntegrator::dip_at(Exit turn, const BorderSlack& beyond) {
  constexpr int kCorrections = 3;  // from a cubic's extremum, a few digits, to all
  const auto [axis, side, at] = turn.border;
  double s = turn.s, depth = 0.0, bend = 0.0;
  for (int i = 0; i < kCorrections; ++i) {
    const GeodesicVector x = dop853::step(x_, slope_, s, [this](const GeodesicVector& z) { return slope_at(z); }).state;
    const double w = x[axis + 2];
    bend = slope_at(x)[axis + 2];
    depth = side * (x[axis] - at) - side * 0.5 * w * w / bend;
    s -= w / bend;
    if (!(side * bend < 0.0 && s > 0.0)) return {};
    // A turn that stays clear of the line needs no more digits.
    if (depth < 0.0 && std::abs(w * w / bend) < -depth) return {};
  }
  if (!(depth > beyond.along[axis])) return {};
  const double back = std::sqrt(2.0 * depth / std::abs(bend));
  return back < s ? Exit{s - back, turn.border} : Exit{};
}

bool GeodesicIntegrator::leaves_wedge(const GeodesicVector& x) const {
  return chart_ != nullptr && options_.stop_at_domain && beyond_wedge(surface_, *chart_, {x[0], x[1]}) > 0.0;
}

// The border of the wedge is a line on the chart that only to_base knows.
TraceStatus GeodesicIntegrator::stop_at_wedge(double h) {
  const auto end = [this](double s) {
    return s == 0.0 ? x_ : dop853::step(x_, slope_, s, [this](const GeodesicVector& x) { return slope_at(x); }).state;
  };
  const auto beyond = [&](double s) {
    const GeodesicVector x = end(s);
    return beyond_wedge(surface_, *chart_, {x[0], x[1]});
  };
  const double s = root_between(beyond, 0.0, h, kBorderSlack * length_);
  if (s > 0.0) accept(end(s), s);
  return TraceStatus::LeftDomain;
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
  // Where it runs inwards it comes back from a dip that has been stepped over.
  if (!(border.side * x[border.axis + 2] > 0.0)) return false;
  x += rest * slope;
  x[border.axis] = border.at;
  accept(x, landed);
  return true;
}

TraceStatus GeodesicIntegrator::cross(const Border& border) {
  if (options_.stop_at_domain && piece_.ends_domain(border)) return TraceStatus::LeftDomain;
  const SurfaceJet before = surface_.continuity() == 0 ? piece_.jet(surface_, {x_[0], x_[1]}) : SurfaceJet{};
  piece_ = Piece(surface_, {x_[0], x_[1]}, {x_[2], x_[3]}, options_.stop_at_domain);
  double bend = 0.0;
  if (surface_.continuity() == 0 && !refract(border, before, bend)) return TraceStatus::DegenerateMetric;
  if (record_ != nullptr) record_->crossings.push_back({covered_, {x_[0], x_[1]}, border, bend});
  refresh();
  return slope_.allFinite() ? enter_piece() : TraceStatus::DegenerateMetric;
}

// Across a crease the path goes on straight in the unfolding of the two tangent planes: its angle to the crease is
// kept. The crease carries the curvature kg_before + kg_after a unit of its length (Gauss-Bonnet on a strip about it,
// kg its geodesic curvature seen from either side), and a beam of width y covers y / sin(angle) of it. False where the
// angle is too small for that to be known.
bool GeodesicIntegrator::refract(const Border& border, const SurfaceJet& before, double& bend_angle) {
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
  // Such a path stays on the crease, to rounding, for as long as its direction there is looked ahead (kLook).
  constexpr double kParallel = kLook;
  if (sine > kParallel) {
    x_[5] -= x_[4] * curvature / sine;
  } else if (x_[4] != 0.0 && !(std::abs(curvature) * length_ <= kParallel)) {
    return false;
  }
  bend_angle =
      std::atan2(unit_normal(before).cross(unit_normal(after)).norm(), unit_normal(before).dot(unit_normal(after)));
  return true;
}

void GeodesicIntegrator::widen(Interval u, Interval v) {
  reach_ = {{std::min(reach_.u.lo, u.lo), std::max(reach_.u.hi, u.hi)},
            {std::min(reach_.v.lo, v.lo), std::max(reach_.v.hi, v.hi)}};
}

void GeodesicIntegrator::accept(const GeodesicVector& x, double h, const SlowedStep* slowed) {
  fresh_ = false;
  if (record_ != nullptr)
    record_->legs.push_back(
        {covered_, h, x_, slope_, x, piece_, chart_, base_point(), slowed != nullptr ? slowed->time() : 0.0});
  if (chart_ != nullptr) {
    base_ = unwound(surface_, *chart_, x_, base_, x);
    widen({base_.u, base_.u}, {base_.v, base_.v});
  } else if (slowed != nullptr) {
    widen(slowed->swept_by(0), slowed->swept_by(1));
  } else {
    widen(swept(x_[0], x[0], x_[2], x[2], h), swept(x_[1], x[1], x_[3], x[3], h));
  }
  x_ = x;
  covered_ += h;
}

GeodesicState GeodesicIntegrator::state() const {
  if (chart_ == nullptr) return to_state(x_);
  const SpaceState here = at();
  return {base_, direction_near_pole(surface_, *chart_, base_, here.tangent), here.y, here.dy};
}

SpaceState GeodesicIntegrator::at() const {
  const SurfaceJet j = piece_.jet(map(), {x_[0], x_[1]});
  return {j.S, push_forward(j, {x_[2], x_[3]}).normalized(), unit_normal(j), x_[4], x_[5], base_point()};
}

SurfaceJet GeodesicIntegrator::jet() const {
  return chart_ == nullptr ? piece_.jet(surface_, {x_[0], x_[1]}) : surface_.jet(base_);
}

}  // namespace geovor
