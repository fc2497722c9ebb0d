#include "geodesic/closed_forms.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "geodesic/angle_difference.h"
#include "geodesic/cone_development.h"
#include "geodesic/great_circle.h"
#include "surface/elementary_surfaces.h"
#include "surface/forms.h"

namespace geovor {
namespace {

constexpr double kFullTurn = 2.0 * std::numbers::pi;

// The kind is asked first: a cast that fails costs as much as several jets. A surface under other parameters is of its
// base's kind, but not of its class.
template <class S>
const S* as(SurfaceKind kind, const Surface& surface) {
  return surface.kind() == kind ? dynamic_cast<const S*>(&surface) : nullptr;
}

const Sphere* as_sphere(const Surface& surface) { return as<Sphere>(SurfaceKind::Sphere, surface); }

const Cone* as_cone(const Surface& surface) { return as<Cone>(SurfaceKind::Cone, surface); }

// Plane and cylinder: E, F and G are constants.
bool is_flat(const Surface& surface) {
  return as<Plane>(SurfaceKind::Plane, surface) != nullptr || as<Cylinder>(SurfaceKind::Cylinder, surface) != nullptr;
}

double turn(double s, double t, double s_guess, double t_guess) {
  return std::hypot(s * std::cos(t) - s_guess * std::cos(t_guess), s * std::sin(t) - s_guess * std::sin(t_guess));
}

TraceResult trace_flat(const Surface& surface, Uv start, UvVec direction, double length) {
  const double size = norm(surface.jet(start), direction);
  if (!(size > 0.0)) return {TraceStatus::DegenerateMetric, {start, {}, 0.0, 1.0}, 0.0, 0, 1};
  const UvVec d = (1.0 / size) * direction;
  return {TraceStatus::Converged, {start + length * d, d, length, 1.0}, length, 0, 1};
}

Connection connect_flat(const SurfaceJet& j, UvVec way, double fallback_angle) {
  const double length = norm(j, way);
  Connection c;
  c.status = ConnectStatus::Converged;
  c.length = c.y = length;
  c.angle = length > 0.0 ? angle_of_direction(j, way) : fallback_angle;
  c.start_direction = c.end_direction = length > 0.0 ? (1.0 / length) * way : direction_at_angle(j, c.angle);
  return c;
}

// The way to the copy of `to` whose u is nearest to from.u + near.
UvVec flat_way(const Surface& surface, Uv from, Uv to, double near) {
  return {surface.u_period() ? nearest_turn(from.u, to.u, near) : to.u - from.u, to.v - from.v};
}

// On cylinder or cone: the geodesic that turns by about `near`, and perhaps others.
std::vector<Connection> wound(const Surface& surface, Uv from, Uv to, double near) {
  if (const Cone* cone = as_cone(surface)) return connect_cone(*cone, from, to, near);
  return {connect_flat(surface.jet(from), flat_way(surface, from, to, near), 0.0)};
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
    const UvVec towards = guess ? direction_at_angle(cone->jet(from), guess->t) : UvVec{};
    const double turn = guess && is_finite(towards) ? trace_cone(*cone, from, towards, guess->s).end.p.u - from.u : 0.0;
    const auto all = connect_cone(*cone, from, to, turn);
    return all.empty() ? Connection{} : all.front();
  }
  if (!is_flat(surface)) return std::nullopt;
  const SurfaceJet j = surface.jet(from);
  const double guessed_u = guess ? guess->s * direction_at_angle(j, guess->t).u : 0.0;
  return connect_flat(j, flat_way(surface, from, to, guessed_u), fallback_angle);
}

std::optional<std::vector<Connection>> connections_closed_form(const Surface& surface, Uv from, Uv to) {
  if (const Sphere* sphere = as_sphere(surface)) return connect_sphere(*sphere, from, to, 0.0);
  if (const Cone* cone = as_cone(surface)) return connect_cone(*cone, from, to, 0.0);
  if (!is_flat(surface)) return std::nullopt;
  const SurfaceJet j = surface.jet(from);
  const UvVec way = flat_way(surface, from, to, 0.0);
  std::vector<Connection> all{connect_flat(j, way, 0.0)};
  if (surface.u_period()) all.push_back(connect_flat(j, {other_way_round(from.u, to.u, way.u), way.v}, 0.0));
  return all;
}

// One more turn each way, until both ways are too long or nothing new (a cone's tip is reached without turning).
std::vector<Connection> geodesics_closed_form(const Surface& surface, Uv from, Uv to, double limit) {
  std::vector<Connection> all = connections_closed_form(surface, from, to).value_or(std::vector<Connection>{});
  std::erase_if(all, [limit](const Connection& c) { return !(c.length < limit); });
  const auto add = [&](const Connection& c) {
    const auto same = [&c](const Connection& a) { return a.length == c.length && a.angle == c.angle; };
    const bool is_new = c.length < limit && std::none_of(all.begin(), all.end(), same);
    if (is_new) all.push_back(c);
    return is_new;
  };
  bool winds = surface.u_period() && as_sphere(surface) == nullptr && std::isfinite(limit);
  for (int turns = 1; winds; ++turns) {
    winds = false;
    for (const double near : {turns * kFullTurn, -turns * kFullTurn})
      for (const Connection& c : wound(surface, from, to, near)) winds = add(c) || winds;
  }
  std::sort(all.begin(), all.end(), [](const Connection& a, const Connection& b) {
    return std::tie(a.length, a.angle) < std::tie(b.length, b.angle);
  });
  return all;
}

}  // namespace geovor
