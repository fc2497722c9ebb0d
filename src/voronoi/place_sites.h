// Sites spread over a face, far from one another.
#pragma once

#include <cstdint>
#include <vector>

#include "brep/face_domain.h"

namespace geovor {

/// `count` places in the face, each the farthest from those before it (and half as far from the border as from them)
/// among the nodes of a fine lattice, by geodesic distance; the seed picks the first. The same arguments give the same
/// places. Throws Error(Usage) where count is not positive, or the lattice has fewer nodes in the face.
std::vector<Uv> place_sites(const FaceDomain& domain, int count, std::uint64_t seed);

}  // namespace geovor
