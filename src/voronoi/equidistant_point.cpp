#include "voronoi/equidistant_point.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "surface/forms.h"
#include "surface/pole_chart.h"
#include "voronoi/shot_ladder.h"

namespace geovor {
namespace {

// Newton from a rough guess takes three or four rounds; the rest is for wide triangles on curved places.
constexpr int kMostRounds = 20;

// A step longer than this part of the radius, or one that turns a ray by more (radians), means nothing any more.
constexpr double kLongestStep = 0.5;
constexpr double kMostTurn = 0.5;

// Up to this miss the rays' second order is worth more than their first.
constexpr double kSecondOrder = 0.3;

// Corrections on the surface without new traces. From the first on they fall by squares; one that is shorter than
// kLastStep of the radius leaves nothing.
constexpr int kMostCorrections = 4;
constexpr double kLastStep = 1e-8;

// Rays that are not traced to all digits tell nothing where their errors may shift the point by more than this part of
// what it is measured by.
constexpr double kMostDoubt = 0.01;

struct Target {
  Xyz m;
  double radius;
};

/// One round of an iteration: the rays traced to their aims.
class Round {
 public:
  Round(const SiteRays& rays, const SectionPlane* plane) : rays_(rays), plane_(plane) {}

  bool shoot(std::span<const PolarGuess> aims, double radius, double tolerance) {
    met_ = 0.0;
    for (const PolarGuess& aim : aims) {
      const auto shot = rays_.shoot(aim.site, {radius, aim.angle}, tolerance);
      if (!shot) return false;
      if (found_.count == 0) jet_ = shot->jet;
      met_ = std::max(met_, std::min(shot->tolerance, tolerance));
      found_.rays[found_.count++] = shot->ray;
    }
    return true;
  }

  /// The largest distance between the ends, and from the plane.
  double gap() const {
    double gap = plane_ != nullptr ? std::abs(plane_->normal.dot(first().x) - plane_->offset) : 0.0;
    for (int i = 1; i < found_.count; ++i)
      for (int k = 0; k < i; ++k) gap = std::max(gap, (found_.rays[i].x - found_.rays[k].x).norm());
    return gap;
  }

  /// What a gap is measured by: geodesics that come together tell little of their angles, two of one site less the
  /// smaller the angle between them.
  double scale() const {
    double scale = first().polar.s;
    for (int i = 0; i < found_.count; ++i) scale = std::min(scale, std::abs(found_.rays[i].y));
    if (found_.count == 2 && first().site == found_.rays[1].site)
      scale *= std::min(1.0, std::abs(wrap_angle(first().polar.t - found_.rays[1].polar.t)));
    return scale;
  }

  /// By what part of the scale errors of the rays may shift the point where two of nearly one direction meet.
  double doubt() const {
    if (found_.count != 2) return 0.0;
    return met_ * first().polar.s / (scale() * (first().T - found_.rays[1].T).norm());
  }

  /// Linear conditions on m = x + a T + b N in the first ray's tangent plane and on rho: rho = s_i + <T_i, m - x_i>.
  static std::optional<Target> meet(const MeetingRays& found, const SectionPlane* plane) {
    const SiteRay& frame = found.rays[0];
    Eigen::Matrix3d rows;
    Eigen::Vector3d right;
    int row = 0;
    for (; row < found.count; ++row) {
      const SiteRay& r = found.rays[row];
      rows.row(row) << r.T.dot(frame.T), r.T.dot(frame.N), -1.0;
      right(row) = r.T.dot(r.x - frame.x) - r.polar.s;
    }
    if (plane != nullptr) {
      rows.row(row) << plane->normal.dot(frame.T), plane->normal.dot(frame.N), 0.0;
      right(row) = plane->offset - plane->normal.dot(frame.x);
    }
    const Eigen::Vector3d z = rows.inverse() * right;
    if (!z.allFinite()) return std::nullopt;
    return Target{frame.x + z(0) * frame.T + z(1) * frame.N, z(2)};
  }

  /// Newton's iteration for the point of the surface where the rays' second orders agree. False if it does not settle
  /// near by, or if there are no coordinates.
  bool settle() {
    MeetingRays here = found_;
    SurfaceJet j = jet_;
    Uv uv = first().uv;
    for (int i = 0; i < kMostCorrections; ++i) {
      const auto target = meet(here, plane_);
      if (!target) return false;
      const Xyz step = target->m - here.rays[0].x;
      const double length = step.norm();
      if (!(length <= kLongestStep * here.rays[0].polar.s)) return false;
      const UvVec d = tangent_components(j, step);
      if (!is_finite(d)) return false;
      if (i > 0 && length * length <= kLastStep * kLastStep * target->radius * straight(here.rays[0])) {
        end_ = arrived(here, *target, d);
        return true;
      }
      uv = uv + d;
      j = rays_.surface().jet(uv);
      for (int k = 0; k < here.count; ++k) here.rays[k] = moved(found_.rays[k], found_.rays[k].uv, j);
      if (!here.rays[0].x.allFinite()) return false;
      here.rays[0].uv = uv;
    }
    return false;
  }

