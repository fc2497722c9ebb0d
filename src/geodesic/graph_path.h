// A rough shortest path on a coarse grid: where a search for the shortest geodesic starts when the straight line
// misleads.
#pragma once

#include <vector>

#include "surface/surface.h"

namespace geovor {

/// The shortest path from `from` to `to`, or to a copy of it whole periods away, through the corners of a grid of
/// cells x cells over `box`; each corner is joined to its 16 nearest, and lengths are measured in space. A direction in
/// which `box` spans a whole period is closed to a ring. The path's points run on over the seam; its last is `to` or
/// the copy that was reached. Empty if nothing joins the two. REQUIRES: cells >= 4; `from` and `to` lie in `box`.
std::vector<Uv> graph_path(const Surface& surface, Uv from, Uv to, const UvBox& box, int cells);

}  // namespace geovor
