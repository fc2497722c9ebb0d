// Whether the border of a face is one: a surface that closes on itself without saying so has a seam that looks like it.
#pragma once

#include <vector>

#include "voronoi/face_border.h"

namespace geovor {

/// For each cycle of the border that runs along a seam of the surface, a place on that seam, within the face. A stretch
/// of border is a seam where FaceDomain knows it for one (an edge that the face uses twice), or where another stretch
/// lies in the same place in space, to the deflection of the domain. The surface declares no period there, else
/// FaceBorder would have left it out.
std::vector<Uv> seams_taken_for_border(const FaceDomain& domain, const FaceBorder& border);

}  // namespace geovor
