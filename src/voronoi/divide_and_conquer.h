// Divide and conquer, as in section 3.2 of the paper: the diagrams of the halves, sewn together.
#pragma once

#include <vector>

#include "brep/face_domain.h"
#include "voronoi/diagram_builder.h"

namespace geovor {

/// The same diagram as build_diagram() makes, up to the order of vertices and edges: the sites are split at the median
/// of their places in space, along the axis on which they spread most, until one is left, and the diagrams merged.
/// Slower: the diagrams of few sites reach over the whole face, with long geodesics and cut loci that are of no use in
/// the end. What it is good for is to check the other way, and to add sites to a diagram that is there.
VoronoiDiagram divide_and_conquer(const FaceDomain& domain, const std::vector<Uv>& sites,
                                  const VoronoiOptions& options = {});

}  // namespace geovor
