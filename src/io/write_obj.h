// Wavefront OBJ.
#pragma once

#include <string>

#include "mesh/triangle_mesh.h"

namespace geovor {

/// The mesh as OBJ text: all points, then the triangles, with a group "FaceN" a CAD face. Coordinates read back as the
/// same doubles. REQUIRES: first_fault(mesh) finds nothing.
std::string to_obj(const TriangleMesh& mesh);

/// Writes it; the file is complete or absent. Throws Error(Unwritable).
void write_obj(const TriangleMesh& mesh, const std::string& path);

}  // namespace geovor
