// Parametric curves of the plane and of space: the CAD's edges and their images in the parameter plane.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "base/interval.h"

namespace geovor {

/// Value and derivatives of a curve, up to the third order.
template <int Dim>
struct CurveJet {
  Eigen::Matrix<double, Dim, 1> C, d1, d2, d3;
};

/// A piece of a curve on which it is one analytic function; `box` are its ends, infinite where it has none.
struct CurvePiece {
  int index = 0;
  Interval box{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
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

  /// The period of a closed curve that takes any parameter.
  virtual std::optional<double> period() const { return std::nullopt; }

  /// Parameters strictly inside `range` where the curve is not analytic (knots), ascending.
  virtual std::vector<double> breaks(Interval range) const {
    (void)range;
    return {};
  }

  /// The analytic piece that holds t; between two pieces the one into which the sign of `towards` points.
  virtual CurvePiece piece(double t, double towards) const {
    (void)t, (void)towards;
    return {};
  }

  /// The jet of one piece, also beyond its ends.
  virtual CurveJet<Dim> jet(double t, const CurvePiece& piece) const {
    (void)piece;
    return jet(t);
  }

  /// Smallest order of continuity between pieces; kSmooth where the curve is analytic.
  static constexpr int kSmooth = 99;
  virtual int continuity() const { return kSmooth; }
};

using Curve2 = Curve<2>;
using Curve3 = Curve<3>;
using Curve2Ptr = std::shared_ptr<const Curve2>;
using Curve3Ptr = std::shared_ptr<const Curve3>;

}  // namespace geovor
