#include "voronoi/free_end.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geodesic/closed_forms.h"
#include "geodesic/offset.h"
#include "surface/elementary_surfaces.h"
#include "surface/pole_chart.h"

namespace geovor {
namespace {

// The conjugate point is looked for up to this many lengths of the rays that approach it.
constexpr double kReach = 1.25;

// Parabolas through c(t) at three angles: the second has a quarter of the width of the first and so an error of a
// sixteenth of it; a third would reach the rounding of c.
constexpr int kParabolas = 2;
constexpr double kNarrower = 0.25;

// The minimum lies between the two rays, or not much beside.
constexpr double kBeside = 2.0;

// A derivative along a side of the domain that is this part of the one across it is zero to rounding.
constexpr double kZero = 1e-12;

/// Whether the point p of a side of the domain, which runs along u or v, is a tip within `reach` of x.
bool is_tip(const Surface& surface, Uv p, bool along_u, const Xyz& x, double reach) {
  const SurfaceJet j = surface.jet(p);
  const double along = (along_u ? j.Su : j.Sv).norm(), across = (along_u ? j.Sv : j.Su).norm();
  const auto at_pole = [&](const auto& chart) { return (chart->pole() - j.S).norm() <= reach; };
  const PoleCharts& poles = surface.poles();
  return (j.S - x).norm() <= reach && along <= kZero * across && std::none_of(poles.begin(), poles.end(), at_pole);
}

/// The tip near the end of a ray, with the parameter along the side that the ray has.
std::optional<Uv> tip_near(const Surface& surface, const SiteRay& ray, double reach) {
  if (const auto* cone = dynamic_cast<const Cone*>(&surface)) {
    if (!((cone->apex() - ray.x).norm() <= reach)) return std::nullopt;
    return Uv{ray.uv.u, cone->apex_v()};
  }
  const UvBox box = surface.domain();
  for (const bool along_u : {true, false}) {
    const Interval range = along_u ? box.v : box.u;
    for (const double side : {range.lo, range.hi}) {
      const Uv p = along_u ? Uv{ray.uv.u, side} : Uv{side, ray.uv.v};
      if (std::isfinite(side) && is_tip(surface, p, along_u, ray.x, reach)) return p;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<SiteRay> free_end(const SiteRays& rays, const SiteRay& one, const SiteRay& other) {
  const double apart = wrap_angle(other.polar.t - one.polar.t);
  double t = one.polar.t + 0.5 * apart, width = 0.5 * std::abs(apart);
  TraceOptions options;
  options.stop_at_domain = false;
  const auto conjugate_distance = [&](double angle) -> std::optional<double> {
    const auto c = first_conjugate_point(rays.surface(), rays.site(one.site), angle, kReach * one.polar.s, options);
    return c ? std::optional(c->s) : std::nullopt;
  };
  double s = 0.0;
  for (int i = 0; i < kParabolas; ++i, width *= kNarrower) {
    const auto before = conjugate_distance(t - width), here = conjugate_distance(t),
               after = conjugate_distance(t + width);
    if (!before || !here || !after) return std::nullopt;
    const double slope = 0.5 * (*after - *before), bend = *after - 2.0 * *here + *before;
    const double step = bend > 0.0 ? -slope / bend : 0.0;
    if (!(std::abs(step) < kBeside)) return std::nullopt;
    t += step * width;
    s = *here + 0.5 * slope * step;
  }
  options.tolerance = kRayTolerance;
  const TracedRay end = RaySource(rays.surface(), rays.site(one.site), &rays.curvature_map()).end(s, t, options);
  if (end.status != TraceStatus::Converged) return std::nullopt;
  const Xyz T = end.at.tangent;
  return SiteRay{one.site, {s, t}, end.at.p, end.at.S, T, end.at.normal.cross(T), 0.0};
}

// On a cone both are straight lines of its development, the tip half way between them.
std::optional<SiteRay> end_at_tip(const SiteRays& rays, const SiteRay& one, const SiteRay& other, double reach) {
  const auto tip = tip_near(rays.surface(), one, reach);
  if (!tip) return std::nullopt;
  const Xyz x = rays.surface().position(*tip), way = x - one.x;
  const Polar aim = {std::hypot(one.polar.s + one.T.dot(way), one.N.dot(way)),
                     one.polar.t + 0.5 * wrap_angle(other.polar.t - one.polar.t)};
  if (has_closed_form(rays.surface())) return SiteRay{one.site, aim, *tip, x, one.T, one.N, 0.0};
  auto end = rays.to(one.site, *tip, aim);
  if (end) end->y = 0.0;
  return end;
}

}  // namespace geovor
