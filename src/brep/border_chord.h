// A chord of the flattened border, with the piece of the true border that it stands for.
#pragma once

#include "base/interval.h"
#include "surface/curve.h"

namespace geovor {

/// From a to b in the order of travel, the face to the left. Where the p-curve is not straight it belongs to the chord:
/// curve(from) = a, curve(to) = b, analytic in between. The curve is owned by who made the chord.
struct BorderChord {
  Uv a, b;
  const Curve2* curve = nullptr;  ///< null: the border is the chord itself
  double from = 0.0, to = 0.0;
  bool ends_face = true;  ///< false where the CAD has a seam or a pole

  /// The point of the true border at fraction f of the chord's parameters.
  Uv at(double f) const {
    if (f == 0.0) return a;
    if (f == 1.0) return b;
    if (!curve) return lerp(a, b, f);
    const Eigen::Vector2d c = curve->position(from + f * (to - from));
    return {c[0], c[1]};
  }

  /// Its derivative with respect to f; the chord's where the curve's own vanishes.
  UvVec direction(double f) const {
    if (!curve) return b - a;
    const CurvePiece piece = curve->piece(0.5 * (from + to), 1.0);
    const Eigen::Vector2d d = (to - from) * curve->jet(from + f * (to - from), piece).d1;
    return d.squaredNorm() > 0.0 ? UvVec{d[0], d[1]} : b - a;
  }

  /// The part between two fractions.
  BorderChord part(double f0, double f1) const {
    return {at(f0), at(f1), curve, from + f0 * (to - from), f1 == 1.0 ? to : from + f1 * (to - from), ends_face};
  }
};

}  // namespace geovor
