// An order of places in space that no shape and no parameterization has: what decides between equals.
#pragma once

#include <array>
#include <cmath>

#include "base/xyz.h"

namespace geovor {

/// Symmetric shapes are full of equals: four points on a circle, two points equally near. The one that comes first
/// along a generic direction is taken, after rounding far above the noise of the places. Where two places agree along
/// it, a second direction decides.
class PlaceOrder {
 public:
  using Key = std::array<long, 2>;

  /// `size`: the length of the edges between the places.
  explicit PlaceOrder(double size) : unit_(kRounding * size) {}

  Key key(const Xyz& x) const { return {std::lround(x.dot(first()) / unit_), std::lround(x.dot(second()) / unit_)}; }

  /// A unit vector, and one that is not parallel to it; neither lies in a plane that CAD parts are symmetric about.
  static Xyz first() { return {0.8017837257372732, 0.5345224838248488, 0.2672612419124244}; }
  static Xyz second() { return {0.1154700538379252, -0.8082903768654761, 0.5773502691896258}; }

 private:
  // Of the size. Places that ought to be equal differ by 1e-12 of it, different ones by much more.
  static constexpr double kRounding = 1e-6;
  double unit_;
};

}  // namespace geovor
