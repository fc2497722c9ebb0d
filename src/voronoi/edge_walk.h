// A walk along an edge of a finished diagram, with the geodesics from both its sites traced anew.
#pragma once

#include <array>

#include "voronoi/diagram.h"
#include "voronoi/ray_end.h"

namespace geovor {

/// What a site sees of a piece of its cell's border, in the direction in which it goes around the cell.
struct ChartPiece {
  bool found = false;  ///< all of it could be followed
  Polar first, last;
  double last_y = 0.0;   ///< Jacobi field at the end
  double area = 0.0;     ///< of what the rays to the piece sweep: integral of y ds dt
  double turn = 0.0;     ///< radians, counter-clockwise
  double back = 0.0;     ///< largest step clockwise between places looked at: its width in space over the radius
  double least_y = 1.0;  ///< smallest y / radius, free ends of cut loci left out
  double shortest = 0.0;
  /// Width in space, to the side seen from the site, of the widest run along which the angle falls: what of a stretch
  /// of the face's border is hidden, so that rays reach it from beyond the face.
  double hidden = 0.0;
  Polar middle;  ///< of a place that is neither end; of border: the farthest one
};

struct EdgeWalk {
  std::array<ChartPiece, 2> seen;  ///< by the site to the left, along the edge; by the one to the right, against it
  /// Largest difference of the two radial lengths at a stored point, and at one corrected place between two of them,
  /// both relative to the radius, rounding of the coordinates taken off.
  double radial_gap = 0.0, gap_between = 0.0;
  /// Largest distance, relative to the radius, from a stored point to the ends of its two rays.
  double place_gap = 0.0;
  /// Largest distance between the two ends that are predicted for the middle of two stored points, relative to the
  /// radius: the rays change smoothly from one point to the next.
  double jump = 0.0;
  bool left_is_left = true;  ///< the edge runs with its left site to the left
  Uv worst;                  ///< where the largest of the gaps is
};

/// `curvature`: see trace_ray(). REQUIRES: at least two points
EdgeWalk walk_edge(const Surface& surface, const CurvatureMap& curvature, const VoronoiDiagram& diagram, int edge);

/// The part of the coordinates' size that rounding may take of a difference of two lengths.
inline constexpr double kCoordinateRounding = 8.0 * 2.220446049250313e-16;

}  // namespace geovor
