#include "geodesic/path.h"

#include <algorithm>
#include <cmath>

#include "geodesic/closed_form_path.h"
#include "geodesic/closed_forms.h"
#include "geodesic/integrator.h"
#include "geodesic/path_events.h"
#include "geodesic/pole_passage.h"
#include "surface/forms.h"

namespace geovor {

GeodesicPath::GeodesicPath(const Surface& surface, Uv start, UvVec direction, double length, const PathOptions& options)
    : surface_(&surface), start_(start) {
  check_length(length);
  if (has_closed_form(surface)) {
    follow_closed_form(direction, length);
  } else {
    GeodesicIntegrator integrator(surface, start, direction, length, options.trace);
    follow(integrator, length, options);
  }
  find_end(options);
}

GeodesicPath::GeodesicPath(const Surface& surface, Uv start, const Xyz& tangent, double length,
                           const PathOptions& options)
    : surface_(&surface), start_(start) {
  check_length(length);
  if (has_closed_form(surface)) {
    follow_closed_form(tangent_components(surface.jet(start), tangent), length);
  } else {
    GeodesicIntegrator integrator(surface, start, tangent, length, options.trace);
    follow(integrator, length, options);
  }
  find_end(options);
}

void GeodesicPath::follow_closed_form(UvVec direction, double length) {
  direction_ = direction;
  result_ = *trace_closed_form(*surface_, start_, direction, length);
  first_state_ = trace_closed_form(*surface_, start_, direction, 0.0)->end;
  const SurfaceJet j = surface_->jet(start_);
  first_ = {j.S, push_forward(j, direction).normalized(), unit_normal(j), 0.0, 1.0, start_};
  events_ = closed_form_events(*surface_, start_, direction, result_.length);
}

void GeodesicPath::follow(GeodesicIntegrator& integrator, double length, const PathOptions& options) {
  first_ = integrator.at();
  first_state_ = integrator.state();
  integrator.keep(&record_);
  bool conjugate = false;
  std::size_t seen = 0;
  while (!conjugate && integrator.advance_step(length)) {
    for (; seen < record_.legs.size(); ++seen)
      conjugate |= options.stop_at_conjugate_point && conjugate_point_on(*surface_, record_.legs[seen]) > 0.0;
  }
  result_ = {integrator.status(), integrator.state(), integrator.covered(), integrator.steps(),
             integrator.evaluations()};
  events_ = find_events(*surface_, record_, options.trace.tolerance * length);
}

// What ends the path is an event too.
void GeodesicPath::find_end(const PathOptions& options) {
  const auto conjugate = std::find_if(events_.begin(), events_.end(),
                                      [](const PathEvent& e) { return e.kind == PathEventKind::ConjugatePoint; });
  if (options.stop_at_conjugate_point && conjugate != events_.end()) {
    stop_at(conjugate->s);
  } else if (result_.status == TraceStatus::LeftDomain) {
    events_.push_back({PathEventKind::Border, result_.length, result_.end.p, 0.0});
  }
}

void GeodesicPath::stop_at(double s) {
  result_.end = state(s);
  result_.length = s;
  result_.status = TraceStatus::AtConjugatePoint;
  while (!record_.legs.empty() && record_.legs.back().s >= s) record_.legs.pop_back();
  const auto behind = [s](const PathEvent& e) { return e.s > s; };
  events_.erase(std::remove_if(events_.begin(), events_.end(), behind), events_.end());
}

const PathLeg& GeodesicPath::leg_at(double s) const {
  const auto after = std::upper_bound(record_.legs.begin(), record_.legs.end(), s,
                                      [](double value, const PathLeg& leg) { return value < leg.s; });
  return after == record_.legs.begin() ? record_.legs.front() : *(after - 1);
}

GeodesicState GeodesicPath::state(double s) const {
  const double within = std::clamp(s, 0.0, length());
  if (within == 0.0) return first_state_;
  if (record_.legs.empty()) return trace_closed_form(*surface_, start_, direction_, within)->end;
  const PathLeg& leg = leg_at(within);
  const GeodesicVector x = state_on(*surface_, leg, within);
  GeodesicState state = to_state(x);
  if (leg.chart != nullptr) {
    state.p = point_on(*surface_, leg, x);
    state.d = direction_near_pole(*surface_, *leg.chart, state.p, space_state(*surface_, leg, within).tangent);
  }
  return state;
}

SpaceState GeodesicPath::at(double s) const {
  const double within = std::clamp(s, 0.0, length());
  if (within == 0.0) return first_;
  return record_.legs.empty() ? closed_form_at(*surface_, start_, direction_, first_.tangent, within)
                              : space_state(*surface_, leg_at(within), within);
}

}  // namespace geovor
