// The way along a curve as a function of its parameter, and back.
#pragma once

#include <vector>

#include "surface/curve.h"

namespace geovor {

/// Good to about 1e-13 of the length (of the coordinates, where these are larger), whatever the parameter's speed does,
/// also where it vanishes: the same places on the same curve under any parameterization. The curve outlives it.
class ArcLength {
 public:
  ArcLength(const Curve3& curve, Interval range);

  /// NaN where the curve's derivative is.
  double length() const { return s_.back(); }
  /// The way from the start to a parameter of the range.
  double at(double t) const;
  /// The parameter at the way s from the start; the range's ends for s <= 0 and s >= length().
  double parameter(double s) const;

 private:
  void add(double lo, double hi, double whole, int depth);

  const Curve3& curve_;
  double exact_ = 0.0;         ///< a difference of lengths below this is rounding
  std::vector<double> t_, s_;  ///< ends of pieces over which Gauss' rule is exact
};

}  // namespace geovor
