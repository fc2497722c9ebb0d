#include "surface/tangent_frame.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "surface/pole_chart.h"

namespace geovor {
namespace {

// Su, Sv and Su x Sv of a map are good to rounding of the largest of the two: where one is smaller than this part of
// the other, its direction has fewer than thirteen digits left.
constexpr double kSmall = 1e-3;

// A derivative this part of the other one is zero to rounding.
constexpr double kZero = 1e-14;

TangentFrame frame_of(const Xyz& S, const Xyz& Su, const Xyz& Sv) {
  TangentFrame f;
  f.S = S;
  const Xyz n = Su.cross(Sv);
  f.n = n / n.norm();  // not normalized(): a zero vector has to become NaN, not stay zero
  f.e1 = Su / Su.norm();
  f.e2 = f.n.cross(f.e1);
  return f;
}

// On a collapsed side v = const, Su = 0 on the side and (v - v0) Suv next to it.
TangentFrame limit(const Surface& surface, Uv p, const SurfaceJet& j, bool u_collapsed) {
  const Interval range = u_collapsed ? surface.domain().v : surface.domain().u;
  const double x = u_collapsed ? p.v : p.u;
  const double inward = std::abs(x - range.hi) < std::abs(x - range.lo) ? -1.0 : 1.0;
  const Xyz along = inward * j.Suv;
  return u_collapsed ? frame_of(j.S, along, j.Sv) : frame_of(j.S, j.Su, along);
}

TangentFrame frame_in_chart(const PoleChart& chart, Uv p, const SurfaceJet& j) {
  const SurfaceJet c = chart.jet(chart.from_base(p));
  const Xyz n = c.Su.cross(c.Sv).normalized();
  const Xyz Su = chart.side().along_u ? chart.side_direction(p) : j.Su;
  TangentFrame f{c.S, (Su - n.dot(Su) * n).normalized(), {}, n};
  f.e2 = n.cross(f.e1);
  return f;
}

}  // namespace

Xyz TangentFrame::at_angle(double t) const { return std::cos(t) * e1 + std::sin(t) * e2; }
double TangentFrame::angle_of(const Xyz& w) const { return std::atan2(w.dot(e2), w.dot(e1)); }

TangentFrame tangent_frame(const Surface& surface, Uv p) {
  const SurfaceJet j = surface.jet(p);
  const double su = j.Su.norm(), sv = j.Sv.norm();
  if (std::min(su, sv) > kSmall * std::max(su, sv)) return frame_of(j.S, j.Su, j.Sv);
  for (const auto& chart : surface.poles())
    if (chart->holds(p)) return frame_in_chart(*chart, p, j);
  if (std::min(su, sv) > kZero * std::max(su, sv)) return frame_of(j.S, j.Su, j.Sv);
  return limit(surface, p, j, su < sv);
}

}  // namespace geovor
