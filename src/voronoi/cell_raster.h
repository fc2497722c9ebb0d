// A face cut into small patches, each within one cell: what pictures of a diagram are painted with.
#pragma once

#include <array>
#include <vector>

#include "brep/face_domain.h"
#include "voronoi/diagram.h"

namespace geovor {

/// Four corners, counter-clockwise in the parameter plane.
struct CellPatch {
  std::array<Uv, 4> uv;
  std::array<Xyz, 4> xyz;
  int site = -1;
};

/// A cell, or a piece of one between seams, in the parameter plane: polygons, each without its first point again;
/// inside is what an odd number of them surrounds.
struct CellOutline {
  int site = -1;
  std::vector<std::vector<Uv>> loops;
};

struct CellRaster {
  UvBox box;  ///< around the face
  std::vector<CellPatch> patches;
  std::vector<CellOutline> outlines;       ///< what the parameter plane is painted with; empty: the patches
  std::vector<std::vector<Uv>> border_uv;  ///< polylines of the face's border, seams and poles left out
  std::vector<std::vector<Xyz>> border;
};

/// Along the edges and the border, pieces of single rows of constant v; elsewhere blocks of rows and columns, as large
/// as the bend of the face allows. For the eye: a patch may reach beyond the cell by a part of a row. Without outlines.
CellRaster raster_of_cells(const FaceDomain& domain, const VoronoiDiagram& diagram, int rows, int columns);

}  // namespace geovor
