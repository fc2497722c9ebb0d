// Writes triangle meshes in OpenCASCADE's own format.
#pragma once

#include <string>

#include "mesh/triangle_mesh.h"

namespace geovor {

/// Writes the mesh as a planar face a triangle, with shared vertices and edges: a solid a closed shell, its normals
/// looking outwards, a shell an open one. The format knows neither units nor names. The file at `path` is complete or
/// absent. Throws Error(Unwritable), also for a triangle without area. REQUIRES: first_fault(mesh) finds nothing; at
/// least one triangle.
void write_brep(const TriangleMesh& mesh, const std::string& path);

}  // namespace geovor
