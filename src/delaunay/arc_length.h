// The way along a curve as a function of its parameter, and back.
#pragma once

#include <array>
#include <vector>

#include "base/interval.h"
#include "surface/curve.h"

namespace geovor {

/// Good to about 1e-13 of the length (of the coordinates, where these are larger), whatever the parameter's speed does,
/// also where it vanishes: the same places on the same curve under any parameterization. The curve outlives it.
class ArcLength {
 public:
  ArcLength(const Curve3& curve, Interval range);

  /// NaN where the curve's derivative is.
  double length() const { return length_; }
  /// The way from the start to a parameter of the range.
  double at(double t) const;
  /// The parameter at the way s from the start; the range's ends for s <= 0 and s >= length().
  double parameter(double s) const;

 private:
  static constexpr int kNodes = 10;
  /// A piece on which the speed is a polynomial, by its Legendre coefficients over the piece.
  struct Piece {
    Interval range;
    double way = 0.0;  ///< from the start of the curve
    double length = 0.0;
    std::array<double, kNodes> speed{};
    double at(double x) const;  ///< the way from the piece's start to x in [-1, 1]
  };
  Piece piece(Interval range) const;
  void add(const Piece& whole, int depth);

  const Curve3& curve_;
  double exact_ = 0.0;  ///< a difference of lengths below this is rounding
  double length_ = 0.0;
  std::vector<Piece> pieces_;
};

}  // namespace geovor
