// A geodesic Voronoi diagram as JSON ("format": "geovor-voronoi", "version": 1).
#pragma once

#include <string>

#include "document.h"
#include "voronoi/certificate.h"
#include "voronoi/diagram.h"
#include "voronoi/dual.h"

namespace geovor {

/// The whole document. Numbers read back as the same double; one that is not finite is null. A border piece of a cell
/// is {"cycle", "from", "to", "points": [{"uv", "xyz"}...]} with the vertices at its ends, null where a cell has a
/// whole cycle of the border. `certificate` may be null. The same diagram gives the same bytes.
std::string diagram_json(const DocumentSource& source, const VoronoiDiagram& diagram, const DualGraph& dual,
                         const Certificate* certificate = nullptr);

/// Writes it; the file is complete or absent. Throws Error(Unwritable).
void write_diagram_json(const DocumentSource& source, const VoronoiDiagram& diagram, const DualGraph& dual,
                        const Certificate* certificate, const std::string& path);

}  // namespace geovor
