// The cells of a diagram as polygons of the parameter plane, for pictures.
#pragma once

#include <vector>

#include "brep/model.h"
#include "voronoi/cell_raster.h"

namespace geovor {

/// One a piece of a cell between seams; empty where the cells do not close. `deflection`: as the diagram was built.
std::vector<CellOutline> outlines_of_cells(const CadModel& model, const CadFace& face, const VoronoiDiagram& diagram,
                                           double deflection);

/// The whole face, of site -1.
CellOutline outline_of_face(const CadModel& model, const CadFace& face, double deflection);

}  // namespace geovor
