#include "numeric/chebyshev.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace geovor {
namespace {

template <class F>
ChebyshevSeries series(Interval over, int n, const F& f) {
  std::vector<double> values;
  for (int k = 0; k < n; ++k) values.push_back(f(ChebyshevSeries::node(over, k, n)));
  return {over, values};
}

const Interval kOver{-0.5, 3.0};

TEST(ChebyshevSeries, NodesAscendInsideTheInterval) {
  double last = kOver.lo;
  for (int k = 0; k < 9; ++k) {
    const double x = ChebyshevSeries::node(kOver, k, 9);
    EXPECT_GT(x, last);
    last = x;
  }
  EXPECT_LT(last, kOver.hi);
}

// n values determine a polynomial of degree n - 1, everywhere; its coefficients beyond the degree vanish.
TEST(ChebyshevSeries, IsThePolynomialThroughItsValues) {
  auto f = [](double x) { return 1.0 + x * (2.0 + x * (-3.0 + x * 0.5)); };
  for (int n = 4; n <= 12; ++n) {
    const ChebyshevSeries s = series(kOver, n, f);
    for (double x = -0.7; x < 3.2; x += 0.05) EXPECT_NEAR(s(x), f(x), 1e-13) << n;
    if (n > 4) {
      EXPECT_LT(s.tail(n - 4), 1e-14) << n;
    }
  }
  EXPECT_GT(series(kOver, 4, f).tail(1), 0.1);
}

// T_3 on [-1, 1] has the one coefficient 1.
TEST(ChebyshevSeries, TailIsTheLargestOfTheLastCoefficients) {
  const ChebyshevSeries s = series({-1.0, 1.0}, 6, [](double x) { return x * (4.0 * x * x - 3.0); });
  EXPECT_LT(s.tail(2), 1e-15);
  EXPECT_NEAR(s.tail(3), 1.0, 1e-15);
  EXPECT_NEAR(s.tail(100), 1.0, 1e-15);
}

// The error of an analytic function falls geometrically, and the tail with it.
TEST(ChebyshevSeries, OfAnAnalyticFunctionReachesRoundingAndItsTailSaysWhen) {
  auto f = [](double x) { return std::exp(std::sin(x)); };
  for (const int n : {8, 16, 24, 32}) {
    const ChebyshevSeries s = series(kOver, n, f);
    double error = 0.0;
    for (double x = kOver.lo; x <= kOver.hi; x += 0.01) error = std::max(error, std::abs(s(x) - f(x)));
    EXPECT_LT(error, 10.0 * s.tail(3) + 1e-14) << n;
    EXPECT_GT(error, 1e-3 * s.tail(3)) << n;
  }
  EXPECT_LT(series(kOver, 40, f).tail(3), 1e-14);
}

TEST(ChebyshevSeries, WithoutValuesIsZero) {
  EXPECT_EQ(ChebyshevSeries()(1.0), 0.0);
  EXPECT_EQ(ChebyshevSeries().tail(3), 0.0);
}

}  // namespace
}  // namespace geovor
