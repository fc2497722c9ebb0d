// The worst of what was measured, where std::max and std::min would let a NaN go by.
#pragma once

#include <cmath>

namespace geovor {

/// The larger of the two; NaN where one of them is.
inline double larger_of(double a, double b) { return a >= b || std::isnan(a) ? a : b; }

/// The smaller of the two; NaN where one of them is.
inline double smaller_of(double a, double b) { return a <= b || std::isnan(a) ? a : b; }

}  // namespace geovor