  const MeetingRays& found() const { return found_; }
  const MeetingRays& end() const { return end_; }
  const SiteRay& first() const { return found_.rays[0]; }
  double tolerance_met() const { return met_; }

 private:
  /// What the length of a step is measured by for which parameters move in proportion: beside a pole the way to it.
  double straight(const SiteRay& ray) const {
    double way = ray.polar.s;
    for (const auto& chart : rays_.surface().poles()) way = std::min(way, (ray.x - chart->pole()).norm());
    return way;
  }

  // Rays that go round a closed surface end in their own copies of the point. Their frames turn with the last step too:
  // by up to kLastStep, which edges between stored points, cubics by their slopes, would show.
  MeetingRays arrived(const MeetingRays& here, const Target& target, UvVec d) const {
    MeetingRays end = here;
    const Uv uv = here.rays[0].uv + d;
    for (int k = 0; k < end.count; ++k) {
      SiteRay& r = end.rays[k];
      const Xyz way = target.m - r.x;
      const double turn = r.N.dot(way) / r.y;
      const Xyz T = r.T;
      r.polar = {target.radius, r.polar.t + turn};
      r.y += T.dot(way) * r.dy;
      r.T += turn * r.dy * r.N;
      r.N -= turn * r.dy * T;
      r.uv = k == 0 ? uv : found_.rays[k].uv + nearest_copy(rays_.surface(), found_.rays[k].uv, uv);
      r.x = target.m;
    }
    return end;
  }

  const SiteRays& rays_;
  const SectionPlane* plane_;
  MeetingRays found_, end_;
  SurfaceJet jet_;
  double met_ = 0.0;
};

using Aims = std::array<PolarGuess, 3>;

// To first order, shortened to what first order is good for.
bool linear_step(const Round& round, const SectionPlane* plane, Aims& aims, double& radius) {
  const auto target = Round::meet(round.found(), plane);
  if (!target) return false;
  const int count = round.found().count;
  std::array<double, 3> turn{};
  double most =
      std::max((target->m - round.first().x).norm(), std::abs(target->radius - radius)) / (kLongestStep * radius);
  for (int i = 0; i < count; ++i) {
    turn[i] = carry(round.found().rays[i], target->m).t - aims[i].angle;
    most = std::max(most, std::abs(turn[i]) / kMostTurn);
  }
  const double k = most > 1.0 ? 1.0 / most : 1.0;
  for (int i = 0; i < count; ++i) aims[i].angle += k * turn[i];
  radius += k * (target->radius - radius);
  return std::isfinite(radius);
}

}  // namespace

std::optional<MeetingRays> find_equidistant(const SiteRays& rays, std::span<const PolarGuess> first_aims, double radius,
                                            const SectionPlane* plane, double miss) {
  Aims aims;
  std::copy(first_aims.begin(), first_aims.end(), aims.begin());
  const std::span<const PolarGuess> used(aims.data(), first_aims.size());
  bool all_digits = false;
  for (int i = 0; i < kMostRounds; ++i) {
    const ShotLadder ladder(rays.curvature() * radius, kRayTolerance);
    Round round(rays, plane);
    if (!round.shoot(used, radius, all_digits ? ladder.tolerance() : ladder.tolerance_for(miss))) return std::nullopt;
    const double gap = round.gap(), relative = gap / round.scale();
    const bool exact = round.tolerance_met() <= ladder.tolerance();
    if (!exact && !(round.doubt() <= kMostDoubt)) {
      all_digits = true;
      continue;
    }
    const bool settled = relative <= kSecondOrder && round.settle();
    if (exact && settled && (relative <= ladder.made_good() || gap <= kRayTolerance * radius)) return round.end();
    if (exact && !settled && gap <= kMeetingTolerance * radius) return round.found();
    if (settled) {
      radius = round.end().rays[0].polar.s;
      for (size_t k = 0; k < used.size(); ++k) aims[k].angle = round.end().rays[k].polar.t;
    } else if (!linear_step(round, plane, aims, radius)) {
      return std::nullopt;
    }
    miss = ladder.after(std::min(relative, 1.0));
  }
  return std::nullopt;
}

}  // namespace geovor
