#include "voronoi/site_ray.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geodesic/closed_forms.h"
#include "geodesic/offset.h"
#include "surface/forms.h"

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

void set_frame(const SurfaceJet& j, UvVec direction, SiteRay& ray) {
  ray.x = j.S;
  ray.T = push_forward(j, direction).normalized();
  ray.N = unit_normal(j).cross(ray.T);
}

/// From the end of the ray to the target: about the end the geodesic circle has the curvature y'/y.
Polar second_order_step(const SiteRay& ray, double dy, const Xyz& target) {
  const double a = ray.T.dot(target - ray.x), b = ray.N.dot(target - ray.x);
  const double y_there = ray.y + a * dy;
  return {a + 0.5 * b * b * dy / ray.y, b / (y_there * ray.y > 0.0 ? y_there : ray.y)};
}

SiteRay moved(SiteRay ray, const Polar& step, double dy, Uv m, const Xyz& target) {
  const Xyz T = (ray.T + step.t * dy * ray.N).normalized(), n = ray.T.cross(ray.N);
  return {ray.site, {ray.polar.s + step.s, ray.polar.t + step.t}, m, target, T, n.cross(T), ray.y + step.s * dy};
}

}  // namespace

std::optional<SiteRay> SiteRays::at(int site, Polar polar) const {
  if (!(polar.s > 0.0)) return std::nullopt;
  TraceOptions options;
  options.stop_at_domain = false;
  const OffsetJet o = offset(surface_, sites_[site], polar.s, polar.t, options);
  if (o.status != TraceStatus::Converged) return std::nullopt;
  SiteRay ray{site, polar, o.uv, {}, {}, {}, o.y};
  set_frame(surface_.jet(o.uv), o.ds, ray);
  if (!usable(ray)) return std::nullopt;
  return ray;
}

/// How the shots of one search are fired.
struct SiteRays::Accuracy {
  double first, others;  ///< tolerances of the integrator; the miss of the first shot is that of the guess anyway
  double last_miss;      ///< as a part of the length (and of y): what one more step makes good
  bool one_shot;         ///< the first shot may be the last
};

namespace {
// The step that makes the last miss e good leaves e^3.
constexpr SiteRays::Accuracy kFull = {1e-7, 1e-12, 1e-5, false};
constexpr SiteRays::Accuracy kRough = {0.1 * kRoughly, 0.1 * kRoughly, 1e-3, true};
}  // namespace

std::optional<SiteRay> SiteRays::to(int site, Uv m, std::optional<Polar> guess) const {
  if (guess && !has_closed_form(surface_)) return shoot_near(site, m, *guess, kFull);
  const Connection c = connect(surface_, sites_[site], m, guess);
  if (c.status != ConnectStatus::Converged || !(c.length > 0.0)) return std::nullopt;
  SiteRay ray{site, {c.length, c.angle}, m, {}, {}, {}, c.y};
  set_frame(surface_.jet(m), c.end_direction, ray);
  if (!usable(ray)) return std::nullopt;
  return ray;
}

// Only the geodesic next to the guess is of use here, where connect() would go on to look for any other. Shots
// until the miss is so small that one more step makes it good.
std::optional<SiteRay> SiteRays::roughly_to(int site, Uv m, std::optional<Polar> guess) const {
  if (guess && !has_closed_form(surface_)) return shoot_near(site, m, *guess, kRough);
  return to(site, m, guess);
}

std::optional<SiteRay> SiteRays::shoot_near(int site, Uv m, Polar aim, const Accuracy& accuracy) const {
  const Xyz target = surface_.position(m);
  const SurfaceJet at_site = surface_.jet(sites_[site]);
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMostShots && aim.s > 0.0; ++i) {
    TraceOptions options;
    options.stop_at_domain = false;
    options.tolerance = i == 0 ? accuracy.first : accuracy.others;
    const TraceResult shot = trace_geodesic(surface_, sites_[site], direction_at_angle(at_site, aim.t), aim.s, options);
    if (shot.status != TraceStatus::Converged) return std::nullopt;
    SiteRay ray{site, aim, shot.end.p, {}, {}, {}, shot.end.y};
    set_frame(surface_.jet(shot.end.p), shot.end.d, ray);
    const double miss = (target - ray.x).norm();
    if (!usable(ray) || !(miss < last)) return std::nullopt;
    const Polar step = second_order_step(ray, shot.end.dy, target);
    if ((i > 0 || accuracy.one_shot) && miss <= accuracy.last_miss * std::min(aim.s, std::abs(ray.y))) {
      return moved(ray, step, shot.end.dy, m, target);
    }
    const double k = std::min({1.0, kMostTurn / std::abs(step.t), kMostStretch * aim.s / std::abs(step.s)});
    aim = {aim.s + k * step.s, aim.t + k * step.t};
    if (i > 0) last = miss;
  }
  return std::nullopt;
}

Polar carry(const SiteRay& ray, const Xyz& m) {
  const Xyz step = m - ray.x;
  return {ray.polar.s + ray.T.dot(step), ray.polar.t + ray.N.dot(step) / ray.y};
}

bool near_guess(const SiteRay& ray, int site, const Polar& guess, double reach) {
  if (ray.site != site) return false;
  return std::abs(ray.polar.s - guess.s) + std::abs(ray.y * wrap_angle(ray.polar.t - guess.t)) < kSameGuess * reach;
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
