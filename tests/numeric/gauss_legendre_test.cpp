#include "numeric/gauss_legendre.h"

#include <gtest/gtest.h>

#include <cmath>

namespace geovor {
namespace {

// The integral of x^k over [-1, 1] is 2 / (k + 1) for even k and 0 for odd k.
TEST(GaussLegendre, IntegratesPolynomialsUpToDegree2nMinus1) {
  for (int n = 1; n <= kMaxGaussNodes; ++n) {
    for (int k : {0, 1, 2, n - 1, n, 2 * n - 2, 2 * n - 1}) {
      if (k > 2 * n - 1) continue;
      const double exact = k % 2 == 0 ? 2.0 / (k + 1) : 0.0;
      EXPECT_NEAR(integrate([k](double x) { return std::pow(x, k); }, {-1.0, 1.0}, n), exact, 1e-14) << n << " " << k;
    }
  }
}

TEST(GaussLegendre, IsNotExactBeyondThatDegree) {
  EXPECT_GT(std::abs(integrate([](double x) { return std::pow(x, 4); }, {-1.0, 1.0}, 2) - 0.4), 0.1);
}

TEST(GaussLegendre, IsTheTextbooksRuleOfTwoAndThreeNodes) {
  const GaussRule& two = gauss_legendre(2);
  EXPECT_NEAR(two.nodes[1], 1.0 / std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(two.weights[0], 1.0, 1e-15);
  const GaussRule& three = gauss_legendre(3);
  EXPECT_EQ(three.nodes[1], 0.0);
  EXPECT_NEAR(three.nodes[2], std::sqrt(0.6), 1e-15);
  EXPECT_NEAR(three.weights[1], 8.0 / 9.0, 1e-15);
}

TEST(GaussLegendre, NodesAscendAndAreSymmetric) {
  for (int n = 1; n <= kMaxGaussNodes; ++n) {
    const GaussRule& rule = gauss_legendre(n);
    for (int i = 0; i < n; ++i) {
      if (i > 0) {
        EXPECT_LT(rule.nodes[i - 1], rule.nodes[i]);
      }
      EXPECT_NEAR(rule.nodes[i], -rule.nodes[n - 1 - i], 1e-15);
      EXPECT_GT(rule.weights[i], 0.0);
    }
  }
}

TEST(Integrate, FindsTheIntegralOfTheExponential) {
  EXPECT_NEAR(integrate([](double x) { return std::exp(x); }, {-1.0, 3.0}, 20), std::exp(3.0) - std::exp(-1.0), 1e-13);
}

}  // namespace
}  // namespace geovor
