// The difference of two angles, less whole half turns, without the loss of digits next to the seam.
#pragma once

#include <cmath>
#include <numbers>

namespace geovor {

/// to - from - half_turns * pi, to a rounding of the result. What the rounding of `to - from` and of pi as a double
/// lose is added again, so that two points on either side of the seam, or opposite ones, keep all digits of what lies
/// between them. REQUIRES: half_turns is a whole number below 2^50
inline double angle_difference(double from, double to, double half_turns) {
  constexpr double kPi = std::numbers::pi;
  constexpr double kPiRest = 1.2246467991473532e-16;  // pi - kPi
  const double d = to - from;
  const double d_plus_from = d + from;  // Knuth's two-sum for to + (-from)
  const double lost = (to - d_plus_from) + ((d_plus_from - d) - from);
  return std::fma(-half_turns, kPi, d) + (lost - half_turns * kPiRest);
}

/// The even number of half turns that brings to - from nearest to `near`.
inline double whole_turns(double from, double to, double near) {
  return 2.0 * std::round((to - from - near) / (2.0 * std::numbers::pi));
}

/// to - from + 2 pi k for the whole k that brings it nearest to `near`, to a rounding of the result.
inline double nearest_turn(double from, double to, double near) {
  return angle_difference(from, to, whole_turns(from, to, near));
}

/// The next one after `turn` (a result of nearest_turn) by size that goes the other way round.
inline double other_way_round(double from, double to, double turn) {
  return nearest_turn(from, to, turn - std::copysign(2.0 * std::numbers::pi, turn));
}

}  // namespace geovor
