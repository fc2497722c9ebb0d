// Third derivatives against differences of the second ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "support/differences.h"
#include "support/splines.h"
#include "surface/analytic_surfaces.h"
#include "surface/bspline_curve.h"
#include "surface/elementary_curves.h"
#include "surface/elementary_surfaces.h"
#include "surface/offset_surface.h"
#include "surface/reparameterize.h"
#include "surface/swept_surfaces.h"

namespace geovor {
namespace {

/// Worst error of the third derivatives at seeded points of `box`, relative to the largest second or third one.
double worst_third_error(const Surface& surface, const UvBox& box) {
  constexpr double kStep = 1e-3;
  std::mt19937 random(1);
  double error = 0.0, size = 1e-300;
  for (int i = 0; i < 100; ++i) {
    const Uv p = testing::random_point(random, box);
    const Span span = surface.span(p, {1.0, 1.0});
    const SurfaceThirds t = surface.third(p, span);
    auto along_u = [&](auto member) {
      return testing::central_difference(
          [&](double u) -> Xyz {
            return surface.jet({u, p.v}, span).*member;
          },
          p.u, kStep);
    };
    auto along_v = [&](auto member) {
      return testing::central_difference(
          [&](double v) -> Xyz {
            return surface.jet({p.u, v}, span).*member;
          },
          p.v, kStep);
    };
    const SurfaceJet j = surface.jet(p, span);
    error = std::max({error, (along_u(&SurfaceJet::Suu) - t.uuu).norm(), (along_v(&SurfaceJet::Suu) - t.uuv).norm(),
                      (along_u(&SurfaceJet::Suv) - t.uuv).norm(), (along_v(&SurfaceJet::Suv) - t.uvv).norm(),
                      (along_u(&SurfaceJet::Svv) - t.uvv).norm(), (along_v(&SurfaceJet::Svv) - t.vvv).norm()});
    size = std::max(
        {size, t.uuu.norm(), t.uuv.norm(), t.uvv.norm(), t.vvv.norm(), j.Suu.norm(), j.Suv.norm(), j.Svv.norm()});
  }
  return error / size;
}

// Differences of fourth order with the step 1e-3, on functions that vary over lengths of 0.1 to 1.
constexpr double kBound = 2e-9;
constexpr UvBox kBox{{0.5, 5.5}, {-1.2, 1.2}};

TEST(ThirdDerivatives, OfElementarySurfaces) {
  Frame frame;
  frame.origin = {1.0, 2.0, 3.0};
  frame.x = Xyz(1.0, 2.0, 2.0) / 3.0;
  frame.y = Xyz(2.0, 1.0, -2.0) / 3.0;
  frame.z = Xyz(-2.0, 2.0, -1.0) / 3.0;
  EXPECT_EQ(worst_third_error(Plane(frame), kBox), 0.0);
  EXPECT_LT(worst_third_error(Cylinder(frame, 2.0), kBox), kBound);
  EXPECT_LT(worst_third_error(Cone(frame, 2.0, 0.3), kBox), kBound);
  EXPECT_LT(worst_third_error(Sphere(frame, 2.0), kBox), kBound);
  EXPECT_LT(worst_third_error(Torus(frame, 3.0, 1.0), kBox), kBound);
}

TEST(ThirdDerivatives, OfFormulas) {
  EXPECT_LT(worst_third_error(WaveSurface(kBox), kBox), kBound);
  EXPECT_LT(worst_third_error(Paraboloid(kBox), kBox), kBound);
  EXPECT_LT(worst_third_error(MonkeySaddle(kBox), kBox), kBound);
  EXPECT_LT(worst_third_error(GaussianBumps({{{1.0, 0.0}, 1.0, 0.5}, {{3.0, 0.5}, -0.5, 0.8}}, kBox), kBox), kBound);
  EXPECT_LT(worst_third_error(Ellipsoid(1.0, 2.0, 3.0), kBox), kBound);
  EXPECT_LT(worst_third_error(Catenoid(1.5, kBox.v), kBox), kBound);
  EXPECT_LT(worst_third_error(Helicoid(1.5, kBox), kBox), kBound);
}

TEST(ThirdDerivatives, OfSplines) {
  for (const bool rational : {false, true})
    for (const auto& [p, q] : {std::pair{3, 3}, {2, 5}, {1, 4}, {7, 2}}) {
      const BSplineSurface s = testing::random_spline(p, q, 3, rational, 7 * p + q).surface();
      EXPECT_LT(worst_third_error(s, s.domain()), 1e-7) << p << q << rational;
    }
  const BSplineSurface torus = testing::spline_torus(3.0, 1.0, true);
  EXPECT_LT(worst_third_error(torus, {{-2.0, 6.0}, {1.0, 9.0}}), kBound);
}

TEST(ThirdDerivatives, OfSweptSurfaces) {
  const auto curve = std::make_shared<BSplineCurve<3>>(
      KnotVector({0, 1, 3}, {5, 2, 5}, 4),
      std::vector<Xyz>{{1, 0, 0}, {2, 0.5, 0.3}, {1.5, 0, 1}, {2, 0.4, 2}, {3, 1, 2}, {2, 0, 3}, {1, 0, 4}});
  EXPECT_LT(worst_third_error(RevolutionSurface(curve, {0.1, 0.2, 0.3}, {0.1, 0.2, 1.0}), {{0, 6}, {0, 3}}), kBound);
  EXPECT_LT(worst_third_error(ExtrusionSurface(curve, {0.1, 2.0, 1.0}), {{0, 3}, {-1, 1}}), kBound);
}

TEST(ThirdDerivatives, OfOtherParameters) {
  const auto base = std::make_shared<Torus>(Frame{}, 3.0, 1.0);
  for (const bool swap : {false, true}) {
    const Reparameterized s(base, moebius_map({0.0, 5.0}, 2.0), cubic_map({0.0, 5.0}, 0.8), swap);
    EXPECT_LT(worst_third_error(s, {{0.1, 0.9}, {0.1, 0.9}}), kBound);
    const Reparameterized turned(base, affine_map(-0.5, 1.0), nullptr, swap);
    EXPECT_LT(worst_third_error(turned, kBox), kBound);
  }
}

/// No closed form: differences.
TEST(ThirdDerivatives, OfAnOffsetAreGoodToDifferences) {
  EXPECT_LT(worst_third_error(OffsetSurface(std::make_shared<Torus>(Frame{}, 3.0, 1.0), 0.25), kBox), kBound);
}

}  // namespace
}  // namespace geovor
