// Writes STEP: triangle meshes as faceted boundary representations, and curves.
#pragma once

#include <string>
#include <vector>

#include "brep/cad_curve.h"
#include "mesh/triangle_mesh.h"

namespace geovor {

/// Writes the mesh as a faceted B-rep, a planar face a triangle, with shared vertices and edges: a solid where the mesh
/// is closed, shells where it is not. `unit` is the unit of the mesh's lengths ("mm", "m", "in", …) and of the file.
/// The file at `path` is complete or absent. Throws Error(Unwritable).
void write_step(const TriangleMesh& mesh, const std::string& unit, const std::string& path);

/// Writes each curve as an edge of its own, with its name as the name of its product. Everything else as above.
void write_step(const std::vector<CadCurve>& curves, const std::string& unit, const std::string& path);

}  // namespace geovor
