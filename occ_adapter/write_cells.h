// Writes the cells of a diagram as STEP faces on the surface of the CAD face that they were cut from.
#pragma once

#include <string>

#include "brep/cad_sheet.h"

namespace geovor {

/// The face that a sheet was cut from: read again, so that its surface and its border are written as the file has them.
struct SheetSource {
  std::string file;
  int face = 0;      ///< FaceN
  std::string unit;  ///< of the model's lengths, and of the file that is written
};

/// A product "cells", a shell of named faces that share their edges, and a product "edges", an assembly of one product
/// a curve, with its name (of one curve alone: only that). The file at `path` is complete or absent. Throws
/// Error(Unwritable), and Error(Unreadable) where the input can't be read again.
void write_step(const CadSheet& sheet, const SheetSource& source, const std::string& path);

}  // namespace geovor
