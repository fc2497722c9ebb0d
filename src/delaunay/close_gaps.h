// From triangles that are certain to a closed surface.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "delaunay/half_edges.h"
#include "delaunay/mesh_border.h"
#include "delaunay/mesh_vertex.h"

namespace geovor {

/// `certain`: triangles no two of which share a directed edge. Adds those of `candidates`, in their order, that have
/// room, then cuts ears from the gaps that are left. Nothing if the result is not one connected surface whose border is
/// `border`.
std::optional<HalfEdges> close_gaps(const std::vector<MeshVertex>& points, const MeshBorder& border,
                                    std::vector<std::array<int, 3>> certain,
                                    const std::vector<std::array<int, 3>>& candidates);

}  // namespace geovor
