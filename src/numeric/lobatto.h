// Legendre-Gauss-Lobatto nodes on [0, 1]: polynomial interpolation, differentiation and quadrature that include both
// ends.
#pragma once

#include <Eigen/Core>

namespace geovor {

/// degree + 1 nodes, ascending from 0 to 1; quadrature is exact up to the degree 2 degree - 1.
struct LobattoRule {
  Eigen::VectorXd nodes;
  Eigen::VectorXd weights;      ///< of the quadrature over [0, 1]
  Eigen::VectorXd barycentric;  ///< weights of the barycentric formula
  Eigen::MatrixXd derivative;   ///< values at the nodes -> derivatives at the nodes

  /// The row that takes values at the nodes to the interpolating polynomial's value at x.
  Eigen::RowVectorXd interpolation(double x) const;
};

/// REQUIRES: degree >= 2.
LobattoRule lobatto_rule(int degree);

}  // namespace geovor
