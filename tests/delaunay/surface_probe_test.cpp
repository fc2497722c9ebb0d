#include "delaunay/surface_probe.h"

#include <gtest/gtest.h>

#include <cmath>

#include "surface/elementary_surfaces.h"

namespace geovor {
namespace {

constexpr double kPi = 3.14159265358979323846;

TEST(SurfaceProbe, HasNormalAndCurvatureAtThePoleOfASphere) {
  const Sphere sphere({}, 2.0);
  const SurfaceProbe probe(sphere, sphere.domain());
  for (double v : {-kPi / 2, kPi / 2}) {
    const SurfaceSample s = probe.at({1.0, v});
    EXPECT_TRUE(s.regular);
    EXPECT_LT((s.n - s.x / 2.0).norm(), 1e-14);
    EXPECT_NEAR(s.curvature, 0.5, 1e-14);
  }
}

// The normal of a cone of half angle a along the generator at u is (cos u cos a, sin u cos a, -sin a); the way from
// (u, tip) to the middle of the box leads to u's between.
TEST(SurfaceProbe, TakesTheNormalOfTheWayInwardsAtTheTipOfACone) {
  const double a = 0.5;
  const Cone cone({}, 2.0, a);
  const SurfaceProbe probe(cone, {{0.0, 2.0}, {cone.apex_v(), 1.0}});
  for (double u : {0.0, 0.7, 2.0}) {
    const SurfaceSample s = probe.at({u, cone.apex_v()});
    EXPECT_FALSE(s.regular);
    EXPECT_LT((s.n - Xyz(std::cos(u) * std::cos(a), std::sin(u) * std::cos(a), -std::sin(a))).norm(), 1e-4) << u;
  }
}

}  // namespace
}  // namespace geovor
