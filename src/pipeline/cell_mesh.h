// Triangles for the cells of a diagram.
#pragma once

#include "brep/model.h"
#include "mesh/cell_mesh.h"
#include "voronoi/diagram.h"

namespace geovor {

/// The cells, each triangulated between its own border and the points of a grid that is as fine as the surface's
/// bending asks; for the eye: lines and triangles lie within some 3e-4 of the face's size of edges and surface. A part
/// of the face whose border does not close is left out. `deflection`: of the FaceDomain that the diagram was built on.
CellMesh mesh_of_cells(const CadModel& model, const CadFace& face, const VoronoiDiagram& diagram, double deflection);

}  // namespace geovor
