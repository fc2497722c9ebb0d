#include "delaunay/border_curvature.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "surface/forms.h"

namespace geovor {
namespace {

// Below this share of its mean length a derivative says little about the way into the face.
constexpr double kWeak = 1e-2;
// The first try of the search along the parameters, in parts of the box.
constexpr double kFirstTry = 1e-4;
// Newton's method from a guess that is right to this part needs no more than a handful of steps.
constexpr double kGuess = 1e-2;
constexpr int kMostSteps = 12;
// So near to d, in parts of it, the curvature is the same far beyond the steps in which sizes are taken.
constexpr double kSettled = 1e-10;

// One step of d straight into the face, as the derivatives at the border tell.
std::optional<Uv> by_derivatives(const SurfaceProbe& probe, const BesidePlace& at, double d) {
  const SurfaceJet j = probe.surface().jet(at.p);
  if (!(j.Su.norm() > kWeak * probe.u_speed() && j.Sv.norm() > kWeak * probe.v_speed())) return std::nullopt;
  Xyz across = push_forward(j, at.inward);
  across -= at.tangent * at.tangent.dot(across);
  const UvVec step = tangent_components(j, across.normalized());
  return at.p + d * step;
}

// Along the parameters until the distance is d; the directions of the box's sides count alike.
std::optional<Uv> by_search(const SurfaceProbe& probe, const BesidePlace& at, double d) {
  const double u = probe.box().u.length(), v = probe.box().v.length();
  const double scale = 1.0 / std::hypot(at.inward.u / u, at.inward.v / v);
  const auto place = [&](double part) { return at.p + (scale * part) * at.inward; };
  const auto distance = [&](double part) { return (probe.position(place(part)) - at.x).norm(); };
  if (!(distance(0.0) < d)) return std::nullopt;
  double lo = 0.0, hi = kFirstTry;
  for (; distance(hi) < d; hi = std::min(1.0, 2.0 * hi)) {
    if (hi == 1.0) return std::nullopt;
    lo = hi;
  }
  while (hi - lo > kGuess * hi) {
    const double middle = 0.5 * (lo + hi);
    (distance(middle) < d ? lo : hi) = middle;
  }
  return place(0.5 * (lo + hi));
}

// (S - x) . tangent = 0 and |S - x| = d by Newton's method.
std::optional<Curvatures> settle(const SurfaceProbe& probe, const BesidePlace& at, double d, Uv p) {
  for (int k = 0; k < kMostSteps; ++k) {
    const SurfaceJet j = probe.surface().jet(p);
    const Xyz r = j.S - at.x;
    const double along = r.dot(at.tangent), off = 0.5 * (r.squaredNorm() - d * d);
    if (std::abs(along) <= kSettled * d && std::abs(off) <= kSettled * d * d) return curvatures(j);
    const double a = j.Su.dot(at.tangent), b = j.Sv.dot(at.tangent), c = j.Su.dot(r), e = j.Sv.dot(r);
    const double det = a * e - b * c;
    p = p + -UvVec{(along * e - b * off) / det, (a * off - along * c) / det};
    if (!(std::abs(p.u - at.p.u) < probe.box().u.length() && std::abs(p.v - at.p.v) < probe.box().v.length())) break;
  }
  return std::nullopt;
}

}  // namespace

double curvature_beside(const SurfaceProbe& probe, const BesidePlace& at, double d) {
  for (const auto& guess_by : {by_derivatives, by_search}) {
    const std::optional<Uv> guess = guess_by(probe, at, d);
    const std::optional<Curvatures> beside = guess ? settle(probe, at, d, *guess) : std::nullopt;
    if (beside && std::isfinite(beside->largest())) return beside->largest();
  }
  return probe.at(at.p).curvature;
}

}  // namespace geovor
