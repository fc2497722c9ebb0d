// What the writers of this room share; private like occ_private.h.
#pragma once

#include "mesh/triangle_mesh.h"
#include "occ_adapter/occ_private.h"

namespace geovor::occ {

/// The mesh as planar faces with shared edges and vertices: a solid per closed component, a shell per open one; a
/// compound where there are several. Throws Error(Unwritable) for a triangle without area.
TopoDS_Shape facet_shape(const TriangleMesh& mesh);

}  // namespace geovor::occ
