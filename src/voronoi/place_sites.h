// Sites spread over a face, far from one another, by its geometry alone.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "brep/face_domain.h"

namespace geovor {

/// Called with the number of places so far and that wanted (0: not known). Returning false ends the work: the places so
/// far are returned.
using PlacingProgress = std::function<bool(int placed, int total)>;

/// `count` places in the face by farthest points: each next one is a point whose reach (its geodesic distance to the
/// places so far, or twice its distance in space to the border where that is less and the face is wide enough) is the
/// largest; it lies at a vertex of their Voronoi diagram, on an edge or on a geodesic near the border. The first is the
/// farthest from a point just inside the border's extreme point in a direction of space that the seed picks (of a
/// closed face: from its extreme point).
/// Of equally far points the first along x, y, z in space comes first, so that the same face under another
/// parameterization has the same places. From kOneByOne places on they come in batches, within which a reach may be as
/// small as kBatchReach of the largest: no two places are nearer to each other than kBatchReach of the largest reach
/// that is left when the second of them is placed.
/// The same arguments give the same places. Throws Error(Usage) where count is not positive or no place is left.
std::vector<Uv> place_sites(const FaceDomain& domain, int count, std::uint64_t seed,
                            const PlacingProgress& progress = {});

/// The same until no reach is larger than kReachOfSpacing of `spacing`: no two places are nearer to each other than
/// that, most neighbours are about `spacing` apart, and no point of the face is farther than that from its site but
/// near the border, where it may be by half of that. Throws Error(Usage) where spacing is not positive.
std::vector<Uv> place_sites_apart(const FaceDomain& domain, double spacing, std::uint64_t seed,
                                  const PlacingProgress& progress = {});

inline constexpr int kOneByOne = 24;
inline constexpr double kBatchReach = 0.63;
inline constexpr double kReachOfSpacing = 0.7;

}  // namespace geovor
