// Triangles between the points of a face: each point finds its Delaunay neighbours, and what they agree upon is the
// mesh.
#pragma once

#include <optional>
#include <vector>

#include "delaunay/half_edges.h"
#include "delaunay/mesh_border.h"
#include "delaunay/mesh_vertex.h"

namespace geovor {

/// The triangles on which the stars of the points agree. The star of a point is that of a Delaunay triangulation in its
/// tangent plane, where its neighbours lie in their directions at their geodesic distances; at the border it reaches
/// from the next border point to the one before. Corners counter-clockwise about the normals. Small gaps, where stars
/// do not agree, are filled. Nothing if what comes out is not one surface with this border, which happens where the
/// points lie too far apart for the shape.
///
/// `points`: those of `border` first. Points that no triangle needs may be left over. `size`: of the edges, for ties.
std::optional<HalfEdges> triangulate_by_stars(const std::vector<MeshVertex>& points, const MeshBorder& border,
                                              double size);

}  // namespace geovor
