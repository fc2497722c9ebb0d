// STL, binary and as text.
#pragma once

#include <string>

#include "mesh/triangle_mesh.h"

namespace geovor {

enum class StlForm {
  Binary,  ///< single precision, little endian on every machine
  Ascii,   ///< one solid "geovor"; coordinates read back as the same doubles
};

/// The mesh as the bytes of an STL file. Normals are of unit length, zero for a triangle without area.
/// Throws Error(Unwritable) where the binary form can't hold the mesh: a coordinate beyond single precision, or more
/// than 2^32 - 1 triangles. REQUIRES: first_fault(mesh) finds nothing.
std::string to_stl(const TriangleMesh& mesh, StlForm form);

/// Writes it; the file is complete or absent. Throws Error(Unwritable).
void write_stl(const TriangleMesh& mesh, const std::string& path, StlForm form = StlForm::Binary);

}  // namespace geovor
