// From a scaffold to a good mesh: thin out, insert Voronoi vertices, move to the middle of the cells.
#pragma once

#include "delaunay/surface_triangulation.h"

namespace geovor {

struct RefineResult {
  int inserted = 0;
  int removed = 0;
  int too_large = 0;  ///< triangles that stayed larger than the rule wants because no vertex could be put in
};

/// Geodesic Delaunay refinement: removes vertices that are closer than the rule wants, puts in the Voronoi vertex with
/// the largest radius relative to the size wanted there, as long as there is one that is too large, and moves the inner
/// vertices to the centroids of their stars, flipping to the Delaunay triangulation after each step.
RefineResult refine(SurfaceTriangulation& mesh);

}  // namespace geovor
