#include "geodesic/distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geodesic/graph_path.h"
#include "support/differences.h"
#include "support/geodesic_oracles.h"
#include "support/splines.h"
#include "surface/analytic_surfaces.h"
#include "surface/elementary_surfaces.h"

namespace geovor {
namespace {

using testing::random_point;
using testing::uniform;
constexpr double kPi = std::numbers::pi;
const UvBox kSquare{{-2.0, 2.0}, {-2.0, 2.0}};

double shortest(const Surface& surface, Uv p, Uv q) {
  const DistanceResult r = distance(surface, p, q);
  EXPECT_EQ(r.shortest.status, ConnectStatus::Converged);
  return r.shortest.length;
}

// The value is that of the design notes, found there by two other methods.
TEST(Distance, ToTheTopOfATallBumpIsTheKnownOne) {
  const GaussianBumps bump({{{0.0, 0.0}, 3.0, 0.3}}, kSquare);
  EXPECT_NEAR(shortest(bump, {1.2, 0.0}, {0.0, 0.0}), 3.482605402282, 2e-12);
  EXPECT_NEAR(shortest(bump, {0.0, 0.0}, {1.2, 0.0}), 3.482605402282, 2e-12);
}

TEST(Distance, GoesAroundATallBumpNotOverIt) {
  const GaussianBumps bump({{{0.0, 0.0}, 3.0, 0.3}}, kSquare);
  const double around = shortest(bump, {-1.5, 0.01}, {1.5, 0.0});
  EXPECT_GT(around, 3.0);
  EXPECT_LT(around, 3.6);  // over the top it is more than 7
  // Mirror images have equal lengths.
  EXPECT_NEAR(around, shortest(bump, {-1.5, -0.01}, {1.5, 0.0}), 1e-10);
}

TEST(Distance, IsAMetricOnTheWave) {
  const WaveSurface wave({{-4.0, 4.0}, {-4.0, 4.0}});
  std::mt19937 random(1);
  for (int i = 0; i < 40; ++i) {
    const Uv p = random_point(random, kSquare), q = random_point(random, kSquare), m = random_point(random, kSquare);
    const double d = shortest(wave, p, q);
    EXPECT_NEAR(d, shortest(wave, q, p), 1e-11 * d);
    EXPECT_LE(d, shortest(wave, p, m) + shortest(wave, m, q) + 1e-11);
    EXPECT_GE(d, testing::gap(wave, p, q));
  }
}

TEST(Distance, NoGraphPathIsShorter) {
  const WaveSurface wave({{-4.0, 4.0}, {-4.0, 4.0}});
  std::mt19937 random(2);
  for (int i = 0; i < 20; ++i) {
    const Uv p = random_point(random, kSquare), q = random_point(random, kSquare);
    double length = 0.0;
    const std::vector<Uv> path = graph_path(wave, p, q, wave.domain(), 150);
    for (std::size_t k = 1; k < path.size(); ++k)  // straight pieces of 1/20 cut corners by less than 1e-3
      length += testing::gap(wave, path[k - 1], path[k]);
    EXPECT_LT(shortest(wave, p, q), length * (1.0 + 2e-3));
    EXPECT_GT(shortest(wave, p, q), length * 0.9);
  }
}

TEST(Distance, TakesTheShorterWayRoundATorus) {
  const Torus torus({}, 3.0, 1.0);
  const BSplineSurface spline = testing::spline_torus(3.0, 1.0, true);
  // Along the outer equator, where the geodesics are circles: for short ways they are shortest.
  EXPECT_NEAR(shortest(torus, {0.1, 0.0}, {2.0 * kPi - 0.1, 0.0}), 0.8, 1e-12);
  // Meridians are geodesics, and the shortest between their own points up to half way.
  EXPECT_NEAR(shortest(torus, {1.0, 0.2}, {1.0, 2.0 * kPi - 0.4}), 0.6, 1e-12);
  EXPECT_NEAR(shortest(spline, {0.5, 0.5}, {0.5, 3.75}), shortest(spline, {0.5, 3.75}, {0.5, 0.5}), 1e-11);
}

TEST(Distance, ListsBothWaysRoundACylinder) {
  const Cylinder cylinder({}, 1.0);
  const DistanceResult r = distance(cylinder, {0.2, 0.0}, {6.0, 1.0});
  ASSERT_EQ(r.candidates.size(), 2u);
  EXPECT_NEAR(r.shortest.length, std::hypot(2.0 * kPi - 5.8, 1.0), 1e-14);
  EXPECT_NEAR(r.candidates[1].length, std::hypot(5.8, 1.0), 1e-14);
}

TEST(Distance, WavyVaseIsSymmetricAboutItsAxis) {
  const testing::WavyVase vase;
  std::mt19937 random(3);
  for (int i = 0; i < 15; ++i) {
    const double u = uniform(random, 0.3, 6.0), a = uniform(random, -1.0, 1.0), b = uniform(random, -1.0, 1.0);
    const double d = shortest(vase, {0.0, a}, {u, b});
    EXPECT_NEAR(d, shortest(vase, {5.0, a}, {5.0 - u, b}), 1e-10);
    EXPECT_NEAR(d, shortest(vase, {1.0, a}, {1.0 + u - 2.0 * kPi, b}), 1e-10);
  }
}

TEST(Distance, OfAPointToItselfIsZero) {
  const WaveSurface wave(kSquare);
  EXPECT_EQ(shortest(wave, {0.5, 0.5}, {0.5, 0.5}), 0.0);
}

}  // namespace
}  // namespace geovor
