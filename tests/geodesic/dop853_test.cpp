#include "numeric/dop853.h"

#include <gmock/gmock.h>

#include <Eigen/Core>
#include <cmath>

namespace geovor {
namespace {

using dop853::kA;
using dop853::kB;
using dop853::kStages;

double node(int i) {
  double c = 0.0;
  for (int j = 0; j < i; ++j) c += kA[i][j];
  return c;
}

TEST(Dop853, NodesAreThoseOfTheBook) {
  const double nodes[kStages] = {0.0,     0.0,      0.0,         0.0,     0.0,     1.0 / 3,
                                 1.0 / 4, 4.0 / 13, 127.0 / 195, 3.0 / 5, 6.0 / 7, 1.0};
  for (const int i : {0, 5, 6, 7, 8, 9, 10, 11}) EXPECT_NEAR(node(i), nodes[i], 1e-14) << i;
}

TEST(Dop853, WeightsIntegratePowersUpToTheSeventh) {
  for (int power = 0; power <= 7; ++power) {
    double sum = 0.0;
    for (int i = 0; i < kStages; ++i) sum += kB[i] * std::pow(node(i), power);
    EXPECT_NEAR(sum, 1.0 / (power + 1), 1e-14) << power;
  }
}

// The order conditions of the tall trees [t, [t, ...]]: sum b_i c_i^k a_ij c_j^l = 1 / ((l + 1) (k + l + 2)).
TEST(Dop853, WeightsMeetTheOrderConditionsOfTwoLevels) {
  for (int k = 0; k <= 6; ++k) {
    for (int l = 0; k + l <= 6; ++l) {
      double sum = 0.0;
      for (int i = 0; i < kStages; ++i)
        for (int j = 0; j < i; ++j) sum += kB[i] * std::pow(node(i), k) * kA[i][j] * std::pow(node(j), l);
      EXPECT_NEAR(sum, 1.0 / ((l + 1.0) * (k + l + 2.0)), 1e-13) << k << ' ' << l;
    }
  }
}

TEST(Dop853, EmbeddedWeightsIntegratePowersOfTheirOrder) {
  for (int power = 0; power <= 4; ++power) {
    double fifth = 0.0;
    for (int i = 0; i < kStages; ++i) fifth += dop853::kError5[i] * std::pow(node(i), power);
    EXPECT_NEAR(fifth, 0.0, 1e-14) << power;
  }
}

// x'' = -x and, to have a nonlinear equation, x' = x^2 beside it.
Eigen::Vector3d oscillate(const Eigen::Vector3d& x) { return {x[1], -x[0], x[2] * x[2]}; }

double error_after_unit_time(int steps) {
  Eigen::Vector3d x(0.0, 1.0, 0.5);
  for (int i = 0; i < steps; ++i) x = dop853::step(x, oscillate(x), 1.0 / steps, oscillate).state;
  return (x - Eigen::Vector3d(std::sin(1.0), std::cos(1.0), 1.0)).norm();
}

TEST(Dop853, ErrorFallsAtTheEighthOrder) {
  const double coarse = error_after_unit_time(2), fine = error_after_unit_time(4);
  EXPECT_GT(std::log2(coarse / fine), 7.5);
  EXPECT_LT(error_after_unit_time(16), 1e-14);
}

TEST(Dop853, EstimateBoundsTheErrorOfAStep) {
  const Eigen::Vector3d x(0.0, 1.0, 0.5);
  for (const double h : {0.5, 0.25, 0.125}) {
    const auto step = dop853::step(x, oscillate(x), h, oscillate);
    const Eigen::Vector3d exact(std::sin(h), std::cos(h), 1.0 / (2.0 - h));
    EXPECT_GT(dop853::error_estimate(step.error5.norm()), (step.state - exact).norm()) << h;
  }
}

TEST(Dop853, EstimateOfNanIsNan) { EXPECT_TRUE(std::isnan(dop853::error_estimate(std::nan("")))); }

}  // namespace
}  // namespace geovor
