// What the writers of this room share; private like occ_private.h.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"
#include "occ_adapter/occ_private.h"

namespace geovor::occ {

/// The mesh as planar faces with shared edges and vertices: a solid per closed component, a shell per open one; a
/// compound where there are several. Throws Error(Unwritable) for a triangle without area.
TopoDS_Shape facet_shape(const TriangleMesh& mesh);

struct StepFile {
  std::string path;
  std::string unit;          ///< of the shapes' lengths and of the file: "mm", "in", …
  std::string description;   ///< for the header
  bool every_digit = false;  ///< numbers read back as the same double; otherwise OpenCASCADE's 13 digits
};

struct NamedShape {
  TopoDS_Shape shape;
  std::string name;  ///< of its product in the file
};

/// Writes the shapes, a product each; the same shapes give the same bytes. `shapes` is called where OpenCASCADE's
/// failures become errors. The file is complete or absent. Throws Error(Unwritable).
void write_step_file(const StepFile& file, const std::function<std::vector<NamedShape>()>& shapes);

}  // namespace geovor::occ
