#include "geodesic/pole_passage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "surface/forms.h"

namespace geovor {
namespace {

// A path that is this near, in chart radii, to the place nearest to the pole need not stop there once more.
constexpr double kNearest = 1e-4;

// Where the point on the side that a path starts from or ends in is asked for: so near to the pole, in chart radii (in
// lengths of the domain), that the lines of the parameters are straight.
constexpr double kBesidePole = 1e-7;

UvVec position(const GeodesicVector& x) { return {x[0], x[1]}; }
UvVec heading(const GeodesicVector& x) { return {x[2], x[3]}; }
double dot(UvVec a, UvVec b) { return a.u * b.u + a.v * b.v; }
double size(UvVec a) { return std::hypot(a.u, a.v); }

// The chart is right-handed about the surface's own normal. About it the parameter along the side runs clockwise at the
// low end of v and at the high end of u.
double sense(const PoleSide& side) { return side.along_u == side.low ? -1.0 : 1.0; }

// The angle at the pole from the path's start to its end. Half a turn may go either way: which one tells the path's
// moment about the pole, to the last bit where it passes close.
double turn(UvVec from, UvVec to, double moment) {
  constexpr double kEitherWay = 2.0;
  const double angle = std::atan2(cross(from, to), dot(from, to));
  const bool wrong_way = std::abs(angle) > kEitherWay && moment != 0.0 && (moment > 0.0) != (angle > 0.0);
  return wrong_way ? angle + std::copysign(2.0 * std::numbers::pi, moment) : angle;
}

UvVec beside_pole(const Surface& surface, const PoleChart& chart, Uv p) {
  const UvBox domain = surface.domain();
  const PoleSide& side = chart.side();
  const double depth = kBesidePole * (side.along_u ? domain.v : domain.u).length();
  const Uv ab = chart.from_base(side.point(side.along(p), depth));
  return {ab.u, ab.v};
}

}  // namespace

bool enters_chart(const PoleChart& chart, Uv p, const Xyz& S) {
  if (!((S - chart.pole()).norm() <= chart.radius()) || !chart.holds(p)) return false;
  const Uv ab = chart.from_base(p);
  return std::hypot(ab.u, ab.v) <= kEnterChart * chart.radius();
}

bool leaves_chart(const PoleChart& chart, const GeodesicVector& x) {
  return size(position(x)) > kLeaveChart * chart.radius() && dot(position(x), heading(x)) > 0.0;
}

// Distances in space are below those on the chart, and no point of a path is nearer to the pole than its distance from
// there less its length.
double room_before_pole(const PoleChart& chart, const Xyz& S, const Xyz& T) {
  constexpr double kDeep = 0.5;
  const Xyz way = chart.pole() - S;
  if (!(way.dot(T) > 0.0)) return std::numeric_limits<double>::infinity();
  return std::max(way.norm() - kDeep * kEnterChart * chart.radius(), kDeep * kEnterChart * chart.radius());
}

double room_on_chart(const PoleChart& chart, const GeodesicVector& x) {
  const UvVec p = position(x), d = heading(x);
  const double r = chart.radius(), along = dot(p, d), d2 = dot(d, d);
  const double nearest = -along / d2;
  if (nearest > kNearest * r) return nearest;
  const double inside = r * r - dot(p, p);
  return nearest + std::sqrt(along * along + d2 * std::max(inside, 0.0)) / d2;
}

Uv unwound(const Surface& surface, const PoleChart& chart, const GeodesicVector& x, Uv from, const GeodesicVector& to) {
  const PoleSide& side = chart.side();
  const bool at_pole = size(position(to)) == 0.0;
  const double back = kBesidePole * chart.radius();
  const UvVec there = at_pole ? -back * heading(to) : position(to);
  Uv p = chart.to_base({there.u, there.v});
  if (at_pole) p = side.point(side.along(p), 0.0);
  const auto period = side.along_u ? surface.u_period() : surface.v_period();
  if (!period) return p;
  const UvVec here = size(position(x)) == 0.0 ? beside_pole(surface, chart, from) : position(x);
  const double angle = turn(here, there, cross(position(x), heading(x)));
  const double expected = side.along(from) + sense(side) * angle * *period / (2.0 * std::numbers::pi);
  const double shift = *period * std::round((expected - side.along(p)) / *period);
  return side.along_u ? Uv{p.u + shift, p.v} : Uv{p.u, p.v + shift};
}

// Far outside of the wedge to_base knows nothing, but there the angle at the pole tells.
double beyond_wedge(const Surface& surface, const PoleChart& chart, Uv ab) {
  constexpr double kClose = 0.2;  // of an angle to the wedge's sides, whose images are curved
  constexpr double kRounding = 1e-14;
  const PoleSide& side = chart.side();
  if (side.along_u ? surface.u_period() : surface.v_period()) return -1.0;
  if (ab == Uv{0.0, 0.0}) return -kRounding;
  const Interval range = side.along_u ? surface.domain().u : surface.domain().v;
  const auto ray = [&](double along) { return beside_pole(surface, chart, side.point(along, 0.0)); };
  const UvVec middle = ray(range.middle());
  const auto angle = [&](UvVec d) { return std::atan2(cross(middle, d), dot(middle, d)); };
  const double at = angle({ab.u, ab.v}), lo = angle(ray(range.lo)), hi = angle(ray(range.hi));
  const double excess = std::abs(at) - std::abs(at * hi > 0.0 ? hi : lo);
  if (std::abs(excess) > kClose) return excess;
  const double along = side.along(chart.to_base(ab));
  return std::max(range.lo - along, along - range.hi) / range.length() - kRounding;
}

UvVec direction_near_pole(const Surface& surface, const PoleChart& chart, Uv p, const Xyz& T) {
  const SurfaceJet j = surface.jet(p);
  const UvVec d = tangent_components(j, T);
  const bool at_pole = chart.side().depth(p) == 0.0;
  if (is_finite(d) && !at_pole) return d;
  const Xyz& inwards = chart.side().along_u ? j.Sv : j.Su;
  const double speed = T.dot(inwards) / inwards.squaredNorm();
  if (!std::isfinite(speed)) return {};
  return chart.side().along_u ? UvVec{0.0, speed} : UvVec{speed, 0.0};
}

}  // namespace geovor
