// Vertices that lie so near to each other, or to the border, that no step leads from one to the next.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "voronoi/face_border.h"
#include "voronoi/site_ray.h"

namespace geovor {

/// The part of a diagram in a disk of kTiedDisk radii about a point.
struct Knot {
  struct Vertex {
    std::vector<SiteRay> generators;   ///< with their rays to the vertex, counter-clockwise by their directions
    std::optional<BorderPlace> place;  ///< on the border: an edge runs between each two that follow each other
  };
  /// An edge that runs from one of the vertices to another, seen from its start.
  struct Edge {
    int from = -1, to = -1;
    int left = -1, right = -1;  ///< generators, as they were given
  };
  std::vector<Vertex> vertices;
  std::vector<Edge> edges;
};

/// The knot about a point x. `generators`: every one whose distance to x is less than 1 + kTieWindow of the least, each
/// with its ray to x, counter-clockwise by their directions (sort_around).
///
/// In so small a disk distances are linear, d_i + <T_i, x> with unit T_i, and their lower envelope is dual to the
/// regular triangulation of the points -T_i of the unit circle with the weights d_i: a convex polygon, so that the
/// edges form a tree. The border cuts it; it is straight there, or a corner. Generators that agree to kOneVertex at a
/// vertex share it, and a vertex that near to the border lies on it. What is decided here once, from one set of
/// distances, is consistent even where their noise decides.
Knot resolve_ties(const FaceBorder& border, const SiteRays& rays, const std::vector<SiteRay>& generators);

/// As a part of the radius: distances in the disk are linear to the square of this.
inline constexpr double kTiedDisk = 1e-8;

/// A generator that is farther than the nearest by this part of the radius has no share in the disk.
inline constexpr double kTieWindow = 2.0 * kTiedDisk;

/// Generators whose distances agree to this part of the radius make one vertex: above the noise of distances (a few
/// kRayTolerance), and half of what the diagram promises of distances at a vertex.
inline constexpr double kOneVertex = 5e-13;

/// The generators of a point sorted counter-clockwise by the directions in which their sites lie, the first stays.
void sort_around(std::vector<SiteRay>& generators);

}  // namespace geovor
