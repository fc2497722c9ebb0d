// Writes curves as STEP.
#pragma once

#include <string>
#include <vector>

#include "brep/cad_curve.h"

namespace geovor {

/// Writes each curve as an edge of its own, with its name as the name of its product. `unit` is the unit of the curves'
/// lengths ("mm", "m", "in", …) and of the file. The file at `path` is complete or absent. Throws Error(Unwritable).
void write_step(const std::vector<CadCurve>& curves, const std::string& unit, const std::string& path);

}  // namespace geovor
