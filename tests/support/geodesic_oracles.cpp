#include "support/geodesic_oracles.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "surface/forms.h"

namespace geovor::testing {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kInf = std::numeric_limits<double>::infinity();

using Vector6 = Eigen::Matrix<double, 6, 1>;

Vector6 slope(const Surface& surface, const Vector6& x) {
  const SurfaceJet j = surface.jet({x[0], x[1]});
  const Christoffel c = christoffel(j);
  const double du = x[2], dv = x[3];
  Vector6 f;
  f << du, dv, -(c.u_uu * du * du + 2.0 * c.u_uv * du * dv + c.u_vv * dv * dv),
      -(c.v_uu * du * du + 2.0 * c.v_uv * du * dv + c.v_vv * dv * dv), x[5], -curvatures(j).gauss * x[4];
  return f;
}

}  // namespace

double great_circle_distance(const Xyz& a, const Xyz& b, double R) {
  return R * std::atan2(a.cross(b).norm(), a.dot(b));
}

double clairaut(const SurfaceJet& j, UvVec d) { return Xyz::UnitZ().cross(j.S).dot(push_forward(j, d).normalized()); }

GeodesicState fine_steps(const Surface& surface, Uv start, UvVec direction, double length, int steps) {
  const double speed = norm(surface.jet(start), direction), h = length / steps;
  Vector6 x;
  x << start.u, start.v, direction.u / speed, direction.v / speed, 0.0, 1.0;
  for (int i = 0; i < steps; ++i) {
    const Vector6 k1 = slope(surface, x);
    const Vector6 k2 = slope(surface, x + 0.5 * h * k1);
    const Vector6 k3 = slope(surface, x + 0.5 * h * k2);
    const Vector6 k4 = slope(surface, x + h * k3);
    x += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return {{x[0], x[1]}, {x[2], x[3]}, x[4], x[5]};
}

UvVec heading(const Surface& surface, Uv p, double t) { return direction_at_angle(surface.jet(p), t); }

double gap(const Surface& surface, Uv a, Uv b) { return (surface.position(a) - surface.position(b)).norm(); }

UvBox WavyVase::domain() const { return {{0.0, kTwoPi}, {-10.0, 10.0}}; }
std::optional<double> WavyVase::u_period() const { return kTwoPi; }

SurfaceJet WavyVase::jet(Uv p) const {
  const double r = 2.0 + 0.5 * std::sin(2.0 * p.v), r1 = std::cos(2.0 * p.v), r2 = -2.0 * std::sin(2.0 * p.v);
  const Xyz out{std::cos(p.u), std::sin(p.u), 0.0}, round{-std::sin(p.u), std::cos(p.u), 0.0};
  const Xyz up = Xyz::UnitZ();
  return {r * out + p.v * up, r * round, r1 * out + up, -r * out, r1 * round, r2 * out};
}

UvBox Can::domain() const { return {{0.0, kTwoPi}, {0.0, kInf}}; }
std::optional<double> Can::u_period() const { return kTwoPi; }

Span Can::span(Uv p, UvVec towards) const {
  const bool side = p.v > radius_ || (p.v == radius_ && towards.v >= 0.0);
  return {0, side ? 1 : 0, {{-kInf, kInf}, side ? Interval{radius_, kInf} : Interval{-kInf, radius_}}};
}

SurfaceJet Can::jet(Uv p, const Span& span) const {
  const Xyz out{std::cos(p.u), std::sin(p.u), 0.0}, round{-std::sin(p.u), std::cos(p.u), 0.0};
  const Xyz zero = Xyz::Zero();
  if (span.v == 0) return {p.v * out, p.v * round, out, -p.v * out, round, zero};
  return {radius_ * out + (p.v - radius_) * Xyz::UnitZ(), radius_ * round, Xyz::UnitZ(), -radius_ * out, zero, zero};
}

}  // namespace geovor::testing
