// Which triangles of a picture are seen, and in which order to paint them.
#pragma once

#include <array>
#include <vector>

#include "io/picture_projection.h"

namespace geovor {

using PageTriangle = std::array<PagePoint, 3>;

/// The triangles that are seen somewhere on a page of width by height, in an order in which each is painted over those
/// that it hides; decided at the middles of the page's unit squares. Where triangles hide one another in a ring, by
/// their depth. Triangles seen edge-on are left out.
std::vector<int> painting_order(const std::vector<PageTriangle>& triangles, int width, int height);

}  // namespace geovor
