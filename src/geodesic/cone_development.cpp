#include "geodesic/cone_development.h"

#include <cmath>
#include <numbers>

// In the development a point has polar coordinates rho = |v - v_tip| and theta = u sin(alpha), alpha the half-angle;
// |Sv| = 1 and |Su| = rho sin(alpha). A direction has the component a along rho and b across, towards growing theta.

namespace geovor {
namespace {

constexpr double kPi = std::numbers::pi;

struct Developed {
  double rho;   // from the tip
  double side;  // +1, -1: the nappe, which is the sign of v - v_tip
};

Developed develop(const Cone& cone, Uv p) {
  const double along = p.v - cone.apex_v();
  return {std::abs(along), along < 0.0 ? -1.0 : 1.0};
}

double sine(const Cone& cone) { return std::abs(std::sin(cone.half_angle())); }

UvVec direction(const Cone& cone, double rho, double side, double a, double b) {
  return {rho > 0.0 ? b / (rho * sine(cone)) : 0.0, side * a};
}

}  // namespace

TraceResult trace_cone(const Cone& cone, Uv start, UvVec given, double length) {
  const Developed p = develop(cone, start);
  double a = p.side * given.v, b = given.u * p.rho * sine(cone);
  const double norm = std::hypot(a, b);
  a /= norm;
  b /= norm;
  TraceResult r;
  r.status = TraceStatus::Converged;
  r.length = length;
  if (b == 0.0 && p.rho + length * a < 0.0) {
    r.status = TraceStatus::DegenerateMetric;
    r.length = p.rho;
  }
  const double x = p.rho + r.length * a, y = r.length * b, rho = std::hypot(x, y);
  r.end.p = {start.u + std::atan2(y, x) / sine(cone), cone.apex_v() + p.side * rho};
  const double a_end = rho > 0.0 ? (a * x + b * y) / rho : a, b_end = rho > 0.0 ? (b * x - a * y) / rho : 0.0;
  r.end.d = direction(cone, rho, p.side, a_end, b_end);
  r.end.y = r.length;
  r.end.dy = 1.0;
  return r;
}

std::vector<Connection> connect_cone(const Cone& cone, Uv from, Uv to, double u) {
  std::vector<Connection> all;
  const Developed p = develop(cone, from), q = develop(cone, to);
  if (p.rho > 0.0 && q.rho > 0.0 && p.side != q.side) return all;
  const double nearest = to.u - 2.0 * kPi * std::round((to.u - u) / (2.0 * kPi));
  const double next = nearest - std::copysign(2.0 * kPi, nearest - from.u);
  for (const double end_u : {nearest, next}) {
    const double theta = (end_u - from.u) * sine(cone);
    if (!(std::abs(theta) < kPi)) continue;
    // The chord, without the cancellation of rho_q cos(theta) - rho_p.
    const double half = std::sin(theta / 2.0);
    const double x = q.rho - p.rho - 2.0 * q.rho * half * half, y = q.rho * std::sin(theta);
    const double length = std::hypot(q.rho - p.rho, 2.0 * std::sqrt(p.rho * q.rho) * half);
    const double side = p.rho > 0.0 ? p.side : q.side;
    const double a = length > 0.0 ? x / length : 0.0, b = length > 0.0 ? y / length : 1.0;
    Connection c;
    c.status = ConnectStatus::Converged;
    c.length = c.y = length;
    c.angle = std::atan2(side * a, b);
    c.start_direction = direction(cone, p.rho, side, a, b);
    c.end_direction = direction(cone, q.rho, side, a * std::cos(theta) + b * std::sin(theta),
                                b * std::cos(theta) - a * std::sin(theta));
    all.push_back(c);
  }
  return all;
}

}  // namespace geovor
