#include "geodesic/closed_form_path.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geodesic/closed_forms.h"
#include "numeric/root.h"
#include "surface/elementary_surfaces.h"
#include "surface/forms.h"
#include "surface/pole_chart.h"

namespace geovor {
namespace {

constexpr double kPi = std::numbers::pi;

// Roots are found to the rounding of the arc length.
constexpr double kRounding = 1e-15;

// Great circles come nearest to a pole where the latitude is extreme.
void add_poles_of_sphere(const Sphere& sphere, Uv start, UvVec direction, double length,
                         std::vector<PathEvent>& events) {
  const double R = sphere.radius(), cosine = std::abs(std::cos(start.v));
  const double climb = direction.v / std::hypot(direction.u * cosine, direction.v);
  const double top = std::atan2(std::cos(start.v) < 0.0 ? -climb * cosine : climb * cosine, std::sin(start.v));
  for (double arc = top; arc * R <= length; arc += kPi) {
    if (!(arc >= 0.0)) continue;
    const Uv p = trace_closed_form(sphere, start, direction, arc * R)->end.p;
    const double chord = 2.0 * R * std::sin(0.5 * (kPi / 2.0 - std::abs(p.v)));
    for (const auto& chart : sphere.poles())
      if (chart->side().low == (p.v < 0.0) && chord <= chart->radius())
        events.push_back({PathEventKind::Pole, arc * R, p, chord});
  }
}

}  // namespace

SpaceState closed_form_at(const Surface& surface, Uv start, UvVec direction, const Xyz& T, double s) {
  const GeodesicState x = trace_closed_form(surface, start, direction, s)->end;
  if (const auto* sphere = dynamic_cast<const Sphere*>(&surface)) {
    const double R = sphere->radius(), c = std::cos(s / R), d = std::sin(s / R);
    const SurfaceJet j = surface.jet(start);
    const Xyz radial = (j.S - sphere->frame().origin) / R, out = c * radial + d * T;
    const Frame& frame = sphere->frame();
    const double side = frame.x.cross(frame.y).dot(frame.z) < 0.0 ? -1.0 : 1.0;  // Su x Sv points in on a mirrored one
    return {frame.origin + R * out, c * T - d * radial, side * out, x.y, x.dy, x.p};
  }
  const SurfaceJet j = surface.jet(x.p);
  return {j.S, push_forward(j, x.d).normalized(), unit_normal(j), x.y, x.dy, x.p};
}

std::vector<PathEvent> closed_form_events(const Surface& surface, Uv start, UvVec direction, double length) {
  std::vector<PathEvent> events;
  const auto point = [&](double s) { return trace_closed_form(surface, start, direction, s)->end.p; };
  if (const auto* sphere = dynamic_cast<const Sphere*>(&surface)) {
    for (double k = 1.0; k * kPi * sphere->radius() <= length; k += 1.0) {
      const double s = k * kPi * sphere->radius();
      events.push_back({PathEventKind::ConjugatePoint, s, point(s), 0.0});
    }
    add_poles_of_sphere(*sphere, start, direction, length, events);
  }
  if (const auto period = surface.u_period()) {  // u is monotone on all of them
    const double lo = surface.domain().u.lo;
    const double from = std::floor((start.u - lo) / *period), to = std::floor((point(length).u - lo) / *period);
    for (double k = std::min(from, to) + 1.0; k <= std::max(from, to); k += 1.0) {
      const auto beyond = [&](double s) { return point(s).u - lo - k * *period; };
      const double s = root_between(beyond, 0.0, length, kRounding * length);
      events.push_back({PathEventKind::Seam, s, point(s), 0.0});
    }
  }
  std::stable_sort(events.begin(), events.end(), [](const PathEvent& a, const PathEvent& b) { return a.s < b.s; });
  return events;
}

}  // namespace geovor
