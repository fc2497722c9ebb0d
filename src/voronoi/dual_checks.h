// Whether the dual of a diagram is a triangulation. Private to the room.
#pragma once

#include <string>

#include "voronoi/dual.h"

namespace geovor {

/// What keeps the dual from being a triangulation (see DualGraph::is_triangulation), with the sites at fault; empty
/// where nothing does. REQUIRES: dual.edges and dual.triangles are those of the diagram.
std::string why_no_triangulation(const VoronoiDiagram& diagram, const DualGraph& dual);

/// V - E + F of a cell with its border, a border that the cell has on both sides (its cut locus) counted once: 1 for a
/// disk, 0 for a ring around an island, 2 for a whole sphere.
int euler_number(const VoronoiDiagram& diagram, const DiagramCell& cell);

}  // namespace geovor
