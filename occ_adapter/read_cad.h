// Reads CAD files through OpenCASCADE into geovor's own model.
#pragma once

#include <string>

#include "brep/model.h"

namespace geovor {

/// Reads .step .stp .p21 .iges .igs .brep (the ending in any case decides). Surfaces and curves are copied out:
/// nothing of OpenCASCADE lives on in the model. Faces come in TopExp order, so that faces[i] is FreeCAD's Face(i+1); a
/// face that can't be used stays in the list with surface == nullptr and its `problems`.
/// Throws Error(Unreadable) with one line that says what is wrong and what would mend it: no such file, not a CAD file,
/// cut short, no face in it.
CadModel read_cad(const std::string& path);

}  // namespace geovor
