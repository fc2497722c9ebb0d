#include "numeric/lobatto.h"

#include <gtest/gtest.h>

#include <cmath>

namespace geovor {
namespace {

TEST(LobattoRule, HasTheKnownNodesOfDegreeFour) {
  const LobattoRule rule = lobatto_rule(4);
  const double inner = std::sqrt(3.0 / 7.0);
  const double nodes[] = {-1.0, -inner, 0.0, inner, 1.0}, weights[] = {0.1, 49.0 / 90, 32.0 / 45, 49.0 / 90, 0.1};
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(rule.nodes[i], 0.5 * (1.0 + nodes[i]), 1e-15);
    EXPECT_NEAR(rule.weights[i], 0.5 * weights[i], 1e-15);
  }
}

TEST(LobattoRule, IntegratesPolynomialsOfTwiceTheDegreeLessOne) {
  for (const int degree : {2, 5, 10, 40}) {
    const LobattoRule rule = lobatto_rule(degree);
    for (const int power : {0, 1, degree, 2 * degree - 1})
      EXPECT_NEAR(rule.weights.dot(rule.nodes.array().pow(power).matrix()), 1.0 / (power + 1), 1e-14);
  }
}

TEST(LobattoRule, DifferentiatesAndInterpolatesPolynomials) {
  const LobattoRule rule = lobatto_rule(12);
  const Eigen::VectorXd f = rule.nodes.array().pow(9), df = rule.derivative * f;
  EXPECT_LT((df.array() - 9.0 * rule.nodes.array().pow(8)).abs().maxCoeff(), 1e-12);
  for (const double x : {0.0, 0.123, 0.77, 1.0}) EXPECT_NEAR(rule.interpolation(x) * f, std::pow(x, 9), 1e-14);
}

}  // namespace
}  // namespace geovor
