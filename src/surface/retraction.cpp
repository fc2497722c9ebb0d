#include "surface/retraction.h"

#include <cmath>
#include <limits>

namespace geovor {
namespace {

// From this power on a line counts as one that stops at the end of the box. It is 1 on a line of even speed, 2 and more
// on one that stops smoothly.
constexpr double kPower = 1.4;
// Powers above this are rounding.
constexpr double kMostPower = 12.0;
// Steps that change the length from the end by less than this share may be straight: the error is of second order.
constexpr double kShort = 1e-2;
// A step that is this long, in distances from a pole, is made in polar coordinates.
constexpr double kPolar = 0.1;
constexpr double kTurn = 0.25;

struct Moved {
  double x;
  bool blocked = false;
};

// The end at which the line stops, if it does: |Su| ~ t^(power - 1).
struct Stop {
  double sign, t, power;
  bool stops() const { return power > kPower && std::isfinite(t); }
};

Stop stop(double x, const LineSpeed& s, const Interval& box) {
  const double sign = s.own >= 0.0 ? 1.0 : -1.0;
  const double t = sign > 0.0 ? x - box.lo : box.hi - x;
  return {sign, t, std::fmin(1.0 + std::abs(s.own) * t, kMostPower)};
}

Moved along_line(double x, double way, const LineSpeed& s, const Interval& box, double turn) {
  if (way == 0.0) return {x};
  const double straight = way / s.h;
  const Stop end = stop(x, s, box);
  if (!end.stops() || std::abs(straight) * end.power < kShort * end.t)
    return {box.clamp(x + std::clamp(straight, -kTurn * turn, kTurn * turn))};
  const double part = 1.0 + end.power * end.sign * straight / end.t;
  const double to = end.t * std::pow(std::fmax(part, kApproach), 1.0 / end.power);
  return {box.clamp(end.sign > 0.0 ? box.lo + to : box.hi - to), part < kApproach};
}

// The lines of `a` shrink towards a pole along `b`: the ways along both as polar ones, that along `a` as the length of
// an arc at today's distance.
void bend(double& a_way, double& b_way, const LineSpeed& a, const LineSpeed& b) {
  if (!(std::abs(a.across) * std::fmax(std::abs(a_way), std::abs(b_way)) > kPolar * b.h)) return;
  const double radius = b.h / a.across;  // negative where the pole lies ahead
  const double r = std::abs(radius), away = radius > 0.0 ? 1.0 : -1.0;
  const double along = r + away * b_way;
  b_way = away * (std::hypot(a_way, along) - r);
  a_way = std::atan2(a_way, along) * r;
}

}  // namespace

double length_from_stop(double x, const LineSpeed& s, const Interval& box) {
  const Stop end = stop(x, s, box);
  return end.stops() ? s.h * end.t / end.power : std::numeric_limits<double>::infinity();
}

Retraction retract(Uv p, double u_way, double v_way, const LineSpeed& u, const LineSpeed& v, const UvBox& box,
                   UvVec turn) {
  bend(u_way, v_way, u, v);
  bend(v_way, u_way, v, u);
  const Moved a = along_line(p.u, u_way, u, box.u, turn.u), b = along_line(p.v, v_way, v, box.v, turn.v);
  return {{a.x, b.x}, a.blocked, b.blocked};
}

}  // namespace geovor
