#include "voronoi/site_ray.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geodesic/closed_forms.h"
#include "geodesic/extended_state.h"
#include "geodesic/integrator.h"
#include "surface/forms.h"
#include "voronoi/shot_ladder.h"

namespace geovor {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

// Two geodesics of one site that meet again in a point leave the site under angles that differ by far more than what
// connect() leaves open in one of them (some 1e-12 of the length, divided by y).
constexpr double kSameAngle = 1e-6;

// A Jacobi field this small, relative to the length, is a conjugate point: the angle can't be told from the end point.
constexpr double kConjugate = 1e-9;

bool usable(const SiteRay& ray) {
  return ray.x.allFinite() && ray.N.allFinite() && std::abs(ray.y) > kConjugate * ray.polar.s;
}

// Shots at one target; a guess from a neighbour needs two or three.
constexpr int kMostShots = 12;

// The longest step of the aim: radians, and a part of the length.
constexpr double kMostTurn = 0.5;
constexpr double kMostStretch = 0.5;

// A ray that is aimed beyond a side where the parameters lose the tangent plane is extended by no more than this part
// of its length, which an iteration that comes to rest on the side may pass through.
constexpr double kMostExtension = 0.3;

// Near such a side the direction of a ray knows what its place does, divided by the way to the side.
constexpr double kOntoSide = 1e-11;

// Where connect() finds no way to such a side, a place so far inside it, in parts of the domain's extents, is a start.
constexpr double kInside = 0.02;

/// Nearer to such a side than the first the normal is noise; up to the second, rays are aimed as at the side itself, as
/// rough ones might run over it.
constexpr double kNoPlane = 1e-10;
constexpr double kBesideSide = 1e-2;
bool has_plane(const SurfaceJet& j, double least = kNoPlane) {
  return j.Su.cross(j.Sv).norm() > least * std::max(j.Su.squaredNorm(), j.Sv.squaredNorm());
}

/// The middle of the domain pulls the place off the side that it lies on.
Uv a_little_inside(const UvBox& domain, Uv m) { return m + kInside * (Uv{domain.u.middle(), domain.v.middle()} - m); }

/// From the end of the ray to the target, see moved().
Polar second_order_step(const SiteRay& ray, const Xyz& target) {
  const double a = ray.T.dot(target - ray.x), b = ray.N.dot(target - ray.x);
  const double y_there = ray.y + a * ray.dy;
  return {a + 0.5 * b * b * ray.dy / ray.y, b / (y_there * ray.y > 0.0 ? y_there : ray.y)};
}

}  // namespace

SiteRays::SiteRays(const Surface& surface, const std::vector<Uv>& sites)
    : surface_(surface),
      sites_(sites),
      map_(std::make_shared<CurvatureMap>(surface)),
      closed_form_(has_closed_form(surface)) {
  sources_.reserve(sites.size());
  for (const Uv p : sites) sources_.emplace_back(surface, p, map_.get());
}

std::optional<SiteRay> SiteRays::at(int site, Polar polar) const {
  const auto shot = shoot(site, polar, kRayTolerance);
  if (!shot) return std::nullopt;
  return shot->ray;
}

std::optional<RayShot> SiteRays::shoot(int site, Polar polar, double tolerance) const {
  if (!(polar.s > 0.0) || !std::isfinite(polar.s)) return std::nullopt;
  TraceOptions options;
  options.stop_at_domain = false;
  options.tolerance = tolerance;
  const bool known = site < static_cast<int>(sources_.size());
  const TracedRay end = known ? sources_[site].end(polar.s, polar.t, options)
                              : RaySource(surface_, sites_[site], map_.get()).end(polar.s, polar.t, options);
  if (end.status != TraceStatus::Converged) return std::nullopt;
  const SpaceState& at = end.at;
  const RayShot shot{
      {site, polar, at.p, at.S, at.tangent, at.normal.cross(at.tangent), at.y, at.dy}, end.jet, end.tolerance};
  if (!usable(shot.ray)) return std::nullopt;
  return shot;
}

// What connect() has found is shot once more, to all digits and for the ray's frame at its end.
std::optional<SiteRay> SiteRays::to(int site, Uv m, std::optional<Polar> guess) const {
  if (guess && !closed_form_) return shoot_near(site, m, *guess, kRayTolerance);
  ConnectOptions options;
  options.tolerance = kRoughly;
  const Connection c = connect(surface_, sites_[site], m, guess, options);
  if (c.status == ConnectStatus::Converged) return shoot_near(site, m, {c.length, c.angle}, kRayTolerance, kRoughly);
  if (has_plane(surface_.jet(m))) return std::nullopt;
  const Connection beside = connect(surface_, sites_[site], a_little_inside(surface_.domain(), m), guess, options);
  if (beside.status != ConnectStatus::Converged) return std::nullopt;
  return shoot_near(site, m, {beside.length, beside.angle}, kRayTolerance);
}

