// What is found out about a finished diagram by computing geodesics anew.
#pragma once

#include "brep/face_domain.h"
#include "voronoi/diagram.h"

namespace geovor {

/// Sets the residual of every vertex and edge: the geodesics from its sites to its stored (u,v) are connected anew, and
/// the largest difference of their lengths is divided by the radius. Infinite where one does not converge.
void recompute_residuals(const Surface& surface, VoronoiDiagram& diagram);

/// Adds a warning "path_leaves_face" for each site whose geodesics to the edges of its cell, or to the face's border
/// around it, leave the face; with the place where the first one found does so. Looked at are the stored points, some
/// 0.03 radians or a step of the edge apart as seen from the site: what hides between two of them is missed.
void warn_of_paths_that_leave(const FaceDomain& domain, VoronoiDiagram& diagram);

}  // namespace geovor
