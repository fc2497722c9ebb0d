// A geodesic Voronoi diagram as a picture: in space and, beside it, in the parameter domain.
#pragma once

#include <string>

#include "io/face_views.h"
#include "voronoi/cell_raster.h"
#include "voronoi/diagram.h"
#include "voronoi/dual.h"

namespace geovor {

/// Cells in soft colours, edges dark (cut loci dotted), Delaunay edges dashed, sites as dots; what is hidden in space
/// is left out. The same diagram gives the same bytes.
std::string diagram_svg(const VoronoiDiagram& diagram, const DualGraph& dual, const CellRaster& raster,
                        const PictureSize& size = {});

/// Writes it; the file is complete or absent. Throws Error(Unwritable).
void write_diagram_svg(const VoronoiDiagram& diagram, const DualGraph& dual, const CellRaster& raster,
                       const std::string& path, const PictureSize& size = {});

}  // namespace geovor
