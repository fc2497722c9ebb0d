// Where an edge will end, told from the plane's geometry.
#pragma once

#include <optional>

#include "voronoi/bisector.h"
#include "voronoi/nearby_sites.h"

namespace geovor {

/// The third site of a vertex to come, and the way to it along the bisector.
struct ForeseenVertex {
  int site = -1;
  double way = 0.0;
};

/// The first site to cut the bisector within `reach` of m in the direction of its tangent, if the surface were the
/// tangent plane at m with every site at its distance (estimated from the chord; the error falls as the fourth power of
/// the distance over the curvature radius). A guess: exact where all sites concerned are near to each other.
std::optional<ForeseenVertex> foresee(const NearbySites& sites, const SiteRays& rays, const BisectorPoint& m,
                                      double reach);

}  // namespace geovor
