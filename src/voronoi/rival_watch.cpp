#include "voronoi/rival_watch.h"

#include <algorithm>
#include <cmath>

namespace geovor {
namespace {

// Two rays to one point are the same if they agree to this part of the reach; the rougher ones do to kRoughly of their
// length.
constexpr double kSameRay = 1e-3;

// A gap, as a part of the radius, far above the error of a rough ray.
constexpr double kClearlyFarther = 1e-4;

// Chords are shorter than the way along the edge; their difference is far below this part.
constexpr double kChordSlack = 1.02;

}  // namespace

double cubic_minimum(double g0, double s0, double g1, double s1, double h) {
  constexpr int kSamples = 8;
  double least = std::min(g0, g1);
  for (int i = 1; i < kSamples; ++i) {
    const double t = static_cast<double>(i) / kSamples, r = 1.0 - t;
    const double value = r * r * (1 + 2 * t) * g0 + t * t * (3 - 2 * t) * g1 + h * t * r * (r * s0 - t * s1);
    least = std::min(least, value);
  }
  return least;
}

RivalWatch::RivalWatch(const CandidateLabels& labels, const BisectorPoint& start) : labels_(labels), last_(start) {
  enlist(start);
}

RivalWatch::Rival RivalWatch::measure(const SiteRay& ray, const BisectorPoint& m, double at) const {
  return {ray, ray.polar.s - m.radius(), ray.T.dot(m.tangent()) - bisector_slope(m).radius, at};
}

// Whether a candidate at a corner is a geodesic that is watched already, told from polar coordinates carried to the
// last accepted point; a doubt costs one more connection.
bool RivalWatch::known(const SiteRay& candidate, double slack) const {
  const Polar here = carry(candidate, last_.position());
  const auto same = [&](const SiteRay& ray) {
    if (ray.site != candidate.site) return false;
    const Polar there = carry(ray, last_.position());
    return std::abs(here.s - there.s) + std::abs(ray.y * wrap_angle(here.t - there.t)) < slack;
  };
  return same(last_.left) || same(last_.right) ||
         std::any_of(rivals_.begin(), rivals_.end(), [&](const Rival& r) { return same(r.ray); });
}

// New candidates come with the corners of the lattice cell around m; they are measured at the last accepted point, so
// that every rival has a value from before the step.
void RivalWatch::enlist(const BisectorPoint& m) {
  for (int corner : labels_.lattice().corners(m.left.uv)) {
    if (std::find(corners_seen_.begin(), corners_seen_.end(), corner) != corners_seen_.end()) continue;
    corners_seen_.push_back(corner);
    for (const SiteRay& candidate : labels_.at(corner)) {
      if (known(candidate, kSameGuess * labels_.lattice().reach(corner))) continue;
      const auto ray = ray_to(candidate.site, last_, carry(candidate, last_.position()));
      if (ray && !known(*ray, kSameRay * labels_.lattice().reach(corner))) {
        rivals_.push_back(measure(*ray, last_, travelled_));
      }
    }
  }
}

// The gap of a rival that is clearly farther off needs no more digits than a guess has.
std::optional<SiteRay> RivalWatch::ray_to(int site, const BisectorPoint& m, const Polar& guess) const {
  const auto ray = labels_.rays().roughly_to(site, m.left.uv, guess);
  if (!ray || ray->polar.s - m.radius() > kClearlyFarther * m.radius()) return ray;
  return labels_.rays().to(site, m.left.uv, ray->polar);
}

RivalVerdict RivalWatch::look(const BisectorPoint& next) {
  enlist(next);
  looked_at_ = rivals_;
  const double step = (next.position() - last_.position()).norm();
  const double now = travelled_ + step;
  const double noise = kDistanceNoise * next.radius();
  RivalVerdict verdict;
  for (Rival& rival : looked_at_) {
    const double way = now - rival.at;
    if (rival.gap > 2.0 * kChordSlack * way) continue;
    const auto ray = ray_to(rival.ray.site, next, carry(rival.ray, next.position()));
    if (!ray || same_generator(*ray, next.left) || same_generator(*ray, next.right)) continue;
    const Rival before = rival;
    rival = measure(*ray, next, now);
    if (rival.gap < -noise) {
      const double zero = before.at + way * std::max(before.gap, 0.0) / (std::max(before.gap, 0.0) - rival.gap);
      const double fraction = step > 0.0 ? std::clamp((zero - travelled_) / step, 0.0, 1.0) : 0.0;
      if (verdict.kind != RivalVerdict::Nearer || fraction < verdict.fraction) {
        verdict = {RivalVerdict::Nearer, *ray, fraction};
      }
    } else if (verdict.kind == RivalVerdict::Clear && rival.slope > 0.0 && before.slope < 0.0 &&
               cubic_minimum(before.gap, before.slope, rival.gap, rival.slope, way) < -noise) {
      verdict = {RivalVerdict::Unsure, *ray, 0.5};
    }
  }
  return verdict;
}

void RivalWatch::accept(const BisectorPoint& next) {
  travelled_ += (next.position() - last_.position()).norm();
  rivals_ = looked_at_;
  last_ = next;
}

}  // namespace geovor
