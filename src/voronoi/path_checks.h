// What is found out about a finished diagram by computing geodesics anew.
#pragma once

#include "brep/face_domain.h"
#include "voronoi/diagram.h"

namespace geovor {

/// Sets the residual of every vertex and edge: the geodesics from its sites to its stored (u,v) are connected anew, and
/// the largest difference of their lengths is divided by the radius. Infinite where one does not converge.
void recompute_residuals(const Surface& surface, VoronoiDiagram& diagram);

/// Adds a warning "path_leaves_face" for each site whose cell has a vertex, or the middle of an edge, to which the
/// geodesic from the site leaves the face; with the place where it first does so.
void warn_of_paths_that_leave(const FaceDomain& domain, VoronoiDiagram& diagram);

}  // namespace geovor
