#include "numeric/gauss_legendre.h"

#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace geovor {
namespace {

struct Legendre {
  double value, derivative;
};

// P_n and P_n' at |x| < 1 by the three-term recurrence.
Legendre legendre(int n, double x) {
  double previous = 1.0, current = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * current - (k - 1) * previous) / k;
    previous = current;
    current = next;
  }
  return {current, n * (previous - x * current) / (1.0 - x * x)};
}

// Newton from Tricomi's guess, whose error of O(n^-4) is squared at each step: three steps reach rounding for every n,
// the fourth is the margin.
GaussRule make_rule(int n) {
  constexpr int kNewtonSteps = 4;
  GaussRule rule{std::vector<double>(n), std::vector<double>(n)};
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    if (2 * i + 1 == n) x = 0.0;
    for (int step = 0; step < kNewtonSteps; ++step) {
      const Legendre P = legendre(n, x);
      x -= P.value / P.derivative;
    }
    const double d = legendre(n, x).derivative;
    rule.nodes[i] = x;
    rule.weights[i] = 2.0 / ((1.0 - x * x) * d * d);
  }
  return rule;
}

}  // namespace

const GaussRule& gauss_legendre(int n) {
  assert(n >= 1 && n <= kMaxGaussNodes);
  static const std::array<GaussRule, kMaxGaussNodes + 1> rules = [] {
    std::array<GaussRule, kMaxGaussNodes + 1> all;
    for (int k = 1; k <= kMaxGaussNodes; ++k) all[k] = make_rule(k);
    return all;
  }();
  return rules[n];
}

}  // namespace geovor
