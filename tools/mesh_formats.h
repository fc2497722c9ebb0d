// The formats that `geovor mesh` writes: one table for the help, the check of endings and the writing.
#pragma once

#include <string>
#include <vector>

#include "mesh/labelled_mesh.h"
#include "options.h"

namespace geovor {

struct MeshFormat {
  const char* ending;  ///< in lower case, with its dot
  const char* note;    ///< a word for the help, may be empty
  void (*write)(const LabelledMesh& mesh, const MeshArguments& arguments, const std::string& path);
};

/// In the order of the help.
const std::vector<MeshFormat>& mesh_formats();

std::vector<std::string> mesh_format_endings();

/// For the help: ".stl .step … .svg (a picture)".
std::string mesh_format_list();

/// Writes the file in the format of its ending. REQUIRES: the ending is one of mesh_formats(). Throws
/// Error(Unwritable).
void write_mesh(const LabelledMesh& mesh, const MeshArguments& arguments, const std::string& path);

}  // namespace geovor
