// Geodesics that run from the sites to a point, seen from that point: what a bisector and a vertex are made of.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "geodesic/connect.h"
#include "geodesic/ray_source.h"
#include "surface/surface.h"

namespace geovor {

/// A geodesic from a site to the point x. A site can have several to the same point (behind a bump, or round a
/// cylinder): each is a generator of its own, told apart by its angle polar.t.
struct SiteRay {
  int site = -1;
  Polar polar;      ///< of x about the site
  Uv uv;            ///< x in the parameter plane
  Xyz x;            ///< x in space
  Xyz T;            ///< unit tangent at x, pointing on, away from the site
  Xyz N;            ///< n x T: where x moves as polar.t grows
  double y = 0.0;   ///< Jacobi field at x: dx/dt = y N
  double dy = 1.0;  ///< and how it grows along the ray
};

/// A ray as it was traced, for a solver that goes on from there.
struct RayShot {
  SiteRay ray;
  SurfaceJet jet;          ///< at ray.uv
  double tolerance = 0.0;  ///< that the trace has met, relative to its length
};

/// Makes rays of a set of sites on a surface. Both outlive it; sites may be added meanwhile, not moved.
class SiteRays {
 public:
  SiteRays(const Surface& surface, const std::vector<Uv>& sites);

  /// The ray with these polar coordinates: O_site(s,t), to kRayTolerance. Nothing where the geodesic can't be traced,
  /// or at a conjugate point.
  std::optional<SiteRay> at(int site, Polar polar) const;

  /// The same to a tolerance of the length, with the surface's jet at the end.
  std::optional<RayShot> shoot(int site, Polar polar, double tolerance) const;

  /// The ray that ends at m: with a guess the geodesic next to it, without one what connect() finds. Nothing where the
  /// iteration does not settle.
  std::optional<SiteRay> to(int site, Uv m, std::optional<Polar> guess = std::nullopt) const;

  /// The same to kRoughly of the length, for values that are guesses and bounds.
  std::optional<SiteRay> roughly_to(int site, Uv m, std::optional<Polar> guess = std::nullopt) const;

  /// The largest normal curvature that was found anywhere on the surface: what a ray may meet on its way.
  double curvature() const { return map_->largest(); }
  const CurvatureMap& curvature_map() const { return *map_; }

  const Surface& surface() const { return surface_; }
  Uv site(int i) const { return sites_[i]; }
  int count() const { return static_cast<int>(sites_.size()); }

 private:
  std::optional<SiteRay> shoot_near(int site, Uv m, Polar aim, double tolerance,
                                    double miss_of_guess = kMissOfGuess) const;
  std::optional<RayShot> shoot_onto_side(int site, Polar polar, double tolerance) const;

  /// How far off, as a part of the length, a guess from a neighbouring point is as a rule.
  static constexpr double kMissOfGuess = 0.05;

  const Surface& surface_;
  const std::vector<Uv>& sites_;
  std::shared_ptr<const CurvatureMap> map_;
  std::vector<RaySource> sources_;  ///< of the sites that there were at first
  bool closed_form_;
};

/// What the integrator is asked for, relative to the length: the ends of two rays, each within five of it as a rule
/// (geodesic/trace.h), lie within less than 1e-12 of each other.
inline constexpr double kRayTolerance = 5e-14;

inline constexpr double kRoughly = 1e-7;

/// The ray to the point m of the surface near the end of this one, j the jet there, to second order in the way between
/// them: about the end the geodesic circle has the curvature y'/y. What is left out of the length is the way to the
/// third power, of the angle the way squared times the change of y with the angle.
SiteRay moved(const SiteRay& ray, Uv m, const SurfaceJet& j);

/// The polar coordinates, to first order, of the point `m` of space near ray.x.
Polar carry(const SiteRay& ray, const Xyz& m);

/// Whether two rays of one point are the same geodesic.
bool same_generator(const SiteRay& a, const SiteRay& b);

/// From a to the copy of b, by whole periods, that is nearest to it.
UvVec nearest_copy(const Surface& surface, Uv a, Uv b);

/// An angle brought into (-pi, pi].
double wrap_angle(double t);

/// Angle of b seen from a, counter-clockwise about n, in [0, 2 pi).
double turn_between(const Xyz& a, const Xyz& b, const Xyz& n);

}  // namespace geovor
