// Writes triangle meshes as faceted boundary representations.
#pragma once

#include <string>

#include "mesh/triangle_mesh.h"

namespace geovor {

/// Writes the mesh as a faceted B-rep, a planar face a triangle, with shared vertices and edges: a solid where the mesh
/// is closed, shells where it is not. `unit` is the unit of the mesh's lengths ("mm", "m", "in", …) and of the file.
/// The file at `path` is complete or absent. Throws Error(Unwritable).
void write_step(const TriangleMesh& mesh, const std::string& unit, const std::string& path);

}  // namespace geovor
