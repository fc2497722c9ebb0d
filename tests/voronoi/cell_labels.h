// The cell that holds a point, and the site that is nearest to it, each found without the other.
#pragma once

#include <functional>
#include <string>

#include "brep/face_domain.h"
#include "geodesic/distance.h"
#include "voronoi/diagram.h"

namespace geovor::testing {

/// The shortest geodesic from a site to a place; not converged where there is none.
using DistanceRule = std::function<Connection(Uv site, Uv place)>;
DistanceRule shortest_by(const DistanceFinder& finder);

/// What a comparison of cells with brute force came to.
struct LabelCheck {
  int looked_at = 0;
  int looked_at_outside = 0;  ///< places in the box around the face, but not in it: no cell may hold them
  int gone_around = 0;        ///< places not next to the cells' loops
  int undecided = 0;          ///< on an edge (kOnEdge), or without a distance
  int wrong = 0;
  std::string first_wrong;
};

/// Distances that differ by less are those of a place on an edge, relative to the larger of 1 and the distance.
inline constexpr double kOnEdge = 1e-9;

/// Random points of the face. The nearest site: the shortest of the distances to all sites, a site being left out only
/// where the straight way through space is already longer. Its cell holds the point if, in the polar chart of the site,
/// the point lies within the cell's edges; next to a polyline (some of its tolerances) the two rays that make the edge
/// decide. And all the cell's loops together, drawn in the chart, go around a point of the face once and around a point
/// beside it, in a hole or beyond its outer border, not at all; next to them (for the border: as near as its chords are
/// long) that is not looked at.
LabelCheck compare_with_brute_force(const FaceDomain& domain, const VoronoiDiagram& diagram, const DistanceRule& rule,
                                    int count, unsigned seed);

}  // namespace geovor::testing
