#include "voronoi/free_end.h"

#include <Eigen/Geometry>
#include <cmath>

#include "geodesic/offset.h"

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

}  // namespace geovor
