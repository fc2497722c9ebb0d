#include "surface/swept_surfaces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "support/differences.h"
#include "support/splines.h"
#include "surface/analytic_surfaces.h"
#include "surface/bspline_curve.h"
#include "surface/elementary_curves.h"
#include "surface/elementary_surfaces.h"
#include "surface/forms.h"
#include "surface/offset_surface.h"

namespace geovor {
namespace {

using testing::distance;
using testing::random_point;
using testing::worst_derivative_error;

constexpr double kPi = std::numbers::pi;

// A wavy profile with knots at 1 and 2.
Curve3Ptr profile() {
  const KnotVector knots({0, 1, 2, 3}, {4, 1, 1, 4}, 3);
  return std::make_shared<BSplineCurve<3>>(
      knots, std::vector<Xyz>{{2, 0, 0}, {3, 0.2, 0.5}, {1, -0.3, 1}, {2, 0, 2}, {2.5, 0.1, 2.5}, {2, 0, 3}});
}

TEST(RevolutionSurface, OfACircleIsTheTorus) {
  const ConicFrame<3> circle{{3, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  const RevolutionSurface turned(std::make_shared<Circle<3>>(circle, 1.0), {0, 0, 0}, {0, 0, 2});
  const Torus torus({}, 3.0, 1.0);
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    const Uv p = random_point(random, torus.domain());
    EXPECT_LT(distance(turned.jet(p), torus.jet(p)), 1e-14);
  }
  EXPECT_EQ(turned.v_period(), torus.v_period());
}

TEST(RevolutionSurface, HasDerivativesThatMatchDifferencesAndPassesOnThePieces) {
  const RevolutionSurface s(profile(), {0.1, -0.2, 0}, {0.3, 0.1, 1});
  EXPECT_LT(worst_derivative_error(s, {{-7, 7}, {0, 3}}), 1e-9);
  const Span below = s.span({100.0, 2.0}, {0, -1}), above = s.span({100.0, 2.0}, {0, 1});
  EXPECT_EQ(below.box.v.hi, 2.0);
  EXPECT_EQ(above.box.v.lo, 2.0);
  EXPECT_LT(distance(s.jet({1.0, 2.0}, below), s.jet({1.0, 2.0}, above)), 1e-12);
  EXPECT_EQ(s.continuity(), 2);
}

TEST(RevolutionSurface, KeepsHeightAndDistanceFromTheAxis) {
  const Xyz origin(0.1, -0.2, 0.3), axis = Xyz(0.3, 0.1, 1).normalized();
  const RevolutionSurface s(profile(), origin, axis);
  for (double u : {0.5, 2.0, 4.0}) {
    const Xyz a = s.position({0.0, 1.3}) - origin, b = s.position({u, 1.3}) - origin;
    EXPECT_NEAR(a.dot(axis), b.dot(axis), 1e-14);
    EXPECT_NEAR(a.cross(axis).norm(), b.cross(axis).norm(), 1e-14);
    const Xyz across_a = a - a.dot(axis) * axis, across_b = b - b.dot(axis) * axis;
    EXPECT_NEAR(std::remainder(std::atan2(across_a.cross(across_b).dot(axis), across_a.dot(across_b)) - u, 2 * kPi),
                0.0, 1e-14);
  }
}

TEST(ExtrusionSurface, OfACircleIsTheCylinder) {
  const ConicFrame<3> circle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const ExtrusionSurface s(std::make_shared<Circle<3>>(circle, 2.0), {0, 0, 1});
  const Cylinder cylinder({}, 2.0);
  EXPECT_LT(distance(s.jet({0.7, 5.0}), cylinder.jet({0.7, 5.0})), 1e-14);
  EXPECT_EQ(s.u_period(), cylinder.u_period());
}

TEST(ExtrusionSurface, PassesOnThePieces) {
  const ExtrusionSurface s(profile(), {0, 1, 0.5});
  EXPECT_LT(worst_derivative_error(s, {{0, 3}, {-2, 2}}), 1e-9);
  EXPECT_EQ(s.span({1.0, 9.0}, {-1, 0}).box.u.hi, 1.0);
  EXPECT_EQ(s.span({1.0, 9.0}, {1, 0}).box.u.hi, 2.0);
}

TEST(SweptSurfaces, RejectAMissingCurveOrDirection) {
  EXPECT_THROW(RevolutionSurface(nullptr, {0, 0, 0}, {0, 0, 1}), Error);
  EXPECT_THROW(RevolutionSurface(profile(), {0, 0, 0}, {0, 0, 0}), Error);
  EXPECT_THROW(ExtrusionSurface(profile(), {NAN, 0, 0}), Error);
  EXPECT_THROW(OffsetSurface(nullptr, 1.0), Error);
}

TEST(OffsetSurface, OfElementarySurfacesIsElementary) {
  std::mt19937 random(2);
  const OffsetSurface sphere(std::make_shared<Sphere>(Frame{}, 2.0), 0.5);
  const OffsetSurface torus(std::make_shared<Torus>(Frame{}, 3.0, 1.0), -0.25);
  const OffsetSurface cone(std::make_shared<Cone>(Frame{}, 2.0, 0.4), 0.3);
  for (int i = 0; i < 100; ++i) {
    const Uv p = random_point(random, {{0, 6}, {-1.5, 1.5}});
    EXPECT_LT(distance(sphere.jet(p), Sphere({}, 2.5).jet(p)), 3e-14);
    EXPECT_LT(distance(torus.jet(p), Torus({}, 3.0, 0.75).jet(p)), 3e-14);
    const SurfaceJet moved = Cone({Xyz(0, 0, -0.3 * std::sin(0.4))}, 2.0 + 0.3 * std::cos(0.4), 0.4).jet(p);
    EXPECT_LT(distance(cone.jet(p), moved), 3e-14);
  }
}

TEST(OffsetSurface, HasDerivativesThatMatchDifferences) {
  const auto spline = std::make_shared<BSplineSurface>(testing::random_spline(3, 3, 4, false, 1).surface());
  EXPECT_LT(worst_derivative_error(OffsetSurface(spline, 0.1), spline->domain(), 1e-4), 1e-6);
  const auto wave = std::make_shared<WaveSurface>(UvBox{{0, 6}, {0, 6}});
  EXPECT_LT(worst_derivative_error(OffsetSurface(wave, 0.2), wave->domain()), 1e-8);
}

// Parallel surfaces: k' = k / (1 - d k) for the normal's own sign.
/// Positions are exact at any distance from a pole, 0 included.
TEST(OffsetSurface, OfASphereIsASphereUpToItsPoles) {
  const OffsetSurface s(std::make_shared<Sphere>(Frame{}, 2.0), 0.5);
  const Sphere larger({}, 2.5);
  for (double depth : {1e-2, 1e-4, 1e-7, 1e-9, 1e-10, 1e-11, 1e-13, 0.0})
    for (double sign : {-1.0, 1.0})
      for (double u = 0.1; u < 6.0; u += 0.7) {
        const Uv p{u, sign * (0.5 * std::numbers::pi - depth)};
        EXPECT_LT((s.position(p) - larger.position(p)).norm(), 1e-15 * 4.0) << depth;
        EXPECT_LT((s.jet(p).S - larger.position(p)).norm(), 1e-15 * 4.0) << depth;
      }
}

TEST(OffsetSurface, HasTheCurvaturesOfAParallelSurface) {
  const auto wave = std::make_shared<WaveSurface>(UvBox{{0, 6}, {0, 6}});
  const double d = 0.3;
  const OffsetSurface s(wave, d);
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) {
    const Uv p = random_point(random, wave->domain());
    const Curvatures k = curvatures(wave->jet(p)), o = curvatures(s.jet(p));
    EXPECT_NEAR(o.k1, k.k1 / (1 - d * k.k1), 1e-13);
    EXPECT_NEAR(o.k2, k.k2 / (1 - d * k.k2), 1e-13);
  }
}

TEST(OffsetSurface, HasALimitAtThePole) {
  const OffsetSurface s(std::make_shared<Ellipsoid>(1.0, 1.0, 2.0), 0.5);
  for (double v : {-kPi / 2, kPi / 2}) {
    const SurfaceJet j = s.jet({0.3, v});
    EXPECT_NEAR((j.S - Xyz(0, 0, std::copysign(2.5, v))).norm(), 0.0, 1e-6);
    EXPECT_TRUE(j.Suu.allFinite() && j.Suv.allFinite() && j.Svv.allFinite());
  }
}

}  // namespace
}  // namespace geovor
