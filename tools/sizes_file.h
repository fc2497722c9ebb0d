// Rules of single faces from a CSV file.
#pragma once

#include <string>
#include <vector>

#include "brep/model.h"
#include "pipeline/mesh_model.h"

namespace geovor {

/// Reads a CSV file whose header names the column `face` and one or more of `size`, `deflection` (both model units) and
/// `angle` (degrees), in any order and case, with or without a byte-order mark. A face is 3, Face3, 4-9, or a name that
/// the CAD file gives (then every face of that name), in quotes where it holds a comma; an empty cell leaves the rule
/// of all faces. `#` starts a comment, empty lines don't count. Throws Error(Usage) that names the line; a face with
/// rules on two lines is one.
std::vector<FaceRule> read_sizes_file(const std::string& path, const CadModel& model);

}  // namespace geovor
