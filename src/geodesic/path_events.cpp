#include "geodesic/path_events.h"

#include <algorithm>
#include <cmath>

#include "geodesic/pole_passage.h"
#include "geodesic/slowed_time.h"
#include "numeric/dop853.h"
#include "numeric/root.h"
#include "surface/forms.h"

namespace geovor {
namespace {

// Roots are found to the rounding of the arc length.
double root_tolerance(double s) { return 4.0 * std::numeric_limits<double>::epsilon() * s; }

// Tangent planes that differ by less are the same but for rounding.
constexpr double kCrease = 1e-9;

const Surface& map_of(const Surface& surface, const PathLeg& leg) {
  return leg.chart != nullptr ? static_cast<const Surface&>(*leg.chart) : surface;
}

// The arc length on the leg at which f(state) = 0, for different signs at its ends.
template <class F>
double root_on(const Surface& surface, const PathLeg& leg, F&& f) {
  const double end = leg.s + leg.h;
  return root_between([&](double s) { return f(state_on(surface, leg, s)); }, leg.s, end, root_tolerance(end));
}

std::optional<double> period_of(const Surface& surface, int axis) {
  return axis == 0 ? surface.u_period() : surface.v_period();
}

double lower_end(const Surface& surface, int axis) { return (axis == 0 ? surface.domain().u : surface.domain().v).lo; }

double coordinate(Uv p, int axis) { return axis == 0 ? p.u : p.v; }

bool is_seam(const Surface& surface, const Border& border) {
  constexpr double kRounding = 1e-12;
  const auto period = period_of(surface, border.axis);
  if (!period) return false;
  const double turns = (border.at - lower_end(surface, border.axis)) / *period;
  return std::abs(turns - std::round(turns)) <= kRounding * std::max(1.0, std::abs(turns));
}

// Distance in space, to first order, of the state x of a leg from a line of parameters.
double distance_to(const Surface& surface, const PathLeg& leg, const GeodesicVector& x, int axis, double at) {
  const SurfaceJet j = leg.piece.jet(surface, {x[0], x[1]});
  const double across = j.Su.cross(j.Sv).norm() / (axis == 0 ? j.Sv : j.Su).norm();
  return std::abs(at - x[axis]) * across;
}

class EventFinder {
 public:
  EventFinder(const Surface& surface, const PathRecord& record, double touch)
      : surface_(surface), record_(record), touch_(touch) {}

  std::vector<PathEvent> find() {
    add_crossings();
    for (const PathLeg& leg : record_.legs) {
      add_seams(leg);
      add_conjugate_point(leg);
      if (leg.chart != nullptr) {
        add_pole(leg);
      } else {
        add_grazes(leg);
      }
    }
    std::stable_sort(events_.begin(), events_.end(), [](const PathEvent& a, const PathEvent& b) { return a.s < b.s; });
    return std::move(events_);
  }

 private:
  const PathLeg& leg_at(double s) const {
    const auto after = std::upper_bound(record_.legs.begin(), record_.legs.end(), s,
                                        [](double value, const PathLeg& leg) { return value < leg.s; });
    return after == record_.legs.begin() ? record_.legs.front() : *(after - 1);
  }

  // Over a line and back at once is a touch.
  bool touches(const PathCrossing& a, const PathCrossing& b) const {
    if (a.border.axis != b.border.axis || a.border.at != b.border.at || a.border.side == b.border.side) return false;
    const double middle = 0.5 * (a.s + b.s);
    const PathLeg& leg = leg_at(middle);
    return distance_to(surface_, leg, state_on(surface_, leg, middle), a.border.axis, a.border.at) <= touch_;
  }

  void add_crossings() {
    const auto& all = record_.crossings;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const PathCrossing& c = all[i];
      if (i + 1 < all.size() && touches(c, all[i + 1])) {
        const PathEventKind kind = PathEventKind::KnotLineGrazed;
        events_.push_back({kind, 0.5 * (c.s + all[i + 1].s), lerp(c.p, all[i + 1].p, 0.5), 0.0});
        ++i;
        continue;
      }
      const bool seam = is_seam(surface_, c.border), crease = c.bend > kCrease;
      if (seam) events_.push_back({PathEventKind::Seam, c.s, c.p, 0.0});
      if (crease) events_.push_back({PathEventKind::Crease, c.s, c.p, 0.0});
      if (!seam && !crease) events_.push_back({PathEventKind::KnotLine, c.s, c.p, 0.0});
    }
  }

  // A seam that is no line between pieces (on a torus, or in the chart of a pole).
  void add_seams(const PathLeg& leg) {
    const Uv end = point_on(surface_, leg, leg.end);
    for (int axis = 0; axis < 2; ++axis) {
      const auto period = period_of(surface_, axis);
      if (!period || (leg.chart == nullptr && std::isfinite(leg.piece.range(axis).hi))) continue;
      const double lo = lower_end(surface_, axis);
      const double from = std::floor((coordinate(leg.start, axis) - lo) / *period);
      const double to = std::floor((coordinate(end, axis) - lo) / *period);
      for (double k = std::min(from, to) + 1.0; k <= std::max(from, to); k += 1.0) {
        const double line = lo + k * *period;
        const double s = root_on(surface_, leg, [&](const GeodesicVector& x) {
          return coordinate(point_on(surface_, leg, x), axis) - line;
        });
        events_.push_back({PathEventKind::Seam, s, point_on(surface_, leg, state_on(surface_, leg, s)), 0.0});
      }
    }
  }

