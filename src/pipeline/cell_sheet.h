// The cells of a diagram as faces of the parameter plane: what is written as CAD faces and painted in pictures.
#pragma once

#include <string>
#include <vector>

#include "brep/model.h"
#include "pipeline/edge_runs.h"
#include "pipeline/face_outline.h"
#include "voronoi/diagram.h"

namespace geovor {

/// A line of the sheet from node to node: a run of an edge, or a stretch of a side of the outline in the direction of
/// the loop.
struct SheetLine {
  int run = -1;               ///< index into CellSheet::runs; -1: a stretch
  int side = -1;              ///< a stretch: of this side of the outline
  double t0 = 0.0, t1 = 0.0;  ///< from here to here
  int from = -1, to = -1;     ///< vertices of the sheet
  std::vector<Uv> uv;         ///< ends included
  std::vector<Xyz> xyz;
};

struct LineUse {
  int line = -1;
  bool reversed = false;
};

/// A face of one cell: the outer loop first, counter-clockwise, then holes; the face lies to the left. A cell that
/// crosses a seam has several.
struct SheetCell {
  int site = -1;
  std::vector<std::vector<LineUse>> loops;
};

struct CellSheet {
  std::vector<Xyz> vertices;
  std::vector<SheetLine> lines;
  std::vector<SheetCell> cells;  ///< ascending by site
  std::string problem;           ///< empty: every loop was closed and belongs to one cell
};

/// `deflection`: how far, in space, the lines of the outline may lie from it, and the diagram's border did.
CellSheet sheet_of_cells(const CadModel& model, const FaceOutline& outline, const VoronoiDiagram& diagram,
                         double deflection);

}  // namespace geovor
