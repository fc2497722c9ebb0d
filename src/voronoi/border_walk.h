// A walk along a stretch of the face's border, as the site sees it to whose cell it belongs.
#pragma once

#include "voronoi/edge_walk.h"
#include "voronoi/face_border.h"
#include "voronoi/site_ray.h"

namespace geovor {

/// The stretch runs along the true border between the two vertices. The ray is carried on from place to
/// place: from the vertex at the start, or, around a whole cycle, from where the shortest geodesic ends. `arrival_gap`:
/// how far, in space and in length, relative to the radius, the ray at the end lies from the one by which the vertex
/// there knows the site (or from the first one, around a whole cycle).
struct BorderWalk {
  ChartPiece seen;
  double arrival_gap = 0.0;
};
BorderWalk walk_border(const SiteRays& rays, const FaceBorder& border, const VoronoiDiagram& diagram, int site,
                       const CellPiece& piece);

}  // namespace geovor
