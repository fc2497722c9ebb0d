// p-curves as polylines of the parameter plane.
#pragma once

#include <vector>

#include "brep/border_chord.h"
#include "brep/model.h"

namespace geovor {

/// The chords of the coedge's p-curve in the order of travel; they know their pieces of the p-curve. `deflection`
/// bounds the way in space, to first order, from the p-curve to its chord: the metric of `surface` at the p-curve times
/// the deviation in the parameter plane (the curvature of the surface doesn't count). A straight p-curve gives one
/// chord, a curved one at least four. Throws Error(FaceRejected) where the p-curve is missing or gives a number that
/// isn't finite.
std::vector<BorderChord> flatten(const Surface& surface, const Coedge& coedge, double deflection);

}  // namespace geovor
