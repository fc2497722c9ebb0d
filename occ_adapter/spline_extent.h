// How far a piece of a spline surface or curve reaches in space: the hulls of its Bézier pieces, bisected.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <vector>

#include "base/interval.h"
#include "base/xyz.h"

namespace geovor::occ {

/// A box that grows, kept as two corners.
struct Extent {
  Xyz lower = Xyz::Constant(std::numeric_limits<double>::infinity());
  Xyz upper = Xyz::Constant(-std::numeric_limits<double>::infinity());

  bool is_void() const { return !(lower[0] <= upper[0]); }
  double diagonal() const { return is_void() ? 0.0 : (upper - lower).norm(); }
  void add(const Xyz& p) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
};

/// The poles of a spline surface that is not periodic; a curve is one of degree 0 along v, with one pole there.
struct SplinePoles {
  int p = 1, q = 0;             ///< degrees along u and v
  std::vector<double> u_knots;  ///< flat: each as often as it counts
  std::vector<double> v_knots;  ///< empty where q is 0
  int n_u = 0, n_v = 1;
  std::vector<Eigen::Vector4d> poles;  ///< (w x, w y, w z, w) of pole (i, j) at i * n_v + j, w > 0
  bool rational = false;
};

/// Grows `extent` by the points of the spline over `over` for which `inside` holds, to `tolerance`.
/// REQUIRES: the border of that part lies in `extent` already. What reaches beyond it then does so around a point where
/// a coordinate's derivatives vanish, and only there the hulls are bisected.
void grow(Extent& extent, const SplinePoles& spline, const UvBox& over, double tolerance,
          const std::function<bool(double u, double v)>& inside);

}  // namespace geovor::occ
