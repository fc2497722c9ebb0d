// Geodesics that run from the sites to a point, seen from that point: what a bisector and a vertex are made of.
#pragma once

#include <optional>
#include <vector>

#include "geodesic/connect.h"
#include "surface/surface.h"

namespace geovor {

/// A geodesic from a site to the point x. A site can have several to the same point (behind a bump, or round a
/// cylinder): each is a generator of its own, told apart by its angle polar.t.
struct SiteRay {
  int site = -1;
  Polar polar;     ///< of x about the site
  Uv uv;           ///< x in the parameter plane
  Xyz x;           ///< x in space
  Xyz T;           ///< unit tangent at x, pointing on, away from the site
  Xyz N;           ///< n x T: where x moves as polar.t grows
  double y = 0.0;  ///< Jacobi field at x: dx/dt = y N
};

/// Makes rays of a set of sites on a surface. Both outlive it.
class SiteRays {
 public:
  struct Accuracy;  ///< private to the .cpp

  SiteRays(const Surface& surface, const std::vector<Uv>& sites) : surface_(surface), sites_(sites) {}

  /// The ray with these polar coordinates: O_site(s,t). Nothing where the geodesic can't be traced, or at a conjugate
  /// point.
  std::optional<SiteRay> at(int site, Polar polar) const;

  /// The ray that ends at m: with a guess the geodesic next to it, without one what connect() finds. Nothing where the
  /// iteration does not settle.
  std::optional<SiteRay> to(int site, Uv m, std::optional<Polar> guess = std::nullopt) const;

  /// The same to kRoughly of the length, at a third of the cost: for labels, whose values are guesses and bounds.
  std::optional<SiteRay> roughly_to(int site, Uv m, std::optional<Polar> guess = std::nullopt) const;

  const Surface& surface() const { return surface_; }
  Uv site(int i) const { return sites_[i]; }
  int count() const { return static_cast<int>(sites_.size()); }

 private:
  std::optional<SiteRay> shoot_near(int site, Uv m, Polar aim, const Accuracy& accuracy) const;

  const Surface& surface_;
  const std::vector<Uv>& sites_;
};

inline constexpr double kRoughly = 1e-7;

/// The polar coordinates, to first order, of the point `m` of space near ray.x.
Polar carry(const SiteRay& ray, const Xyz& m);

/// A guess carried from a neighbouring point and a geodesic already known at the point are the same if they agree to
/// this part of the lattice's reach: the guess errs by the square of the reach over the radius of curvature, a second
/// geodesic of the same site that matters comes from another side.
inline constexpr double kSameGuess = 0.25;

/// Whether the guess is the ray, to kSameGuess of the reach.
bool near_guess(const SiteRay& ray, int site, const Polar& guess, double reach);

/// Whether two rays of one point are the same geodesic.
bool same_generator(const SiteRay& a, const SiteRay& b);

/// From a to the copy of b, by whole periods, that is nearest to it.
UvVec nearest_copy(const Surface& surface, Uv a, Uv b);

/// An angle brought into (-pi, pi].
double wrap_angle(double t);

/// Angle of b seen from a, counter-clockwise about n, in [0, 2 pi).
double turn_between(const Xyz& a, const Xyz& b, const Xyz& n);

}  // namespace geovor
