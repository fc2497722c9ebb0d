// The iteration that bisector points and Voronoi vertices share: a point as far from several sites. Private to the
// room, but for the guesses.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "voronoi/site_ray.h"

namespace geovor {

/// A site with the angle of a ray as the start of an iteration.
struct PolarGuess {
  int site = -1;
  double angle = 0.0;
};

/// A plane of space: <normal, x> = offset.
struct SectionPlane {
  Xyz normal;
  double offset;
};

/// The two or three rays that meet.
struct MeetingRays {
  std::array<SiteRay, 3> rays;
  int count = 0;
};

/// The point O_i(rho, t_i), the same for all rays, near the guess: of three rays, or of two in the plane <normal, x> =
/// offset. `miss` tells what the guess is off by, as a part of the radius, as far as the caller knows: a good guess
/// told for what it is costs one trace a ray. The rays come back with one radius and one point, exact to the traces'
/// own tolerance where the surface has coordinates there (not at a pole), else to kMeetingTolerance. Nothing where the
/// iteration does not settle.
std::optional<MeetingRays> find_equidistant(const SiteRays& rays, std::span<const PolarGuess> guess, double radius,
                                            const SectionPlane* plane, double miss);

/// Bound on the distance of the ends where they are not made to agree, relative to the radius.
inline constexpr double kMeetingTolerance = 1e-12;

}  // namespace geovor
