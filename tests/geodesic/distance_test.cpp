#include "geodesic/distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

// From p in 120 directions at five lengths: whatever geodesic within the domain shooting finds from any of them.
double brute_force(const Surface& surface, Uv p, Uv q, double length) {
  constexpr int kDirections = 120;
  ConnectOptions once;
  once.persist = false;
  once.tolerance = 1e-9;
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kDirections; ++i)
    for (const double k : {0.55, 0.75, 0.9, 0.97, 1.0}) {
      const Connection c = connect(surface, p, q, Polar{k * length, 2.0 * kPi * i / kDirections}, once);
      if (c.status == ConnectStatus::Converged && !c.leaves_domain) best = std::min(best, c.length);
    }
  return best;
}

TEST(Distance, NoBruteForceIsShorterOnTallBumps) {
  const GaussianBumps bump({{{0.0, 0.0}, 3.0, 0.3}}, kSquare);
  const GaussianBumps two({{{1.0, 0.2}, 3.0, 0.3}, {{-1.0, 0.2}, 3.0, 0.3}}, kSquare);
  std::mt19937 random(4);
  for (const Surface* surface : {static_cast<const Surface*>(&bump), static_cast<const Surface*>(&two)}) {
    const DistanceFinder finder(*surface);
    for (int i = 0; i < 60; ++i) {
      const Uv p = random_point(random, kSquare), q = random_point(random, kSquare);
      const DistanceResult r = finder.distance(p, q);
      ASSERT_EQ(r.status, ConnectStatus::Converged);
      EXPECT_NE(r.certainty, Certainty::None) << explain(r);
      EXPECT_GE(brute_force(*surface, p, q, r.shortest.length), r.shortest.length * (1.0 - 1e-8));
    }
  }
}

// Symmetric, and no detour by a third point is shorter: on closed surfaces, poles, seams and all.
TEST(Distance, IsAMetricOnClosedSurfaces) {
  const Torus torus({}, 3.0, 1.0);
  const Ellipsoid oblate(1.0, 1.0, 0.6), triaxial(1.0, 0.8, 0.6);
  const BSplineSurface spline = testing::spline_torus(3.0, 1.0, true);
  std::mt19937 random(5);
  for (const Surface* surface : {static_cast<const Surface*>(&torus), static_cast<const Surface*>(&oblate),
                                 static_cast<const Surface*>(&triaxial), static_cast<const Surface*>(&spline)}) {
    const DistanceFinder finder(*surface);
    const auto d = [&finder](Uv p, Uv q) {
      const DistanceResult r = finder.distance(p, q);
      EXPECT_NE(r.certainty, Certainty::None) << explain(r);
      return r.shortest.length;
    };
    for (int i = 0; i < 40; ++i) {
      const UvBox domain = surface->domain();
      const Uv p = random_point(random, domain), q = random_point(random, domain), m = random_point(random, domain);
      const double pq = d(p, q);
      EXPECT_NEAR(pq, d(q, p), 1e-10 * pq);
      EXPECT_LE(pq, d(p, m) + d(m, q) + 1e-10);
    }
  }
}

TEST(Distance, SaysWhyItIsCertain) {
  const WaveSurface wave({{-4.0, 4.0}, {-4.0, 4.0}});
  const DistanceFinder finder(wave);
  const DistanceResult near = finder.distance({0.1, 0.2}, {0.5, 0.4}), far = finder.distance({-3.0, -3.0}, {3.0, 2.5});
  EXPECT_EQ(near.certainty, Certainty::Curvature);
  EXPECT_GT(near.second_at_least, near.shortest.length);
  EXPECT_EQ(far.certainty, Certainty::Fan);
  EXPECT_EQ(distance(Cylinder({}, 1.0), {0.2, 0.0}, {1.0, 1.0}).certainty, Certainty::ClosedForm);
  for (const DistanceResult& r : {near, far}) EXPECT_EQ(explain(r).rfind("certain:", 0), 0u) << explain(r);
  DistanceOptions blind;
  blind.fan = false;
  const DistanceResult unsure = distance(wave, {-3.0, -3.0}, {3.0, 2.5}, blind);
  EXPECT_EQ(unsure.doubt, Doubt::NotSearched);
  EXPECT_EQ(explain(unsure).rfind("not certain:", 0), 0u);
}

