#include "geodesic/great_circle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geodesic/angle_difference.h"

namespace geovor {
namespace {

constexpr double kPi = std::numbers::pi;

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

// A unit tangent of the unit sphere by its parts along the parallel, towards growing u, and the meridian.
struct Heading {
  double east, north;
};

double size(Heading h) { return std::hypot(h.east, h.north); }

Heading normalized(Heading h) { return {h.east / size(h), h.north / size(h)}; }

// Spherical trigonometry between p and q. Nothing cancels: neighbours are compared through half their differences,
// nearly opposite points through half of what they miss to half a turn.
struct Triangle {
  double cos_p, cos_q;
  double half_chord, half_sum;  // |q - p| / 2 = sin(arc / 2), |q + p| / 2 = cos(arc / 2)
  Heading p, q;                 // the great circle's heading at either end, times sin(arc)

  Triangle(Uv from, Uv to) : cos_p(std::cos(from.v)), cos_q(std::cos(to.v)) {
    const double turns = whole_turns(from.u, to.u, 0.0), du = angle_difference(from.u, to.u, turns);
    const double missing = angle_difference(from.u, to.u, turns + (du < 0.0 ? -1.0 : 1.0));
    const double sine = std::sin(0.5 * du), cosine = std::abs(std::sin(0.5 * missing));  // of du / 2
    const double up = to.v - from.v, sum = from.v + to.v;
    half_chord = side(std::sin(0.5 * up), sine);
    half_sum = side(std::sin(0.5 * sum), cosine);
    const double sin_p = std::sin(from.v), sin_q = std::sin(to.v), twice = 2.0 * sine * cosine;
    if (half_chord < half_sum) {
      p = {twice * cos_q, std::sin(up) + 2.0 * sin_p * cos_q * sine * sine};
      q = {twice * cos_p, std::sin(up) - 2.0 * sin_q * cos_p * sine * sine};
    } else {
      p = {twice * cos_q, std::sin(sum) - 2.0 * sin_p * cos_q * cosine * cosine};
      q = {twice * cos_p, 2.0 * sin_q * cos_p * cosine * cosine - std::sin(sum)};
    }
  }

 private:
  // Beyond a pole, where rounding may put a point, a cosine is negative.
  double side(double along_meridian, double along_parallel) const {
    return std::sqrt(std::max(along_meridian * along_meridian + cos_p * cos_q * along_parallel * along_parallel, 0.0));
  }
};

// Between equal or opposite points: the heading at `from` at angle t, and what it has become at `to`.
Heading any_heading(Uv from, double t) { return {std::cos(from.v) < 0.0 ? -std::cos(t) : std::cos(t), std::sin(t)}; }

Heading carried_over(Uv from, Uv to, double t, double arc) {
  const SpherePoint p(from), q(to);
  const Xyz w = arc < 1.0 ? p.heading(t) : Xyz(-p.heading(t));
  return {std::copysign(1.0, q.cos_v) * w.dot(q.e_u), w.dot(q.e_v)};
}

}  // namespace

TraceResult trace_sphere(const Sphere& sphere, Uv start, UvVec direction, double length) {
  const double R = sphere.radius(), arc = length / R;
  const SpherePoint from(start);
  const double t = std::atan2(direction.v, direction.u * std::abs(from.cos_v));
  if (!(std::hypot(direction.u, direction.v) > 0.0))
    return {TraceStatus::DegenerateMetric, {start, {}, 0.0, 1.0}, 0.0, 0, 0};
  const Xyz heading = from.heading(t);
  const Xyz x = std::cos(arc) * from.x + std::sin(arc) * heading;
  const Xyz w = std::cos(arc) * heading - std::sin(arc) * from.x;
  const Uv end = sphere_uv(start, from, x, arc, t);
  return {
      TraceStatus::Converged, {end, SpherePoint(end).direction(w, R), R * std::sin(arc), std::cos(arc)}, length, 0, 0};
}

std::vector<Connection> connect_sphere(const Sphere& sphere, Uv from, Uv to, double fallback_angle) {
  const double R = sphere.radius();
  const Triangle triangle(from, to);
  const double arc = 2.0 * std::atan2(triangle.half_chord, triangle.half_sum);
  const double y = R * size(triangle.p);
  const bool meets = !(y > 0.0);
  const Heading p = meets ? any_heading(from, fallback_angle) : normalized(triangle.p);
  const Heading q = meets ? carried_over(from, to, fallback_angle, arc) : normalized(triangle.q);
  std::vector<Connection> both(2);
  for (const double way : {1.0, -1.0}) {
    Connection& c = both[way > 0.0 ? 0 : 1];
    c.status = ConnectStatus::Converged;
    c.length = R * (way > 0.0 ? arc : 2.0 * kPi - arc);
    c.angle = std::atan2(way * p.north, std::copysign(1.0, triangle.cos_p) * way * p.east);
    c.start_direction = {way * p.east / (R * triangle.cos_p), way * p.north / R};
    c.end_direction = {way * q.east / (R * triangle.cos_q), way * q.north / R};
    c.y = way * y;
  }
  return both;
}

}  // namespace geovor
