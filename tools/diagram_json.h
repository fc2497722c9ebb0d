// A geodesic Voronoi diagram as JSON ("format": "geovor-voronoi", "version": 1).
#pragma once

#include <optional>
#include <string>

#include "base/interval.h"
#include "voronoi/diagram.h"
#include "voronoi/dual.h"

namespace geovor {

/// What the file says about where the diagram comes from.
struct DiagramSource {
  std::string generator;     ///< program and version
  std::string input;         ///< the file, as the user gave it
  int face = 0;              ///< FreeCAD's FaceN
  std::string unit = "mm";   ///< of all lengths
  std::string surface_type;  ///< "plane", "cylinder", …
  UvBox parameters;          ///< the rectangle around the face
  std::optional<double> u_period, v_period;
};

/// The whole document. Numbers read back as the same double; one that is not finite is null. A border piece of a cell
/// is {"cycle", "from", "to", "points": [{"uv", "xyz"}...]} with the vertices at its ends, null where a cell has a
/// whole cycle of the border. The same diagram gives the same bytes.
std::string diagram_json(const DiagramSource& source, const VoronoiDiagram& diagram, const DualGraph& dual);

/// Writes it; the file is complete or absent. Throws Error(Unwritable).
void write_diagram_json(const DiagramSource& source, const VoronoiDiagram& diagram, const DualGraph& dual,
                        const std::string& path);

}  // namespace geovor
