// The areas of the cells of a diagram.
#pragma once

#include "brep/face_domain.h"
#include "voronoi/diagram.h"

namespace geovor {

/// Sets the area of every cell: in geodesic polar coordinates (s, t) about the site the element of area is y ds dt (see
/// cell_charts.h). Needs no cell to be a star of the face, only that its polar coordinates are unique. NaN where a
/// geodesic fails.
void measure_cells(const FaceDomain& domain, VoronoiDiagram& diagram);

}  // namespace geovor
