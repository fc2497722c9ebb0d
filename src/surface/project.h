// The point of a surface nearest to a point of space.
#pragma once

#include "surface/surface.h"

namespace geovor {

struct Projection {
  Uv uv;
  Xyz foot;
  double distance = 0.0;  ///< |foot - point|
  bool converged =
      false;  ///< the residual is orthogonal to the surface, to rounding, or uv lies on the border of `box`
};

/// Newton's method (with Gauss-Newton as the fallback) from `guess`, kept inside `box` in the non-periodic directions.
Projection project_near(const Surface& surface, const Xyz& point, Uv guess, const UvBox& box);

/// The nearest foot over the whole of `box`: project_near from the best points of a grid that is finer where the
/// surface has more spans.
Projection project(const Surface& surface, const Xyz& point, const UvBox& box);

}  // namespace geovor