  void add_conjugate_point(const PathLeg& leg) {
    const double s = conjugate_point_on(surface_, leg);
    if (s >= 0.0)
      events_.push_back({PathEventKind::ConjugatePoint, s, point_on(surface_, leg, state_on(surface_, leg, s)), 0.0});
  }

  void add_pole(const PathLeg& leg) {
    const auto outwards = [](const GeodesicVector& x) { return x[0] * x[2] + x[1] * x[3]; };
    const double before = outwards(leg.x);
    const bool starts_there = before == 0.0 && leg.x.head<2>().isZero(0.0) && leg.s == 0.0;
    if (!starts_there && !(before < 0.0 && outwards(leg.end) >= 0.0)) return;
    const double s = starts_there ? 0.0 : root_on(surface_, leg, outwards);
    const GeodesicVector x = state_on(surface_, leg, s);
    const double height = (leg.chart->jet({x[0], x[1]}).S - leg.chart->pole()).dot(leg.chart->frame().z);
    const double distance = std::hypot(x[0], x[1], x.head<2>().isZero(0.0) ? 0.0 : height);
    events_.push_back({PathEventKind::Pole, s, point_on(surface_, leg, x), distance});
  }

  // The path runs towards a line of knots and turns before it.
  void add_grazes(const PathLeg& leg) {
    for (int axis = 0; axis < 2; ++axis)
      for (const int side : {-1, 1}) {
        const Interval range = leg.piece.range(axis);
        const double at = side > 0 ? range.hi : range.lo;
        if (!std::isfinite(at) || leg.piece.ends_domain({axis, side, at})) continue;
        const double gap = side * (at - leg.x[axis]), speed = side * leg.x[axis + 2];
        if (!(speed > 0.0 && side * leg.end[axis + 2] < 0.0 && gap <= speed * leg.h)) continue;
        const double s = root_on(surface_, leg, [&](const GeodesicVector& x) { return x[axis + 2]; });
        const GeodesicVector x = state_on(surface_, leg, s);
        if (distance_to(surface_, leg, x, axis, at) <= touch_)
          events_.push_back({PathEventKind::KnotLineGrazed, s, {x[0], x[1]}, 0.0});
      }
  }

  const Surface& surface_;
  const PathRecord& record_;
  double touch_;
  std::vector<PathEvent> events_;
};

}  // namespace

GeodesicVector state_on(const Surface& surface, const PathLeg& leg, double s) {
  const double h = std::min(s - leg.s, leg.h);
  if (!(h > 0.0)) return leg.x;
  if (h == leg.h) return leg.end;
  const Surface& map = map_of(surface, leg);
  Xyz normal;
  if (leg.slowed_time > 0.0) {
    const SurfaceJet j = leg.piece.jet(map, {leg.x[0], leg.x[1]});
    SlowedStep step(map, leg.piece, leg.x, leg.slope, j.Su.cross(j.Sv), metric_rate(j, leg.x[2], leg.x[3]));
    step.run_to(h, leg.slowed_time * h / leg.h);
    return step.end();
  }
  return dop853::step(leg.x, leg.slope, h,
                      [&](const GeodesicVector& x) {
                        return geodesic_slope(leg.piece.jet(map, {x[0], x[1]}), x, normal);
                      })
      .state;
}

Uv point_on(const Surface& surface, const PathLeg& leg, const GeodesicVector& x) {
  return leg.chart != nullptr ? unwound(surface, *leg.chart, leg.x, leg.start, x) : Uv{x[0], x[1]};
}

SpaceState space_state(const Surface& surface, const PathLeg& leg, double s) {
  const GeodesicVector x = state_on(surface, leg, s);
  const SurfaceJet j = leg.piece.jet(map_of(surface, leg), {x[0], x[1]});
  return {j.S, push_forward(j, {x[2], x[3]}).normalized(), unit_normal(j), x[4], x[5], point_on(surface, leg, x)};
}

// Conjugate points lie a step apart at least: y bends by K y only.
double conjugate_point_on(const Surface& surface, const PathLeg& leg) {
  if (!((leg.x[4] > 0.0 && leg.end[4] <= 0.0) || (leg.x[4] < 0.0 && leg.end[4] >= 0.0))) return -1.0;
  return root_on(surface, leg, [](const GeodesicVector& x) { return x[4]; });
}

std::vector<PathEvent> find_events(const Surface& surface, const PathRecord& record, double touch) {
  return EventFinder(surface, record, touch).find();
}

}  // namespace geovor
