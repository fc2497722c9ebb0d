// The cells of a diagram as CAD faces, its edges as CAD curves.
#pragma once

#include "brep/cad_sheet.h"
#include "brep/model.h"
#include "voronoi/diagram.h"

namespace geovor {

/// Faces "site I", one a cell (where a cell crosses a seam that joined_cells() can't join, one a piece); beside them
/// the edges as curves "edge I (sites A B)", cut loci as "cut locus I (site A)", numbered as in the diagram. Curves and
/// p-curves follow the edges to a twentieth of the diagram's tolerance beyond what its polylines do, and each other to
/// 5e-8. `deflection`: of the FaceDomain that the diagram was built on. Throws Error(FaceRejected) where the cells do
/// not close.
CadSheet cad_cells(const CadModel& model, const CadFace& face, const VoronoiDiagram& diagram, double deflection);

}  // namespace geovor
