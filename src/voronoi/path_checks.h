// What is found out about a finished diagram by computing geodesics anew.
#pragma once

#include "brep/face_domain.h"
#include "voronoi/diagram.h"

namespace geovor {

/// Sets the residual of every vertex and edge: the geodesics from its sites to its stored (u,v) are connected anew, and
/// the largest difference of their lengths is divided by the radius. Infinite where one does not converge.
void recompute_residuals(const Surface& surface, VoronoiDiagram& diagram);

/// Adds a warning "path_leaves_face" for each stretch of the face's border that a site's shortest paths reach from
/// beyond the face, with the place where such a path leaves it (of some, the one that stays outside longest) and, in
/// the text, where it comes back. Complete as far as the cells' loops are and as the border's polyline tells:
/// excursions that stay within its deflection, or 5e-4 of the path's length, are none. "unresolved" where a ray is not
/// found.
void warn_of_paths_that_leave(const FaceDomain& domain, VoronoiDiagram& diagram);

/// The warnings of that kind for one site.
std::vector<DiagramWarning> paths_that_leave(const FaceDomain& domain, const VoronoiDiagram& diagram, int site);

}  // namespace geovor
