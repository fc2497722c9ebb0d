// The length that a mesh edge is to have at a place.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace geovor {

/// The smallest of the rules that the user gave. Curvature is the surface's, so the rule is the same under any
/// parameterization.
struct SizeRule {
  double size = 1.0;                                            ///< nowhere longer than this
  double min_size = 0.0;                                        ///< no rule asks for less than this
  double deflection = std::numeric_limits<double>::infinity();  ///< largest distance from a triangle to the surface
  double angle = std::numeric_limits<double>::infinity();       ///< largest turn of the normal across an edge, radians
  double gradation = 0.5;                                       ///< Lipschitz constant of the size over distance

  /// `curvature`: the largest |normal curvature|, 1/length.
  double at(double curvature) const {
    if (!(curvature > 0.0)) return size;
    // A triangle may have the circumradius 0.8 h; over a circle of curvature k its middle lies k (0.8 h)^2 / 2 below
    // the arc, a little less than k h^2 / 3.
    const double h = std::min({size, angle / curvature, std::sqrt(3.0 * deflection / curvature)});
    return std::max(h, std::min(min_size, size));
  }
};

}  // namespace geovor
