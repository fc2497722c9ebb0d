// A triangulation of a polygon with holes in the plane that keeps every border segment: where a face's triangulation
// starts.
#pragma once

#include <string>
#include <vector>

#include "base/uv.h"
#include "delaunay/half_edges.h"

namespace geovor {

struct PolygonTriangulation {
  bool ok = false;
  std::string why;              ///< if not ok: "the border crosses itself", …
  std::vector<int> bad_points;  ///< if not ok: ends of the segments concerned, to be resolved more finely by the caller
  HalfEdges triangles;  ///< vertex i is point i, loops one after another, then `inner`; border edges have no twin
};

/// Triangulates the region that the closed polylines bound by the even-odd rule; segments run between successive points
/// of a loop and from its last to its first. Points of `inner` that lie in the region become vertices; those outside
/// it, on its border or on each other are left without a triangle. The Delaunay criterion of the plane is used to avoid
/// needless slivers, but no more is promised than that the triangles are valid: orientation is decided exactly, on
/// coordinates rounded to 2^-30 of the bounding box (times `aspect` = height over width that the caller wishes the box
/// to be seen with).
PolygonTriangulation triangulate_polygon(const std::vector<std::vector<Uv>>& loops, const std::vector<Uv>& inner,
                                         double aspect);

}  // namespace geovor
