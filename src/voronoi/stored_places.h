// What can be said of a finished diagram's numbers without a geodesic.
#pragma once

#include "brep/face_domain.h"
#include "voronoi/certificate.h"

namespace geovor {

/// How many of the diagram's numbers are NaN or infinite: none may be. Residuals may be infinite (path_checks.h says
/// when), not NaN.
CertificateClaim all_numbers_finite(const VoronoiDiagram& diagram);

/// Stored places in space are those of their parameters: of vertices and points of edges relative to the radius, of
/// sites to the size of the diagram. Rounding of the parameters and of the coordinates is taken off.
CertificateClaim places_are_of_parameters(const Surface& surface, const VoronoiDiagram& diagram);

/// Sites, vertices and edges lie in the face, up to twice the deflection of its border; what is between two points of
/// an edge is looked at on the segment of the parameter plane that joins them, up to what that and the edge may differ.
/// Counts those that do not.
CertificateClaim all_in_the_face(const FaceDomain& domain, const VoronoiDiagram& diagram);

}  // namespace geovor
