#include "voronoi/ray_end.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <vector>

#include "geodesic/closed_form_path.h"
#include "geodesic/closed_forms.h"
#include "geodesic/extended_state.h"
#include "geodesic/integrator.h"
#include "geodesic/path_leg.h"
#include "surface/forms.h"
#include "surface/tangent_frame.h"

namespace geovor {
namespace {

// The integral of y over two pieces is taken with y at three places and y' at the ends (error s^7 y^(6) / 604800); with
// y' in the middle as well the rule of lower order (s^5 y^(4) / 11520) costs nothing. If the two agree to this the
// better one is good to about 1e-9.
constexpr double kOrdersAgree = 1e-6;
constexpr int kMostPieces = 64;

/// The states at the ends of equal pieces of the ray, the start left out; fewer where the geodesic ends early.
std::vector<SpaceState> states_along(const Surface& surface, Uv site, Polar to, const CurvatureMap& curvature,
                                     int pieces) {
  const Xyz T = tangent_frame(surface, site).at_angle(to.t);
  std::vector<SpaceState> states;
  if (has_closed_form(surface)) {
    const UvVec direction = tangent_components(surface.jet(site), T);
    for (int i = 1; i <= pieces; ++i) states.push_back(closed_form_at(surface, site, direction, T, to.s * i / pieces));
    return states;
  }
  TraceOptions options;
  options.stop_at_domain = false;
  options.tolerance = kRetraceTolerance;
  GeodesicIntegrator path(surface, site, T, to.s, options);
  double leg = 0.0;
  for (int i = 1; i <= pieces; ++i) {
    for (const double end = to.s * i / pieces; leg < end;) {
      leg = curvature.leg_end(path.state().p, leg, end, kRetraceTolerance);
      if (path.advance(leg) != TraceStatus::Converged) return states;
    }
    states.push_back(path.at());
  }
  return states;
}

/// The integral of y by both rules.
struct SectorRules {
  double high = 0.0, low = 0.0;
};
SectorRules integrate_y(const std::vector<SpaceState>& states, double s) {
  const double h = s / static_cast<double>(states.size());
  SectorRules sum;
  double y = 0.0, dy = 1.0;
  for (std::size_t i = 0; i + 1 < states.size(); i += 2) {
    const SpaceState &m = states[i], &b = states[i + 1];
    sum.high += h / 15.0 * (7.0 * y + 16.0 * m.y + 7.0 * b.y) + h * h / 15.0 * (dy - b.dy);
    sum.low += h / 2.0 * (y + 2.0 * m.y + b.y) + h * h / 12.0 * (dy - b.dy);
    y = b.y, dy = b.dy;
  }
  return sum;
}

RayEnd end_of(const SpaceState& at, Polar to) {
  return {at.S.allFinite() && at.tangent.allFinite() && std::isfinite(at.y),
          to,
          at.S,
          at.tangent,
          at.normal.cross(at.tangent),
          at.y,
          at.dy,
          std::numeric_limits<double>::quiet_NaN()};
}

/// The integral of y over a step: of the quintic with y, y' and y'' = -K y at both ends (error h^7 y^(6) / 100800), all
/// of the step's own piece: across knots K may jump, across creases y' too.
double integral_of_y(const Surface& surface, const PathLeg& leg) {
  const Surface& map = leg.chart != nullptr ? *leg.chart : surface;
  const double K = curvatures(leg.piece.jet(map, {leg.end[0], leg.end[1]})).gauss, h = leg.h;
  return h / 2.0 * (leg.x[4] + leg.end[4]) + h * h / 10.0 * (leg.x[5] - leg.end[5]) +
         h * h * h / 120.0 * (leg.slope[5] - K * leg.end[4]);
}

/// The ray with its sector from the integrator's own steps, which are as short as the curvature asks. The sector is NaN
/// where K is (at poles).
RayEnd trace_by_steps(const Surface& surface, Uv site, Polar to, const CurvatureMap& curvature) {
  TraceOptions options;
  options.stop_at_domain = false;
  options.tolerance = kRetraceTolerance;
  GeodesicIntegrator path(surface, site, tangent_frame(surface, site).at_angle(to.t), to.s, options);
  PathRecord steps;
  path.keep(&steps);
  double sum = 0.0;
  for (double leg = 0.0; leg < to.s && path.status() == TraceStatus::Converged;) {
    leg = curvature.leg_end(path.state().p, leg, to.s, kRetraceTolerance);
    while (path.advance_step(leg)) {
      for (const PathLeg& step : steps.legs) sum += integral_of_y(surface, step);
      steps.legs.clear();
    }
  }
  if (path.status() != TraceStatus::Converged) return {};
  RayEnd ray = end_of(path.at(), to);
  ray.sector = sum;
  return ray;
}

RayEnd traced(const Surface& surface, Uv site, Polar to, const CurvatureMap& curvature, RayParts parts) {
  RayEnd ray;
  ray.polar = to;
  if (!(to.s > 0.0) || !std::isfinite(to.s) || !std::isfinite(to.t)) return ray;
  if (parts == RayParts::EndAlone) {
    const auto states = states_along(surface, site, to, curvature, 1);
    return states.empty() ? ray : end_of(states.back(), to);
  }
  if (!has_closed_form(surface)) {
    const RayEnd by_steps = trace_by_steps(surface, site, to, curvature);
    if (!by_steps.found || std::isfinite(by_steps.sector)) return by_steps;
  }
  double last = std::numeric_limits<double>::quiet_NaN();
  for (int pieces = 2; pieces <= kMostPieces;) {
    const auto states = states_along(surface, site, to, curvature, pieces);
    if (static_cast<int>(states.size()) < pieces) return {};
    const SectorRules sum = integrate_y(states, to.s);
    ray = end_of(states.back(), to);
    ray.sector = sum.high;
    const double excess = std::abs(sum.high - sum.low) / (kOrdersAgree * std::abs(sum.high));
    if (excess <= 1.0 || std::abs(sum.high - last) <= 0.01 * kOrdersAgree * std::abs(sum.high)) break;
    last = sum.high;
    pieces *= excess > 16.0 ? 4 : 2;  // the difference goes like the fourth power of the pieces
  }
  return ray;
}

/// From two ends one h apart to what lies as far again ahead, to second order.
RayEnd extrapolated(const RayEnd& a, const RayEnd& b, double h, Polar to) {
  RayEnd on = b;
  on.polar = to;
  on.x += h * b.T + 0.5 * h * (b.T - a.T);
  on.T = (2.0 * b.T - a.T).normalized();
  on.N = 2.0 * b.N - a.N;
  on.N = (on.N - on.N.dot(on.T) * on.T).normalized();
  on.y += h * b.dy + 0.5 * h * (b.dy - a.dy);
  on.dy += b.dy - a.dy;
  on.sector += h * b.y + 0.5 * h * h * b.dy;
  return on;
}

}  // namespace

// Onto a side where the parameters have no tangent plane the integrator comes near only.
RayEnd trace_ray(const Surface& surface, Uv site, Polar to, const CurvatureMap& curvature, RayParts parts) {
  const RayEnd ray = traced(surface, site, to, curvature, parts);
  if (ray.found || !(to.s > 0.0)) return ray;
  const double h = kBeforeSide * to.s;
  const RayEnd b = traced(surface, site, {to.s - h, to.t}, curvature, parts);
  if (!b.found) return ray;
  const RayEnd a = traced(surface, site, {to.s - 2.0 * h, to.t}, curvature, RayParts::EndAlone);
  return a.found ? extrapolated(a, b, h, to) : ray;
}

}  // namespace geovor
