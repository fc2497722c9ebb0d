// A geodesic Voronoi diagram for ParaView (VTK's XML format for polygonal data, as text).
#pragma once

#include <string>

#include "mesh/cell_mesh.h"
#include "voronoi/diagram.h"

namespace geovor {

/// Sites as vertices, edges and the face's border as polylines, cells as triangles. Data of the cells (in VTK's sense):
/// "kind" (0 site, 1 bisector, 2 cut locus, 3 border of the face, 4 cell), "id" (of the site or edge; -1 for the
/// border) and "site_a", "site_b" (of an edge both sites, else the one or -1). Data of the points: "radius", the
/// distance to the nearest site, on sites and edges; nan elsewhere. Numbers read back as the same double.
std::string diagram_vtp(const VoronoiDiagram& diagram, const CellMesh& cells);

/// Writes it; the file is complete or absent. Throws Error(Unwritable).
void write_diagram_vtp(const VoronoiDiagram& diagram, const CellMesh& cells, const std::string& path);

}  // namespace geovor
