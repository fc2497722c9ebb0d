// Vertices that lie so near to each other that no step leads from one to the next.
#pragma once

#include <vector>

#include "voronoi/site_ray.h"

namespace geovor {

/// One of them.
struct TiedVertex {
  std::vector<SiteRay> generators;  ///< with their rays to the vertex, counter-clockwise by their directions
  int parent = -1;  ///< in the list, the one at the other end of the edge of generators.back() and generators.front()
};

/// The vertices within kTiedDisk radii of a point x, in an order in which parents come first. `generators`: every one
/// whose distance to x is less than 1 + 2 kTiedDisk of the least, three or more, each with its ray to x,
/// counter-clockwise by their directions (sort_around).
///
/// In so small a disk distances are linear, d_i + <T_i, x> with unit T_i, and their lower envelope is dual to the
/// regular triangulation of the points -T_i of the unit circle with the weights d_i: a convex polygon, so that the
/// edges form a tree. Generators that agree to kOneVertex at a vertex share it. What is decided here once, from one set
/// of distances, is consistent even where their noise decides.
std::vector<TiedVertex> resolve_ties(const SiteRays& rays, const std::vector<SiteRay>& generators);

/// Distances in the disk are linear to the square of this, as parts of the radius.
inline constexpr double kTiedDisk = 1e-8;

/// What distances say of a generator that it has no part in the disk.
inline constexpr double kTieWindow = 2.0 * kTiedDisk;

/// Generators whose distances agree to this part of the radius make one vertex: above the noise of distances (a few
/// kRayTolerance), and no more than what the diagram promises of distances at a vertex.
inline constexpr double kOneVertex = 1e-12;

/// The generators of a point sorted counter-clockwise by the directions in which their sites lie, the first stays.
void sort_around(std::vector<SiteRay>& generators);

}  // namespace geovor
