// Polylines of a page without the points that no eye can miss.
#pragma once

#include <vector>

#include "io/picture_projection.h"

namespace geovor {

/// The ends and, between them, what keeps the line within `tolerance` (page units) of what it was (Douglas and Peucker
/// 1973). A line that closes keeps a point far from its ends.
std::vector<PagePoint> thin_line(const std::vector<PagePoint>& line, double tolerance);

}  // namespace geovor
