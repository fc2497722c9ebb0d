// A geodesic Voronoi diagram as a page that turns in a browser.
#pragma once

#include <string>

#include "mesh/cell_mesh.h"
#include "voronoi/diagram.h"

namespace geovor {

struct PageFacts {
  std::string title;  ///< any text
  std::string unit;   ///< of lengths
};

/// One page without anything from outside: cells in colours of which neighbours differ, edges dark, cut loci dashed,
/// sites as dots; mouse, touch, wheel and keys turn, move and zoom it, a cell under the pointer tells its site. Needs
/// WebGL. Geometry is held in single precision, relative to the middle of the face. The same diagram gives the same
/// bytes.
std::string diagram_html(const VoronoiDiagram& diagram, const CellMesh& cells, const PageFacts& facts);

/// Writes it; the file is complete or absent. Throws Error(Unwritable).
void write_diagram_html(const VoronoiDiagram& diagram, const CellMesh& cells, const PageFacts& facts,
                        const std::string& path);

}  // namespace geovor
