// A placement: where a curve or a surface of closed form stands in space.
#pragma once

#include "base/xyz.h"

namespace geovor {

/// Origin and three orthonormal axes. All three are kept because a CAD's placement may be left-handed
/// (y = -(z cross x)).
struct Frame {
  Xyz origin = Xyz::Zero();
  Xyz x = Xyz::UnitX();
  Xyz y = Xyz::UnitY();
  Xyz z = Xyz::UnitZ();

  /// Space coordinates of the point with the coordinates `local` in this frame.
  Xyz to_space(const Xyz& local) const { return origin + local.x() * x + local.y() * y + local.z() * z; }
  /// Coordinates in this frame of a point of space.
  Xyz to_local(const Xyz& point) const {
    const Xyz d = point - origin;
    return {d.dot(x), d.dot(y), d.dot(z)};
  }
};

}  // namespace geovor
