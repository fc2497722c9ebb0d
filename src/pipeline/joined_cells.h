// Cells that seams cut into pieces, put together again: one CAD face a site.
#pragma once

#include <vector>

#include "pipeline/cell_sheet.h"
#include "pipeline/face_outline.h"

namespace geovor {

/// A use of a line in the copy of the parameter plane that lies `shift`, whole periods, away.
struct ShiftedUse {
  LineUse use;
  UvVec shift;
};

/// Loops as in SheetCell. A seam is left where the cell winds around the surface or holds a pole: its two sides are
/// then a period apart.
struct JoinedCell {
  int site = -1;
  std::vector<std::vector<ShiftedUse>> loops;
};

/// Pieces of a cell are joined across seams of surfaces that are periodic in CAD files too (planes, cylinders, cones,
/// spheres, tori, and around the axis of a revolution); across the seam of another surface they stay apart, a cell
/// each. Ascending by site.
std::vector<JoinedCell> joined_cells(const CellSheet& sheet, const FaceOutline& outline);

}  // namespace geovor
