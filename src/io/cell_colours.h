// Colours for cells such that neighbours differ.
#pragma once

#include <vector>

#include "voronoi/diagram.h"

namespace geovor {

/// A colour number, from 0, a site: cells that share an edge have different ones. Cells of a plane or a sphere need six
/// at most (smallest degree last: Matula and Beck 1983).
std::vector<int> colours_of_cells(const VoronoiDiagram& diagram);

}  // namespace geovor
