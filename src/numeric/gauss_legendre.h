// Gauss-Legendre quadrature.
#pragma once

#include <vector>

#include "base/interval.h"

namespace geovor {

/// Nodes (ascending) and weights on [-1, 1]; exact for polynomials of degree 2 n - 1.
struct GaussRule {
  std::vector<double> nodes;
  std::vector<double> weights;
};

/// Largest number of nodes that gauss_legendre gives.
inline constexpr int kMaxGaussNodes = 64;

/// The rule of n nodes, to rounding. All rules are made once, at the first call; any thread may call.
/// REQUIRES: 1 <= n <= kMaxGaussNodes
const GaussRule& gauss_legendre(int n);

/// Integral of f over an interval by the rule of n nodes.
template <class Function>
double integrate(const Function& f, Interval over, int n) {
  const GaussRule& rule = gauss_legendre(n);
  const double middle = over.middle(), half = 0.5 * over.length();
  double sum = 0.0;
  for (int i = 0; i < n; ++i) sum += rule.weights[i] * f(middle + half * rule.nodes[i]);
  return half * sum;
}

}  // namespace geovor
