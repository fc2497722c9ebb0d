// From a first triangulation to a good mesh: thin out, insert Voronoi vertices, move to the middle of the cells.
#pragma once

#include "delaunay/surface_triangulation.h"

namespace geovor {

/// Geodesic Delaunay refinement: removes vertices that are closer than the rule wants, puts in the Voronoi vertex with
/// the largest radius relative to the size wanted there, as long as there is one that is too large, and moves the inner
/// vertices to the centroids of their stars, flipping to the Delaunay triangulation after each step. All that `rounds`
/// times. What is done, and in which order, depends on places in space alone.
void refine(SurfaceTriangulation& mesh, int rounds);

}  // namespace geovor
