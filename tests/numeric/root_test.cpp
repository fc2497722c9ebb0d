#include "numeric/root.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace geovor {
namespace {

TEST(RootBetween, FindsRootsToTheTolerance) {
  EXPECT_NEAR(root_between([](double x) { return std::cos(x); }, 0.0, 3.0, 1e-15), 0.5 * std::numbers::pi, 2e-15);
  EXPECT_NEAR(root_between([](double x) { return 2.0 - x * x; }, 1.0, 2.0, 1e-15), std::numbers::sqrt2, 2e-15);
  EXPECT_NEAR(root_between([](double x) { return std::exp(x) - 1e6; }, 0.0, 100.0, 1e-13), std::log(1e6), 2e-13);
}

// A triple root, and one where false position alone would creep along.
TEST(RootBetween, IsNotSlowOnFlatFunctions) {
  int calls = 0;
  auto cube = [&calls](double x) { return ++calls, (x - 0.3) * (x - 0.3) * (x - 0.3); };
  EXPECT_NEAR(root_between(cube, 0.0, 1.0, 1e-12), 0.3, 1e-12);
  EXPECT_LT(calls, 130);
  calls = 0;
  auto steep = [&calls](double x) { return ++calls, std::pow(x, 21) - 1e-9; };
  EXPECT_NEAR(root_between(steep, 0.0, 2.0, 1e-13), std::pow(1e-9, 1.0 / 21.0), 1e-13);
  EXPECT_LT(calls, 130);
}

TEST(RootBetween, TakesAnEndWhereItVanishesOrTheSignsAreTheSame) {
  EXPECT_EQ(root_between([](double x) { return x - 1.0; }, 1.0, 2.0, 1e-12), 1.0);
  EXPECT_EQ(root_between([](double x) { return x - 2.0; }, 1.0, 2.0, 1e-12), 2.0);
  EXPECT_EQ(root_between([](double x) { return x; }, 1.0, 2.0, 1e-12), 1.0);
  EXPECT_EQ(root_between([](double x) { return -3.0 + x; }, 1.0, 2.0, 1e-12), 2.0);
}

TEST(RootBetween, EndsWhereTheFunctionIsNowhereANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double s = root_between([nan](double) { return nan; }, 0.0, 1.0, 1e-12);
  EXPECT_TRUE(s == 0.0 || s == 1.0);
}

}  // namespace
}  // namespace geovor
