#include "surface/elementary_surfaces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/error.h"
#include "support/differences.h"
#include "surface/analytic_surfaces.h"

namespace geovor {
namespace {

using testing::random_point;
using testing::worst_derivative_error;

constexpr double kPi = std::numbers::pi;
constexpr UvBox kSome{{-1.0, 7.0}, {-1.4, 1.4}};

// A rotated placement away from the origin, right- or left-handed.
Frame tilted(bool left_handed = false) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.8, Xyz(1, 2, -2).normalized()).toRotationMatrix();
  Frame f{{3, -4, 5}, turn.col(0), turn.col(1), turn.col(2)};
  if (left_handed) f.y = -f.y;
  return f;
}

TEST(ElementarySurfaces, HaveDerivativesThatMatchDifferences) {
  for (bool left : {false, true}) {
    const Frame f = tilted(left);
    EXPECT_LT(worst_derivative_error(Plane(f), kSome), 1e-10);
    EXPECT_LT(worst_derivative_error(Cylinder(f, 2.0), kSome), 1e-10);
    EXPECT_LT(worst_derivative_error(Cone(f, 2.0, -0.4), kSome), 1e-10);
    EXPECT_LT(worst_derivative_error(Sphere(f, 2.0), kSome), 1e-10);
    EXPECT_LT(worst_derivative_error(Torus(f, 3.0, 1.0), kSome), 1e-10);
  }
}

// The implicit equations, in the frame's coordinates: where the points have to lie, whatever the parameters.
TEST(ElementarySurfaces, LieOnTheirQuadrics) {
  std::mt19937 random(1);
  const Frame f = tilted(true);
  const Cylinder cylinder(f, 2.0);
  const Cone cone(f, 2.0, 0.4);
  const Sphere sphere(f, 2.0);
  const Torus torus(f, 3.0, 1.0);
  for (int i = 0; i < 100; ++i) {
    const Uv p = random_point(random, kSome);
    const Xyz c = f.to_local(cylinder.position(p)), k = f.to_local(cone.position(p));
    const Xyz s = f.to_local(sphere.position(p)), t = f.to_local(torus.position(p));
    EXPECT_NEAR(std::hypot(c.x(), c.y()), 2.0, 1e-14);
    EXPECT_NEAR(std::hypot(k.x(), k.y()), 2.0 + k.z() * std::tan(0.4), 1e-14);
    EXPECT_NEAR(s.norm(), 2.0, 1e-14);
    EXPECT_NEAR(std::hypot(std::hypot(t.x(), t.y()) - 3.0, t.z()), 1.0, 1e-14);
  }
}

// OpenCASCADE's conventions at points that tell them apart.
TEST(ElementarySurfaces, FollowTheParametersOfOpenCascade) {
  const Frame f;
  const double half = kPi / 2;
  EXPECT_NEAR((Cylinder(f, 2).position({half, 3}) - Xyz(0, 2, 3)).norm(), 0, 1e-15);
  // v is the length along the generator.
  const Cone cone(f, 2, kPi / 6);
  EXPECT_NEAR((cone.position({0, 2}) - Xyz(3, 0, std::sqrt(3.0))).norm(), 0, 1e-15);
  EXPECT_NEAR((cone.position({1.0, cone.apex_v()}) - cone.apex()).norm(), 0, 1e-14);
  EXPECT_NEAR((cone.apex() - Xyz(0, 0, -2 * std::sqrt(3.0))).norm(), 0, 1e-14);
  EXPECT_NEAR((Sphere(f, 2).position({0, half}) - Xyz(0, 0, 2)).norm(), 0, 1e-15);
  EXPECT_NEAR((Torus(f, 3, 1).position({half, half}) - Xyz(0, 3, 1)).norm(), 0, 1e-15);
}

TEST(ElementarySurfaces, RepeatAfterTheirPeriods) {
  const Torus torus(tilted(), 3.0, 1.0);
  const SurfaceJet a = torus.jet({0.3, 0.4});
  EXPECT_LT(testing::distance(a, torus.jet({0.3 + *torus.u_period(), 0.4})), 1e-14);
  EXPECT_LT(testing::distance(a, torus.jet({0.3, 0.4 - *torus.v_period()})), 1e-14);
  EXPECT_FALSE(Sphere({}, 1.0).v_period().has_value());
  EXPECT_FALSE(Plane({}).u_period().has_value());
}

TEST(ElementarySurfaces, RejectSizesWithoutSense) {
  EXPECT_THROW(Cylinder({}, 0.0), Error);
  EXPECT_THROW(Cylinder({}, NAN), Error);
  EXPECT_THROW(Sphere({}, -1.0), Error);
  EXPECT_THROW(Torus({}, 1.0, INFINITY), Error);
  EXPECT_THROW(Cone({}, 1.0, kPi / 2), Error);
  EXPECT_THROW(Cone({}, 1.0, 0.0), Error);
  EXPECT_THROW(Cone({}, -1.0, 0.5), Error);
  Frame skew;
  skew.y = {0.1, 1.0, 0.0};
  EXPECT_THROW(Plane{skew}, Error);
}

TEST(AnalyticSurfaces, HaveDerivativesThatMatchDifferences) {
  const UvBox box{{-1, 1}, {-1, 1}};
  EXPECT_LT(worst_derivative_error(WaveSurface(box), box), 1e-10);
  EXPECT_LT(worst_derivative_error(Paraboloid(box), box), 1e-10);
  EXPECT_LT(worst_derivative_error(MonkeySaddle(box), box), 1e-10);
  EXPECT_LT(worst_derivative_error(GaussianBumps({{{0, 0.2}, 3.0, 0.3}, {{-1, 0}, 1.0, 0.5}}, box), box), 1e-8);
  EXPECT_LT(worst_derivative_error(Ellipsoid(1, 2, 3), box), 1e-10);
  EXPECT_LT(worst_derivative_error(Catenoid(0.7, {-1, 1}), box), 1e-10);
  EXPECT_LT(worst_derivative_error(Helicoid(0.7, box), box), 1e-10);
}

// Catenoid and helicoid are isometric: E = G_h etc. with v_h = c sinh(v_c / c).
TEST(AnalyticSurfaces, CatenoidAndHelicoidAreIsometric) {
  const double c = 0.7, v = 0.5, v_h = c * std::sinh(v / c);
  const SurfaceJet a = Catenoid(c, {-1, 1}).jet({0.3, v});
  const SurfaceJet b = Helicoid(c, {{0, 1}, {-2, 2}}).jet({0.3, v_h});
  EXPECT_NEAR(a.Su.norm(), b.Su.norm(), 1e-14);
  EXPECT_NEAR(a.Sv.norm(), b.Sv.norm() * std::cosh(v / c), 1e-14);
}

TEST(SurfaceKind, HasAWordForEach) {
  EXPECT_EQ(to_string(SurfaceKind::Plane), "plane");
  EXPECT_EQ(to_string(SurfaceKind::BSpline), "bspline");
  EXPECT_EQ(to_string(Sphere({}, 1).kind()), "sphere");
}

}  // namespace
}  // namespace geovor
