// The orthonormal frame in which directions at a point of a surface are told by an angle.
#pragma once

#include "surface/surface.h"

namespace geovor {

/// The point, e1 = Su/|Su|, e2 = n x e1 and the normal n = Su x Sv / |Su x Sv| (definition 3.2 of the paper with its
/// erratum).
struct TangentFrame {
  Xyz S, e1, e2, n;

  /// The unit tangent cos t e1 + sin t e2.
  Xyz at_angle(double t) const;
  /// The angle, in (-pi, pi], of a tangent vector of any length; of its part in the tangent plane, if it has another.
  double angle_of(const Xyz& w) const;
};

/// The frame at p. At a pole, and where a side is one point without being smooth (the tip of a cone), it is the limit
/// along the parameter line that runs into the side at p. Near a pole that has a chart, exact at any distance from it.
/// NaN where the surface has no tangent plane otherwise (a fold).
TangentFrame tangent_frame(const Surface& surface, Uv p);

}  // namespace geovor
