// Warnings about what a finished diagram could not find out.
#pragma once

#include "voronoi/diagram.h"
#include "voronoi/nearby_sites.h"

namespace geovor {

/// Adds a warning "unresolved" for each site of which the diagram was made without all geodesics: some were lost that
/// may be shorter than the largest distance to the border of its cell or of a cell beside it. `sites` has answered the
/// queries by which the diagram was made.
void warn_of_lost_geodesics(const NearbySites& sites, VoronoiDiagram& diagram);

/// Adds a warning "unresolved" for each cell without a finite area, and for each vertex and edge without a finite
/// residual. For a diagram that was measured.
void warn_of_what_has_no_measure(VoronoiDiagram& diagram);

}  // namespace geovor
