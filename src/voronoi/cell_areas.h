// The areas of the cells of a diagram.
#pragma once

#include "surface/surface.h"
#include "voronoi/diagram.h"

namespace geovor {

/// Sets the area of every cell that has a loop: in geodesic polar coordinates (s, t) about the site the element of area
/// is y ds dt, so that the area is the integral of A(s, t) = int_0^s y ds over t along the cell's loops. Needs no cell
/// to be a star of the face, only that its polar coordinates are unique. NaN where a geodesic fails.
void measure_cells(const Surface& surface, VoronoiDiagram& diagram);

}  // namespace geovor
