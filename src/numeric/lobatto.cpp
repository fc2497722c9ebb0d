#include "numeric/lobatto.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace geovor {
namespace {

// P_n(x) and P_(n-1)(x) by the three-term recurrence.
std::pair<double, double> legendre(int n, double x) {
  double before = 1.0, value = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
    before = value;
    value = next;
  }
  return {value, before};
}

// Interior nodes are the zeros of P_n'. With (1 - x^2) P_n' = n (P_(n-1) - x P_n) and Legendre's equation, Newton's
// step for (1 - x^2) P_n' is (P_(n-1) - x P_n) / ((n + 1) P_n).
double interior_node(int n, int i) {
  constexpr int kIterations = 30;
  constexpr double kSettled = 1e-16;               // below the rounding of a node
  double x = -std::cos(std::numbers::pi * i / n);  // the Chebyshev nodes are close
  for (int k = 0; k < kIterations; ++k) {
    const auto [p, before] = legendre(n, x);
    const double step = (before - x * p) / ((n + 1) * p);
    x += step;
    if (!(std::abs(step) > kSettled)) break;
  }
  return x;
}

}  // namespace

LobattoRule lobatto_rule(int degree) {
  const int n = degree, count = n + 1;
  LobattoRule rule;
  rule.nodes.resize(count);
  rule.weights.resize(count);
  rule.barycentric.resize(count);
  rule.derivative.resize(count, count);
  for (int i = 0; i < count; ++i) {
    const double x = i == 0 ? -1.0 : i == n ? 1.0 : interior_node(n, i);
    const double p = legendre(n, x).first;
    rule.nodes[i] = 0.5 * (1.0 + x);
    rule.weights[i] = 1.0 / (n * count * p * p);  // half of 2 / (n (n + 1) P_n^2): [0, 1] is half as long
    rule.barycentric[i] = 1.0 / p;                // up to a common factor: the known form for these nodes
  }
  for (int i = 0; i < count; ++i) {
    double diagonal = 0.0;  // a constant has the derivative zero
    for (int j = 0; j < count; ++j) {
      if (i == j) continue;
      rule.derivative(i, j) = rule.barycentric[j] / rule.barycentric[i] / (rule.nodes[i] - rule.nodes[j]);
      diagonal -= rule.derivative(i, j);
    }
    rule.derivative(i, i) = diagonal;
  }
  return rule;
}

Eigen::RowVectorXd LobattoRule::interpolation(double x) const {
  Eigen::RowVectorXd row(nodes.size());
  for (int j = 0; j < nodes.size(); ++j) {
    if (x == nodes[j]) return Eigen::RowVectorXd::Unit(nodes.size(), j);
    row[j] = barycentric[j] / (x - nodes[j]);
  }
  return row / row.sum();
}

}  // namespace geovor