// A place on a side with Su = 0 across it has no direction in the parameter plane, but one in space.
std::optional<RayShot> SiteRays::shoot_onto_side(int site, Polar polar, double tolerance) const {
  double length = (1.0 - kBeforeSide) * polar.s;
  auto shot = shoot(site, {length, polar.t}, tolerance);
  if (!shot) {
    TraceOptions options;
    options.stop_at_domain = false;
    options.tolerance = tolerance;
    const Xyz T = tangent_frame(surface_, sites_[site]).at_angle(polar.t);
    GeodesicIntegrator path(surface_, sites_[site], T, polar.s, options);
    if (path.advance(polar.s) != TraceStatus::DegenerateMetric) return std::nullopt;
    length = path.covered() - kBeforeSide * polar.s;
    if (polar.s - length <= kMostExtension * polar.s) shot = shoot(site, {length, polar.t}, tolerance);
  }
  if (!shot) return std::nullopt;
  SiteRay& ray = shot->ray;
  const SpaceState end =
      extended({ray.x, ray.T, ray.T.cross(ray.N), ray.y, ray.dy, ray.uv}, shot->jet, polar.s - length);
  ray = {site, polar, ray.uv, end.S, end.tangent, end.normal.cross(end.tangent), end.y, end.dy};
  return shot;
}

std::optional<SiteRay> SiteRays::roughly_to(int site, Uv m, std::optional<Polar> guess) const {
  if (guess && !closed_form_) return shoot_near(site, m, *guess, kRoughly);
  return to(site, m, guess);
}

// Only the geodesic next to the guess is of use here, where connect() would go on to look for any other. Shots
// until the miss is so small that one more step makes it good.
std::optional<SiteRay> SiteRays::shoot_near(int site, Uv m, Polar aim, double tolerance, double miss_of_guess) const {
  const SurfaceJet target = surface_.jet(m);
  const bool on_side = !closed_form_ && !has_plane(target, kBesideSide);
  const ShotLadder ladder(curvature() * aim.s, tolerance);
  double last = std::numeric_limits<double>::infinity(), asked = ladder.tolerance_for(miss_of_guess);
  for (int i = 0; i < kMostShots && aim.s > 0.0; ++i) {
    if (on_side) asked = std::min(asked, kOntoSide);
    const auto shot = on_side ? shoot_onto_side(site, aim, asked) : shoot(site, aim, asked);
    if (!shot) return std::nullopt;
    const SiteRay& ray = shot->ray;
    const double miss = (target.S - ray.x).norm();
    if (!(miss < last)) return std::nullopt;
    if (asked <= tolerance) last = miss;
    const double relative = miss / std::min(aim.s, std::abs(ray.y));
    const bool near = relative <= ladder.made_good() || miss <= kRayTolerance * aim.s;  // no trace comes any nearer
    if (near && std::min(asked, shot->tolerance) <= tolerance) return moved(ray, m, target);
    const Polar step = second_order_step(ray, target.S);
    const double k = std::min({1.0, kMostTurn / std::abs(step.t), kMostStretch * aim.s / std::abs(step.s)});
    aim = {aim.s + k * step.s, aim.t + k * step.t};
    asked = ladder.tolerance_for(k < 1.0 ? relative : ladder.after(relative));
  }
  return std::nullopt;
}

SiteRay moved(const SiteRay& ray, Uv m, const SurfaceJet& j) {
  const Polar step = second_order_step(ray, j.S);
  const Xyz n = has_plane(j) ? unit_normal(j) : Xyz(ray.T.cross(ray.N));  // none at a pole
  const Xyz T = ray.T + step.t * ray.dy * ray.N;
  SiteRay there = ray;
  there.polar = {ray.polar.s + step.s, ray.polar.t + step.t};
  there.uv = m;
  there.x = j.S;
  there.T = (T - T.dot(n) * n).normalized();
  there.N = n.cross(there.T);
  there.y = ray.y + step.s * ray.dy;
  return there;
}

Polar carry(const SiteRay& ray, const Xyz& m) {
  const Xyz step = m - ray.x;
  return {ray.polar.s + ray.T.dot(step), ray.polar.t + ray.N.dot(step) / ray.y};
}

bool same_generator(const SiteRay& a, const SiteRay& b) {
  return a.site == b.site && std::abs(wrap_angle(a.polar.t - b.polar.t)) < kSameAngle;
}

UvVec nearest_copy(const Surface& surface, Uv a, Uv b) {
  const auto wrap = [](double x, const std::optional<double>& period) {
    return period ? std::remainder(x, *period) : x;
  };
  return {wrap(b.u - a.u, surface.u_period()), wrap(b.v - a.v, surface.v_period())};
}

double wrap_angle(double t) { return std::remainder(t, kTwoPi); }

double turn_between(const Xyz& a, const Xyz& b, const Xyz& n) {
  const double angle = std::atan2(n.dot(a.cross(b)), a.dot(b));
  return angle < 0.0 ? angle + kTwoPi : angle;
}

}  // namespace geovor
