#include "surface/forms.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "support/differences.h"
#include "support/splines.h"
#include "surface/analytic_surfaces.h"
#include "surface/elementary_surfaces.h"

namespace geovor {
namespace {

using testing::random_point;
using testing::uniform;

constexpr double kPi = std::numbers::pi;

TEST(Curvatures, AreThoseOfTheSphere) {
  std::mt19937 random(1);
  for (double R : {1e-3, 1.0, 1e6}) {
    const Sphere sphere({}, R);
    for (int i = 0; i < 100; ++i) {
      const Curvatures k = curvatures(sphere.jet(random_point(random, {{0, 2 * kPi}, {-1.5, 1.5}})));
      EXPECT_NEAR(k.gauss * R * R, 1.0, 1e-13);
      EXPECT_NEAR(k.k1 * R, -1.0, 1e-13);  // the normal Su x Sv points outwards
      EXPECT_NEAR(k.k2 * R, -1.0, 1e-13);
      EXPECT_NEAR(k.largest() * R, 1.0, 1e-13);
    }
  }
}

TEST(Curvatures, AreThoseOfTheTorus) {
  const double R = 3.0, r = 1.0;
  const Torus torus({}, R, r);
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    const Uv p = random_point(random, torus.domain());
    const double circle = std::cos(p.v) / (R + r * std::cos(p.v));
    const Curvatures k = curvatures(torus.jet(p));
    EXPECT_NEAR(k.gauss, circle / r, 1e-14);
    EXPECT_NEAR(k.mean, -0.5 * (circle + 1.0 / r), 1e-14);
    EXPECT_NEAR(k.k1, -circle, 1e-14);
    EXPECT_NEAR(k.k2, -1.0 / r, 1e-14);
  }
}

TEST(Curvatures, AreThoseOfCylinderAndPlane) {
  const Curvatures cylinder = curvatures(Cylinder({}, 0.5).jet({1.0, 7.0}));
  EXPECT_NEAR(cylinder.gauss, 0.0, 1e-15);
  EXPECT_NEAR(cylinder.k2, -2.0, 1e-14);
  EXPECT_NEAR(cylinder.k1, 0.0, 1e-15);
  EXPECT_EQ(curvatures(Plane({}).jet({3.0, 4.0})).largest(), 0.0);
}

TEST(Curvatures, OfMinimalSurfacesHaveMeanZero) {
  const double c = 0.7;
  const Catenoid catenoid(c, {-1.0, 1.0});
  const Helicoid helicoid(c, {{0, 6}, {-1, 1}});
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    const Uv p = random_point(random, catenoid.domain());
    const Curvatures a = curvatures(catenoid.jet(p));
    EXPECT_NEAR(a.mean, 0.0, 1e-14);
    EXPECT_NEAR(a.gauss, -1.0 / (c * c * std::pow(std::cosh(p.v / c), 4)), 1e-13);
    const Uv q = random_point(random, helicoid.domain());
    const Curvatures b = curvatures(helicoid.jet(q));
    EXPECT_NEAR(b.mean, 0.0, 1e-14);
    EXPECT_NEAR(b.gauss, -c * c / std::pow(c * c + q.v * q.v, 2), 1e-13);
  }
}

// The same sphere in parameters that are far from orthogonal: F enters every formula.
TEST(Curvatures, DoNotDependOnTheParameters) {
  const WaveSurface wave({{0, 6}, {0, 6}});
  std::mt19937 random(4);
  for (int i = 0; i < 100; ++i) {
    const SurfaceJet j = wave.jet(random_point(random, wave.domain()));
    const double a = uniform(random, -2, 2), b = uniform(random, 0.1, 3);  // new axes (1, 0) and (a, b)
    SurfaceJet sheared = j;
    sheared.Sv = a * j.Su + b * j.Sv;
    sheared.Suv = a * j.Suu + b * j.Suv;
    sheared.Svv = a * a * j.Suu + 2 * a * b * j.Suv + b * b * j.Svv;
    const Curvatures k = curvatures(j), s = curvatures(sheared);
    EXPECT_NEAR(k.gauss, s.gauss, 1e-11);
    EXPECT_NEAR(k.k1, s.k1, 1e-11);
    EXPECT_NEAR(k.k2, s.k2, 1e-11);
  }
}

// z = f over the plane: K = (fuu fvv - fuv^2) / (1 + fu^2 + fv^2)^2.
TEST(Curvatures, OfAGraphFollowMonge) {
  const GaussianBumps bumps({{{0.1, -0.2}, 3.0, 0.3}, {{-0.5, 0.4}, -1.0, 0.5}}, {{-2, 2}, {-2, 2}});
  std::mt19937 random(5);
  for (int i = 0; i < 100; ++i) {
    const Uv p = random_point(random, bumps.domain());
    const HeightJet h = bumps.height(p);
    const double w = 1.0 + h.fu * h.fu + h.fv * h.fv;
    EXPECT_NEAR(curvatures(bumps.jet(p)).gauss, (h.fuu * h.fvv - h.fuv * h.fuv) / (w * w), 1e-10);
  }
}

