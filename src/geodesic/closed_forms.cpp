#include "geodesic/closed_forms.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geodesic/cone_development.h"
#include "surface/elementary_surfaces.h"
#include "surface/forms.h"

namespace geovor {
namespace {

constexpr double kPi = std::numbers::pi;

const Sphere* as_sphere(const Surface& surface) { return dynamic_cast<const Sphere*>(&surface); }

const Cone* as_cone(const Surface& surface) { return dynamic_cast<const Cone*>(&surface); }

// Plane and cylinder: E, F and G are constants.
bool is_flat(const Surface& surface) {
  return dynamic_cast<const Plane*>(&surface) != nullptr || dynamic_cast<const Cylinder*>(&surface) != nullptr;
}

double turn(double s, double t, double s_guess, double t_guess) {
  return std::hypot(s * std::cos(t) - s_guess * std::cos(t_guess), s * std::sin(t) - s_guess * std::sin(t_guess));
}

// A point of the unit sphere with the tangents along the parameter lines, in the sphere's own frame. They exist at the
// poles too: there u tells them apart.
struct SpherePoint {
  Xyz x, e_u, e_v;
  double cos_v;
  explicit SpherePoint(Uv p) : cos_v(std::cos(p.v)) {
    const double cu = std::cos(p.u), su = std::sin(p.u), sv = std::sin(p.v);
    x = {cos_v * cu, cos_v * su, sv};
    e_u = {-su, cu, 0.0};
    if (cos_v < 0.0) e_u = -e_u;  // |Su| = R |cos v|
    e_v = {-sv * cu, -sv * su, cos_v};
  }
  Xyz heading(double t) const { return std::cos(t) * e_u + std::sin(t) * e_v; }
  double angle(const Xyz& w) const { return std::atan2(w.dot(e_v), w.dot(e_u)); }
  UvVec direction(const Xyz& w, double R) const { return {w.dot(e_u) / (R * std::abs(cos_v)), w.dot(e_v) / R}; }
};

// On a great circle u runs monotonically, by half a turn for every half circle.
Uv sphere_uv(Uv start, const SpherePoint& from, const Xyz& x, double arc, double t) {
  const double half_turns = std::floor(arc / kPi);
  const double side = std::fmod(half_turns, 2.0) == 0.0 ? 1.0 : -1.0;
  const double rest =
      std::atan2(side * (from.x.x() * x.y() - from.x.y() * x.x()), side * (from.x.x() * x.x() + from.x.y() * x.y()));
  const double u = start.u + std::copysign(half_turns * kPi, std::cos(t)) + rest;
  return {u, std::atan2(x.z(), std::hypot(x.x(), x.y()))};
}

TraceResult trace_sphere(const Sphere& sphere, Uv start, UvVec direction, double length) {
  const double R = sphere.radius(), arc = length / R;
  const SpherePoint from(start);
  const double t = std::atan2(direction.v, direction.u * std::abs(from.cos_v));
  const Xyz heading = from.heading(t);
  const Xyz x = std::cos(arc) * from.x + std::sin(arc) * heading;
  const Xyz w = std::cos(arc) * heading - std::sin(arc) * from.x;
  const Uv end = sphere_uv(start, from, x, arc, t);
  return {
      TraceStatus::Converged, {end, SpherePoint(end).direction(w, R), R * std::sin(arc), std::cos(arc)}, length, 0, 0};
}

TraceResult trace_flat(const Surface& surface, Uv start, UvVec direction, double length) {
  const FirstForm metric = first_form(surface.jet(start));
  const UvVec d = (1.0 / norm(metric, direction)) * direction;
  return {TraceStatus::Converged, {start + length * d, d, length, 1.0}, length, 0, 1};
}

Connection found(double length, double angle, UvVec start, UvVec end, double y) {
  Connection c;
  c.status = ConnectStatus::Converged;
  c.length = length;
  c.angle = angle;
  c.start_direction = start;
  c.end_direction = end;
  c.y = y;
  return c;
}

// The shorter arc of the great circle and the longer one, which leaves the other way.
std::vector<Connection> connect_sphere(const Sphere& sphere, Uv from, Uv to, double fallback_angle) {
  const double R = sphere.radius();
  const SpherePoint p(from), q(to);
  // chord and sum, as |p - q| / 2 = sin(arc / 2): exact for short arcs and for nearly opposite points alike.
  const double arc = 2.0 * std::atan2((p.x - q.x).norm(), (p.x + q.x).norm());
  const Xyz chord = q.x - p.x;
  const bool meets = chord.dot(p.e_u) == 0.0 && chord.dot(p.e_v) == 0.0;  // equal or opposite: any direction will do
  const double t = meets ? fallback_angle : p.angle(chord);
  std::vector<Connection> both;
  for (const double way : {1.0, -1.0}) {
    const double a = way > 0.0 ? arc : 2.0 * kPi - arc;
    const double angle = way > 0.0 ? t : std::remainder(t + kPi, 2.0 * kPi);
    const Xyz heading = p.heading(angle);
    const Xyz w = std::cos(a) * heading - std::sin(a) * p.x;
    both.push_back(found(R * a, angle, p.direction(heading, R), q.direction(w, R), R * std::sin(a)));
  }
  return both;
}

Connection connect_flat(const FirstForm& metric, UvVec way, double fallback_angle) {
  const double length = norm(metric, way);
  const double angle = length > 0.0 ? angle_of_direction(metric, way) : fallback_angle;
  const UvVec d = length > 0.0 ? (1.0 / length) * way : direction_at_angle(metric, angle);
  return found(length, angle, d, d, length);
}

UvVec nearest_winding(const Surface& surface, UvVec way, double to_u) {
  const auto period = surface.u_period();
  return period ? UvVec{way.u - *period * std::round((way.u - to_u) / *period), way.v} : way;
}

}  // namespace

bool has_closed_form(const Surface& surface) {
  return is_flat(surface) || as_sphere(surface) != nullptr || as_cone(surface) != nullptr;
}

std::optional<TraceResult> trace_closed_form(const Surface& surface, Uv start, UvVec direction, double length) {
  if (const Sphere* sphere = as_sphere(surface)) return trace_sphere(*sphere, start, direction, length);
  if (const Cone* cone = as_cone(surface)) return trace_cone(*cone, start, direction, length);
  if (is_flat(surface)) return trace_flat(surface, start, direction, length);
  return std::nullopt;
}

std::optional<Connection> connect_closed_form(const Surface& surface, Uv from, Uv to, std::optional<Polar> guess) {
  const double fallback_angle = guess ? guess->t : 0.0;
  if (const Sphere* sphere = as_sphere(surface)) {
    const auto both = connect_sphere(*sphere, from, to, fallback_angle);
    if (!guess) return both.front();
    return *std::min_element(both.begin(), both.end(), [&](const Connection& a, const Connection& b) {
      return turn(a.length, a.angle, guess->s, guess->t) < turn(b.length, b.angle, guess->s, guess->t);
    });
  }
  if (const Cone* cone = as_cone(surface)) {
    const UvVec towards = guess ? direction_at_angle(first_form(cone->jet(from)), guess->t) : UvVec{};
    const double u = guess && is_finite(towards) ? trace_cone(*cone, from, towards, guess->s).end.p.u : from.u;
    const auto all = connect_cone(*cone, from, to, u);
    return all.empty() ? Connection{} : all.front();
  }
  if (!is_flat(surface)) return std::nullopt;
  const FirstForm metric = first_form(surface.jet(from));
  const double guessed_u = guess ? guess->s * direction_at_angle(metric, guess->t).u : 0.0;
  return connect_flat(metric, nearest_winding(surface, to - from, guessed_u), fallback_angle);
}

std::optional<std::vector<Connection>> connections_closed_form(const Surface& surface, Uv from, Uv to) {
  if (const Sphere* sphere = as_sphere(surface)) return connect_sphere(*sphere, from, to, 0.0);
  if (const Cone* cone = as_cone(surface)) return connect_cone(*cone, from, to, from.u);
  if (!is_flat(surface)) return std::nullopt;
  const FirstForm metric = first_form(surface.jet(from));
  const UvVec way = nearest_winding(surface, to - from, 0.0);
  std::vector<Connection> all{connect_flat(metric, way, 0.0)};
  if (const auto period = surface.u_period()) {
    all.push_back(connect_flat(metric, {way.u - std::copysign(*period, way.u), way.v}, 0.0));
  }
  return all;
}

}  // namespace geovor
