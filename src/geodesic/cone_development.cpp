#include "geodesic/cone_development.h"

#include <cmath>
#include <numbers>

#include "geodesic/angle_difference.h"

// In the development a point has polar coordinates rho = |v - v_tip| and theta = u sin(alpha), alpha the half-angle;
// |Sv| = 1 and |Su| = rho sin(alpha). A direction has the component a along rho and b across, towards growing theta.
// Lengths along rho are taken as differences of v wherever they can be: a slender cone's tip is far away, and v - v_tip
// rounds accordingly.

namespace geovor {
namespace {

constexpr double kPi = std::numbers::pi;

double sine(const Cone& cone) { return std::abs(std::sin(cone.half_angle())); }

double along(const Cone& cone, Uv p) { return p.v - cone.apex_v(); }

// The nappe: the sign of v - v_tip. At the tip itself both are at hand, and `other` tells.
double nappe(double v_from_tip, double other) { return std::copysign(1.0, v_from_tip != 0.0 ? v_from_tip : other); }

UvVec direction(const Cone& cone, double rho, double side, double a, double b) {
  return {rho > 0.0 ? b / (rho * sine(cone)) : 0.0, side * a};
}

// Between points of one nappe, whose longitudes differ by theta in the development.
Connection chord(const Cone& cone, Uv from, Uv to, double side, double theta) {
  const double p = std::abs(along(cone, from)), q = std::abs(along(cone, to)), outwards = side * (to.v - from.v);
  // Without the cancellation of q cos(theta) - p.
  const double half = std::sin(0.5 * theta);
  const double x = outwards - 2.0 * q * half * half, y = q * std::sin(theta);
  const double x_end = outwards + 2.0 * p * half * half, y_end = p * std::sin(theta);
  Connection c;
  c.status = ConnectStatus::Converged;
  c.length = c.y = std::hypot(outwards, 2.0 * std::sqrt(p * q) * half);
  const double a = c.length > 0.0 ? x / c.length : 0.0, b = c.length > 0.0 ? y / c.length : 1.0;
  const double a_end = c.length > 0.0 ? x_end / c.length : 0.0, b_end = c.length > 0.0 ? y_end / c.length : 1.0;
  c.angle = std::atan2(side * a, b);
  c.start_direction = direction(cone, p, side, a, b);
  c.end_direction = direction(cone, q, side, a_end, b_end);
  return c;
}

}  // namespace

TraceResult trace_cone(const Cone& cone, Uv start, UvVec given, double length) {
  const double from_tip = along(cone, start), rho = std::abs(from_tip), side = nappe(from_tip, given.v);
  const double out = side * given.v, across = given.u * rho * sine(cone), norm = std::hypot(out, across);
  if (!(norm > 0.0)) return {TraceStatus::DegenerateMetric, {start, {}, 0.0, 1.0}, 0.0, 0, 0};
  const double a = out / norm, b = across / norm;
  TraceResult r;
  const bool meets_tip = b == 0.0 && rho + length * a < 0.0;
  r.status = meets_tip ? TraceStatus::DegenerateMetric : TraceStatus::Converged;
  r.length = meets_tip ? rho : length;
  const double x = rho + r.length * a, y = r.length * b, rho_end = std::hypot(x, y);
  // rho_end - rho, without their cancellation.
  const double outwards = rho_end > 0.0 ? r.length * (2.0 * rho * a + r.length) / (rho + rho_end) : -rho;
  r.end.p = {start.u + std::atan2(y, x) / sine(cone), start.v + side * outwards};
  const double a_end = rho_end > 0.0 ? (a * rho + r.length) / rho_end : a;
  const double b_end = rho_end > 0.0 ? b * rho / rho_end : 0.0;
  r.end.d = direction(cone, rho_end, side, a_end, b_end);
  r.end.y = r.length;
  r.end.dy = 1.0;
  return r;
}

std::vector<Connection> connect_cone(const Cone& cone, Uv from, Uv to, double near) {
  const double p = along(cone, from), q = along(cone, to);
  if (p == 0.0 || q == 0.0) return {chord(cone, from, to, nappe(p, q), 0.0)};
  if (nappe(p, q) != nappe(q, p)) return {};
  std::vector<Connection> all;
  const double turn = nearest_turn(from.u, to.u, near);
  for (const double du : {turn, other_way_round(from.u, to.u, turn)}) {
    const double theta = du * sine(cone);
    if (std::abs(theta) < kPi) all.push_back(chord(cone, from, to, nappe(p, q), theta));
  }
  return all;
}

}  // namespace geovor
