// Whether vertices, edges and cells of a diagram say the same of one another.
#pragma once

#include <optional>
#include <string>

#include "voronoi/diagram.h"

namespace geovor {

/// The first broken law, and whose it is (-1: not that kind).
struct TopologyFault {
  std::string text;
  int vertex = -1, edge = -1, cell = -1;
};

/// Every spoke belongs to an edge that says the same of its ends and sites; every edge is walked once in each
/// direction, by the loops of the right cells; in every loop one piece ends in the vertex where the next begins;
/// indices are valid and edges have points. Geometry is not looked at.
std::optional<TopologyFault> first_topology_fault(const VoronoiDiagram& diagram);

}  // namespace geovor
