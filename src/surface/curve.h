// Parametric curves of the plane and of space: the CAD's edges and their images in the parameter plane.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "base/interval.h"

namespace geovor {

/// Value and derivatives of a curve, up to the third order.
template <int Dim>
struct CurveJet {
  Eigen::Matrix<double, Dim, 1> C, d1, d2, d3;
};

/// A curve c(t). Immutable.
template <int Dim>
class Curve {
 public:
  using Point = Eigen::Matrix<double, Dim, 1>;
  virtual ~Curve() = default;

  /// Where the curve is defined; may be infinite (a line).
  virtual Interval domain() const = 0;
  virtual CurveJet<Dim> jet(double t) const = 0;
  virtual Point position(double t) const { return jet(t).C; }

  /// Parameters strictly inside `range` where the curve is not analytic (knots), ascending.
  virtual std::vector<double> breaks(Interval range) const {
    (void)range;
    return {};
  }
};

using Curve2 = Curve<2>;
using Curve3 = Curve<3>;
using Curve2Ptr = std::shared_ptr<const Curve2>;
using Curve3Ptr = std::shared_ptr<const Curve3>;

}  // namespace geovor
