// Whether the stretches of border in the cells' loops are the border of the face: all of it, and none of it twice.
#pragma once

#include <optional>

#include "voronoi/diagram_topology.h"
#include "voronoi/face_border.h"

namespace geovor {

/// The first broken law, and whose it is. On every cycle of the border each vertex is left by one stretch, which
/// belongs to its first generator, and reached by one, which belongs to its last; together the stretches go around the
/// cycle once; a cycle without vertices is one stretch. The polylines of the stretches are those of `border` between
/// their vertices, in the parameter plane and in space, to kSameStretch of what they are long.
/// REQUIRES: first_topology_fault(diagram) finds none, and all numbers of the diagram are finite.
std::optional<TopologyFault> first_border_fault(const FaceBorder& border, const VoronoiDiagram& diagram);

/// Both polylines are made of the same places; what is between is rounding, and that of a vertex from the border.
inline constexpr double kSameStretch = 1e-7;

}  // namespace geovor
