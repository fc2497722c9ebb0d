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

/// The foot near `guess`, by Newton's method (with Gauss-Newton as the fallback), kept inside `box` in the non-periodic
/// directions. The guess may lie anywhere within about a third of a radius of curvature of the foot, in space: also at
/// a pole, or on a side of the box along which Su or Sv vanishes. Where the nearest point lies beyond the box, the foot
/// is the nearest one on its border, and exactly on it. (A line that stops inside the box, or at the seam of a closed
/// surface, is not looked for.)
Projection project_near(const Surface& surface, const Xyz& point, Uv guess, const UvBox& box);

/// The nearest foot over the whole of `box`: project_near from the best points of a grid that is finer where the
/// surface has more spans.
Projection project(const Surface& surface, const Xyz& point, const UvBox& box);

}  // namespace geovor
