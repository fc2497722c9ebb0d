#include "surface/retraction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace geovor {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr UvVec kNoTurn{kInf, kInf};
const UvBox kBox{{0, 2}, {0, 2}};

// The line x = t^m, of speed m t^(m-1): a step along it is exact, whatever its length.
TEST(Retraction, FollowsALineThatStopsAtEitherEnd) {
  for (double m : {2.0, 3.0, 5.0}) {
    for (double t : {1e-6, 0.1, 1.0}) {
      for (double factor : {0.01, 0.5, 1.02, 1.9}) {
        const double way = (factor - 1.0) * std::pow(t, m);
        const LineSpeed u{m * std::pow(t, m - 1), (m - 1) / t, 0.0};
        const double expected = std::pow(factor, 1 / m) * t;
        EXPECT_NEAR(retract({t, 1}, way, 0, u, {1, 0, 0}, kBox, kNoTurn).uv.u, expected, 1e-14 * t);
        const LineSpeed back{u.h, -u.own, 0.0};
        EXPECT_NEAR(2 - retract({2 - t, 1}, -way, 0, back, {1, 0, 0}, kBox, kNoTurn).uv.u, expected, 1e-14);
        EXPECT_NEAR(length_from_stop(t, u, kBox.u), std::pow(t, m), 1e-14);
      }
    }
  }
}

TEST(Retraction, OnlyApproachesTheEndOfALine) {
  const double t = 0.5;
  const Retraction step = retract({t, 1}, -1.0, 0, {3 * t * t, 2 / t, 0}, {1, 0, 0}, kBox, kNoTurn);
  EXPECT_TRUE(step.u_blocked);
  EXPECT_FALSE(step.v_blocked);
  EXPECT_NEAR(std::pow(step.uv.u, 3), kApproach * std::pow(t, 3), 1e-15);
}

// Polar coordinates of the plane, u the angle and v the radius: |Su| = v, d ln|Su| / dv = 1 / v.
TEST(Retraction, IsAStepOfThePlaneInPolarCoordinates) {
  const double turn = 2 * std::acos(-1.0);
  for (double r : {1e-9, 0.1, 1.0}) {
    for (double along : {-0.9, 0.3, 5.0}) {
      for (double out : {-0.8, 0.2, 0.9}) {
        const Uv p{3.0, r};
        const Uv q =
            retract(p, along * r, out * r, {r, 0, 1 / r}, {1, 0, 0}, {{-kInf, kInf}, {0, 10}}, {turn, kInf}).uv;
        EXPECT_NEAR(q.v * std::cos(q.u - p.u), (1 + out) * r, 1e-14 * r);
        EXPECT_NEAR(q.v * std::sin(q.u - p.u), along * r, 1e-14 * r);
      }
    }
  }
}

TEST(Retraction, StaysInTheBox) {
  const Retraction step = retract({1, 1}, 50, -50, {1, 0, 0}, {1, 0, 0}, kBox, kNoTurn);
  EXPECT_EQ(step.uv, (Uv{2, 0}));
  EXPECT_FALSE(step.u_blocked || step.v_blocked);
}

}  // namespace
}  // namespace geovor
