#include "surface/project.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "support/differences.h"
#include "support/splines.h"
#include "surface/analytic_surfaces.h"
#include "surface/elementary_surfaces.h"
#include "surface/forms.h"

namespace geovor {
namespace {

using testing::random_point;
using testing::uniform;

constexpr double kPi = std::numbers::pi;
constexpr double kInf = std::numeric_limits<double>::infinity();

Xyz random_xyz(std::mt19937& random, double size) {
  const double x = uniform(random, -size, size), y = uniform(random, -size, size);
  return {x, y, uniform(random, -size, size)};
}

TEST(Project, FindsTheRadialFootOnASphere) {
  const Sphere sphere({Xyz(1, 2, 3)}, 2.0);
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    const Xyz point = random_xyz(random, 6.0);
    const Xyz d = point - Xyz(1, 2, 3);
    const Projection p = project(sphere, point, sphere.domain());
    EXPECT_TRUE(p.converged);
    EXPECT_NEAR((p.foot - (Xyz(1, 2, 3) + 2.0 * d.normalized())).norm(), 0.0, 1e-12 * (1 + 4.0 / d.norm()));
    EXPECT_NEAR(p.distance, std::abs(d.norm() - 2.0), 1e-13);
    EXPECT_TRUE(sphere.domain().contains(p.uv));
  }
}

TEST(Project, FindsThePolesOfASphere) {
  const Sphere sphere({}, 2.0);
  for (const Xyz& point : {Xyz(0, 0, 3), Xyz(0, 0, -1), Xyz(1e-9, 0, 2), Xyz(1e-4, -1e-4, 5)}) {
    const Projection p = project(sphere, point, sphere.domain());
    EXPECT_TRUE(p.converged);
    EXPECT_NEAR(p.distance, std::abs(point.norm() - 2.0), 1e-13);
    EXPECT_NEAR((p.foot - 2.0 * point.normalized()).norm(), 0.0, 1e-9);
  }
}

// At the pole as the guess, u moves nothing: the meridian has to be looked for.
TEST(ProjectNear, LeavesThePole) {
  const Sphere sphere({}, 2.0);
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    const Xyz point = random_xyz(random, 4.0);
    for (double v : {-kPi / 2, kPi / 2}) {
      const Projection p = project_near(sphere, point, {0.0, v}, sphere.domain());
      EXPECT_TRUE(p.converged);
      EXPECT_NEAR(p.distance, std::abs(point.norm() - 2.0), 1e-12) << point.transpose();
    }
  }
}

TEST(Project, FindsTheFootOnATorus) {
  const Torus torus({}, 3.0, 1.0);
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    const Xyz point = random_xyz(random, 5.0);
    const double from_circle = std::hypot(std::hypot(point.x(), point.y()) - 3.0, point.z());
    const Projection p = project(torus, point, torus.domain());
    EXPECT_TRUE(p.converged);
    EXPECT_NEAR(p.distance, std::abs(from_circle - 1.0), 1e-13);
  }
}

// A point lifted along the normal by less than the radius of curvature projects back to where it came from.
TEST(ProjectNear, UndoesALiftAlongTheNormalOfAWave) {
  const WaveSurface wave({{0, 6}, {0, 6}});
  std::mt19937 random(4);
  for (int i = 0; i < 500; ++i) {
    const Uv q = random_point(random, {{0.5, 5.5}, {0.5, 5.5}});
    const SurfaceJet j = wave.jet(q);
    const Xyz point = j.S + uniform(random, -0.4, 0.4) * unit_normal(j);
    const Uv guess{q.u + uniform(random, -0.2, 0.2), q.v + uniform(random, -0.2, 0.2)};
    const Projection p = project_near(wave, point, guess, wave.domain());
    EXPECT_TRUE(p.converged);
    EXPECT_NEAR((p.foot - j.S).norm(), 0.0, 1e-13);
    EXPECT_NEAR(std::hypot(p.uv.u - q.u, p.uv.v - q.v), 0.0, 1e-13);
  }
}

TEST(Project, FindsPointsOfSplinesFromAnywhere) {
  for (bool rational : {false, true}) {
    const BSplineSurface s = testing::random_spline(3, 3, 8, rational, 5).surface();
    std::mt19937 random(5);
    for (int i = 0; i < 60; ++i) {
      const Uv q = random_point(random, s.domain());
      const Projection p = project(s, s.position(q), s.domain());
      EXPECT_TRUE(p.converged);
      EXPECT_LT(p.distance, 1e-12);
    }
  }
}

TEST(Project, StaysInTheBox) {
  const Paraboloid bowl({{-1, 1}, {-1, 1}});
  const UvBox box{{0.25, 0.75}, {-0.5, 0.5}};
  const Projection side = project(bowl, {3.0, 0.1, 1.0}, box);
  EXPECT_TRUE(side.converged);
  EXPECT_EQ(side.uv.u, 0.75);
  const Projection corner = project(bowl, {3.0, 4.0, 0.0}, box);
  EXPECT_TRUE(corner.converged);
  EXPECT_EQ(corner.uv, (Uv{0.75, 0.5}));
}

TEST(Project, WorksOnUnboundedSurfaces) {
  const Plane plane({Xyz(100, 0, 5)});
  const Projection p = project(plane, {3, 4, 9}, plane.domain());
  EXPECT_TRUE(p.converged);
  EXPECT_NEAR((p.foot - Xyz(3, 4, 5)).norm(), 0.0, 1e-12);
  const Cylinder cylinder({}, 2.0);
  const Projection c = project(cylinder, {3, 4, 1e4}, cylinder.domain());
  EXPECT_TRUE(c.converged);
  EXPECT_NEAR((c.foot - Xyz(1.2, 1.6, 1e4)).norm(), 0.0, 1e-10);
  const Cone cone({}, 2.0, kPi / 4);
  const Projection k = project(cone, {5, 0, 1}, cone.domain());  // the generator through (2, 0, 0) and (3, 0, 1)
  EXPECT_TRUE(k.converged);
  EXPECT_NEAR((k.foot - Xyz(4, 0, 2)).norm(), 0.0, 1e-12);
}

// The guess decides the copy on a periodic surface.
TEST(ProjectNear, KeepsTheCopyOfThePeriodicParameter) {
  const Cylinder cylinder({}, 2.0);
  const Projection p = project_near(cylinder, {3, 0.1, 1}, {4 * kPi - 0.2, 0.0}, {{0, 2 * kPi}, {-kInf, kInf}});
  EXPECT_TRUE(p.converged);
  EXPECT_NEAR(p.uv.u, 4 * kPi + std::atan2(0.1, 3), 1e-13);
}

TEST(ProjectNear, DoesNotClaimConvergenceOnNotANumber) {
  const Paraboloid bowl({{-1, 1}, {-1, 1}});
  EXPECT_FALSE(project_near(bowl, {NAN, 0, 0}, {0, 0}, bowl.domain()).converged);
}

}  // namespace
}  // namespace geovor
