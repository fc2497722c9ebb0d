// Intervals of a parameter and the rectangles made of two of them.
#pragma once

#include <algorithm>

#include "base/uv.h"

namespace geovor {

/// A closed interval lo <= x <= hi. An end may be infinite.
struct Interval {
  double lo = 0.0;
  double hi = 0.0;

  constexpr double length() const { return hi - lo; }
  constexpr double middle() const { return 0.5 * (lo + hi); }
  constexpr bool contains(double x) const { return lo <= x && x <= hi; }
  constexpr double clamp(double x) const { return std::clamp(x, lo, hi); }
};

/// A rectangle of the parameter plane.
struct UvBox {
  Interval u;
  Interval v;

  constexpr bool contains(Uv p) const { return u.contains(p.u) && v.contains(p.v); }
  constexpr Uv clamp(Uv p) const { return {u.clamp(p.u), v.clamp(p.v)}; }
};

}  // namespace geovor