// The curvature is at most 1 on the unit sphere, whose next geodesic goes round the other way.
TEST(Distance, CurvatureNeverPromisesMoreThanTheSphereKeeps) {
  const Ellipsoid sphere(1.0, 1.0, 1.0);
  const DistanceFinder finder(sphere);
  std::mt19937 random(6);
  for (int i = 0; i < 200; ++i) {
    const Uv p = random_point(random, {{0.0, 6.0}, {-0.8, 0.8}}), q = random_point(random, {{0.0, 6.0}, {-0.8, 0.8}});
    const DistanceResult r = finder.distance(p, q);
    if (r.certainty != Certainty::Curvature) continue;
    EXPECT_LE(r.second_at_least, 2.0 * kPi - r.shortest.length + 1e-12);
  }
}

TEST(Distance, GivesAllShortestPathsOnTheCutLocus) {
  const GaussianBumps bump({{{0.0, 0.0}, 3.0, 0.3}}, kSquare);
  const DistanceResult behind = distance(bump, {-1.5, 0.0}, {1.5, 0.0});
  ASSERT_EQ(behind.shortest_paths.size(), 2u);  // mirror images
  EXPECT_NEAR(behind.shortest_paths[0].angle, -behind.shortest_paths[1].angle, 1e-9);
  EXPECT_FALSE(behind.family);
  EXPECT_EQ(distance(Torus({}, 3.0, 1.0), {0.0, 0.0}, {kPi, 0.0}).shortest_paths.size(), 4u);
  EXPECT_TRUE(distance(Sphere({}, 2.0), {0.3, 0.4}, {0.3 + kPi, -0.4}).family);
  EXPECT_TRUE(distance(Ellipsoid(1.0, 1.0, 1.0), {0.3, 0.4}, {0.3 + kPi, -0.4}).family);
}

TEST(Distance, SaysWhereThePathLeavesTheDomain) {
  const Paraboloid bowl({{-1.0, 1.0}, {-1.0, 1.0}});
  const DistanceResult r = distance(bowl, {0.9, -0.9}, {0.9, 0.9});
  ASSERT_TRUE(r.leaves_at.has_value());
  EXPECT_NEAR(r.leaves_at->at.u, 1.0, 1e-12);
  EXPECT_LT(r.leaves_at->at.v, 0.0);
  EXPECT_GT(r.leaves_at->s, 0.0);
  EXPECT_LT(r.leaves_at->s, 0.5 * r.shortest.length);
  EXPECT_EQ(r.certainty, Certainty::None);
  EXPECT_EQ(r.doubt, Doubt::LeavesDomain);
}

// The plane with x = u^3: no tangent plane of the map on the border u = 0.
class CubedPlane final : public Surface {
 public:
  SurfaceKind kind() const override { return SurfaceKind::Function; }
  UvBox domain() const override { return {{0.0, 1.0}, {0.0, 1.0}}; }
  SurfaceJet jet(Uv p) const override {
    return {{p.u * p.u * p.u, p.v, 0.0},
            {3.0 * p.u * p.u, 0.0, 0.0},
            {0.0, 1.0, 0.0},
            {6.0 * p.u, 0.0, 0.0},
            {0.0, 0.0, 0.0},
            {0.0, 0.0, 0.0}};
  }
  using Surface::jet;
};

TEST(Distance, NamesThePlaceWithoutTangentPlane) {
  const CubedPlane plane;
  const DistanceResult r = distance(plane, {0.0, 0.25}, {0.8, 0.5});
  EXPECT_EQ(r.status, ConnectStatus::DegenerateMetric);
  ASSERT_TRUE(r.shortest.degenerate_at.has_value());
  EXPECT_EQ(*r.shortest.degenerate_at, (Uv{0.0, 0.25}));
  EXPECT_EQ(explain(r), "not certain: a place without tangent plane stands in the way, at (0, 0.25)");
}

TEST(Distance, ToAPlaceWithoutTangentPlaneIsRightOrNone) {
  const CubedPlane plane;
  for (const double v : {0.0, 0.25, 0.5, 1.0}) {
    const DistanceResult r = distance(plane, {0.8, 0.5}, {0.0, v});
    EXPECT_TRUE(std::isfinite(r.shortest.length) && std::isfinite(r.shortest.angle) && std::isfinite(r.shortest.y));
    EXPECT_TRUE(is_finite(r.shortest.start_direction) && is_finite(r.shortest.end_direction));
    if (r.status == ConnectStatus::Converged) {
      EXPECT_NEAR(r.shortest.length, std::hypot(0.512, v - 0.5), 1e-11) << v;
    }
    if (r.status == ConnectStatus::DegenerateMetric) {
      EXPECT_TRUE(r.shortest.degenerate_at.has_value()) << v;
    }
  }
}

}  // namespace
}  // namespace geovor