// 2 <Gamma_ij, S_k> = d_i g_jk + d_j g_ik - d_k g_ij, the derivatives of the metric by differences.
TEST(Christoffel, FollowsFromTheMetricAlone) {
  const BSplineSurface spline = testing::random_spline(4, 3, 1, true, 7).surface();
  std::mt19937 random(6);
  const double h = 1e-3;
  for (int i = 0; i < 50; ++i) {
    const Uv p = random_point(random, {{0.1, 0.9}, {0.1, 0.9}});
    auto metric = [&](double u, double v) {
      const FirstForm I = first_form(spline.jet({u, v}));
      return Xyz(I.E, I.F, I.G);
    };
    const Xyz du = testing::central_difference([&](double u) { return metric(u, p.v); }, p.u, h);
    const Xyz dv = testing::central_difference([&](double v) { return metric(p.u, v); }, p.v, h);
    const FirstForm I = first_form(spline.jet(p));
    const double W2 = I.E * I.G - I.F * I.F;
    const Christoffel c = christoffel(spline.jet(p));
    const double scale = 1e-7 * (1.0 + std::abs(c.u_uu) + std::abs(c.u_vv) + std::abs(c.v_uu) + std::abs(c.v_vv));
    EXPECT_NEAR(c.u_uu, (I.G * du[0] - 2 * I.F * du[1] + I.F * dv[0]) / (2 * W2), scale);
    EXPECT_NEAR(c.u_uv, (I.G * dv[0] - I.F * du[2]) / (2 * W2), scale);
    EXPECT_NEAR(c.u_vv, (2 * I.G * dv[1] - I.G * du[2] - I.F * dv[2]) / (2 * W2), scale);
    EXPECT_NEAR(c.v_uu, (2 * I.E * du[1] - I.E * dv[0] - I.F * du[0]) / (2 * W2), scale);
    EXPECT_NEAR(c.v_uv, (I.E * du[2] - I.F * dv[0]) / (2 * W2), scale);
    EXPECT_NEAR(c.v_vv, (I.E * dv[2] - 2 * I.F * dv[1] + I.F * du[2]) / (2 * W2), scale);
  }
}

TEST(DirectionAtAngle, IsUnitAndInvertsAngleOfDirection) {
  const WaveSurface wave({{0, 6}, {0, 6}});
  std::mt19937 random(8);
  for (int i = 0; i < 200; ++i) {
    const SurfaceJet j = wave.jet(random_point(random, wave.domain()));
    const double t = uniform(random, -kPi, kPi);
    const UvVec d = direction_at_angle(j, t);
    EXPECT_NEAR(norm(j, d), 1.0, 1e-14);
    EXPECT_NEAR(angle_of_direction(j, 3.0 * d), t, 1e-14);
    // In space: cos t e1 + sin t e2 with e1 along Su and e2 = n x e1.
    const Xyz e1 = j.Su.normalized(), e2 = unit_normal(j).cross(e1);
    EXPECT_NEAR((push_forward(j, d) - std::cos(t) * e1 - std::sin(t) * e2).norm(), 0.0, 1e-14);
  }
}

// A plane whose parameter lines meet at an angle of 1/k: (x, y) = (u + v, v/k), turned about in space. The truth is
// x' = cos t, y' = sin t. The parameters themselves carry an error of k roundings, and no more than that is allowed.
TEST(DirectionAtAngle, KeepsItsDigitsWhereParameterLinesAreSheared) {
  std::mt19937 random(10);
  for (const double k : {1e3, 1e6}) {
    const double allowed = 4.0 * k * std::numeric_limits<double>::epsilon();
    for (int i = 0; i < 1000; ++i) {
      const Eigen::Quaterniond about =
          Eigen::Quaterniond(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1), 1.0).normalized();
      const Xyz x = about * Xyz::UnitX(), y = about * Xyz::UnitY(), zero = Xyz::Zero();
      const SurfaceJet j{zero, x, x + y / k, zero, zero, zero};
      const double t = uniform(random, -kPi, kPi);
      const UvVec d = direction_at_angle(j, t);
      ASSERT_NEAR((push_forward(j, d) - std::cos(t) * x - std::sin(t) * y).norm(), 0.0, allowed);
      const UvVec exact{std::cos(t) - k * std::sin(t), k * std::sin(t)};
      ASSERT_NEAR(norm(j, exact), 1.0, allowed);
      ASSERT_NEAR(std::remainder(angle_of_direction(j, exact) - t, 2.0 * kPi), 0.0, allowed);
      ASSERT_NEAR(k * area_ratio(j), 1.0, allowed);
    }
  }
}

TEST(TangentComponents, InvertPushForwardAndIgnoreTheNormal) {
  const MonkeySaddle saddle({{-1, 1}, {-1, 1}});
  std::mt19937 random(9);
  for (int i = 0; i < 100; ++i) {
    const SurfaceJet j = saddle.jet(random_point(random, saddle.domain()));
    const UvVec d{uniform(random, -1, 1), uniform(random, -1, 1)};
    const UvVec back = tangent_components(j, push_forward(j, d) + uniform(random, -5, 5) * unit_normal(j));
    EXPECT_NEAR(back.u, d.u, 1e-13);
    EXPECT_NEAR(back.v, d.v, 1e-13);
  }
}

TEST(UnitNormal, IsNotANumberAtAPole) {
  EXPECT_FALSE(unit_normal(Sphere({}, 1.0).jet({0.0, kPi / 2})).allFinite() &&
               Sphere({}, 1.0).jet({0.0, kPi / 2}).Su.norm() == 0.0);
  SurfaceJet collapsed = Plane({}).jet({0, 0});
  collapsed.Su.setZero();
  EXPECT_TRUE(unit_normal(collapsed).array().isNaN().all());
}

}  // namespace
}  // namespace geovor
