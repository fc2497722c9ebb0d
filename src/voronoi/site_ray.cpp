#include "voronoi/site_ray.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

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

void set_frame(const SurfaceJet& j, UvVec direction, SiteRay& ray) {
  ray.x = j.S;
  ray.T = push_forward(j, direction).normalized();
  ray.N = unit_normal(j).cross(ray.T);
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

std::optional<SiteRay> SiteRays::to(int site, Uv m, std::optional<Polar> guess) const {
  const Connection c = connect(surface_, sites_[site], m, guess);
  if (c.status != ConnectStatus::Converged || !(c.length > 0.0)) return std::nullopt;
  SiteRay ray{site, {c.length, c.angle}, m, {}, {}, {}, c.y};
  set_frame(surface_.jet(m), c.end_direction, ray);
  if (!usable(ray)) return std::nullopt;
  return ray;
}

Polar carry(const SiteRay& ray, const Xyz& m) {
  const Xyz step = m - ray.x;
  return {ray.polar.s + ray.T.dot(step), ray.polar.t + ray.N.dot(step) / ray.y};
}

bool same_generator(const SiteRay& a, const SiteRay& b) {
  return a.site == b.site && std::abs(wrap_angle(a.polar.t - b.polar.t)) < kSameAngle;
}

double wrap_angle(double t) { return std::remainder(t, kTwoPi); }

double turn_between(const Xyz& a, const Xyz& b, const Xyz& n) {
  const double angle = std::atan2(n.dot(a.cross(b)), a.dot(b));
  return angle < 0.0 ? angle + kTwoPi : angle;
}

}  // namespace geovor
