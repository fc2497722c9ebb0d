// p-curves as polylines of the parameter plane.
#pragma once

#include <vector>

#include "brep/model.h"

namespace geovor {

/// The points of the coedge's p-curve in the order of travel, both ends included. `deflection` bounds the way in space,
/// to first order, from the p-curve to its chord: the metric of `surface` at the p-curve times the deviation in the
/// parameter plane (the curvature of the surface doesn't count). A straight p-curve gives its two ends, a curved one at
/// least four chords a coedge.
/// Throws Error(FaceRejected) where the p-curve is missing or gives a number that isn't finite.
std::vector<Uv> flatten(const Surface& surface, const Coedge& coedge, double deflection);

}  // namespace geovor
