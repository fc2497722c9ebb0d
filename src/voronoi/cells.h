// From edges and vertices to cells: the loops around each site.
#pragma once

#include <functional>

#include "voronoi/diagram.h"
#include "voronoi/face_border.h"

namespace geovor {

/// Fills diagram.cells. Walks along edges with the cell to the left; where a walk meets the border of the face it
/// follows it to the next vertex. `cycle_owner`: the site whose cell has a cycle of the border on which no edge ends.
/// A walk that can't go on (an edge is missing) leaves its loop out and a warning "unresolved".
void assemble_cells(const FaceBorder& border, const std::function<int(int cycle)>& cycle_owner,
                    VoronoiDiagram& diagram);

}  // namespace geovor
