#include "brep/face_domain.h"

#include <gtest/gtest.h>

#include <random>

#include "base/error.h"
#include "test_faces.h"

namespace geovor::testing {
namespace {

constexpr double kDeflection = 1e-4;

FaceDomain domain_of(FaceBuilder& b, double deflection = kDeflection) {
  return FaceDomain(b.model(), b.face(), deflection);
}

TEST(FaceDomain, HoldsWhatTheFormulaHolds) {
  FaceBuilder b(plane());
  b.rectangle(-2, -1, 3, 4).ellipse({0.5, 1}, 1.0, 0.5, true).ellipse({2.0, 2.5}, 0.3, 0.9, true);
  const FaceDomain d = domain_of(b);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-3.0, 5.0);
  const auto ellipse = [](Uv p, Uv c, double a, double e) { return std::hypot((p.u - c.u) / a, (p.v - c.v) / e); };
  int held = 0;
  for (int i = 0; i < 100000; ++i) {
    const Uv p{coordinate(random), coordinate(random)};
    const double e1 = ellipse(p, {0.5, 1}, 1.0, 0.5), e2 = ellipse(p, {2.0, 2.5}, 0.3, 0.9);
    // Between the flattened and the true border the answer is free.
    if (std::abs(e1 - 1) < 4 * kDeflection || std::abs(e2 - 1) < 4 * kDeflection) continue;
    const bool expected = p.u > -2 && p.u < 3 && p.v > -1 && p.v < 4 && e1 > 1 && e2 > 1;
    ASSERT_EQ(d.contains(p), expected) << p.u << " " << p.v;
    held += expected;
  }
  EXPECT_GT(held, 10000);
}

TEST(FaceDomain, HoldsItsBorderAndItsCorners) {
  FaceBuilder b(plane());
  b.polygon({{0, 0}, {3, 1}, {2, 4}, {-1, 2}});
  const FaceDomain d = domain_of(b);
  for (const Uv corner : d.loops()[0]) EXPECT_TRUE(d.contains(corner));
  for (int i = 0; i <= 100; ++i) EXPECT_TRUE(d.contains(lerp({0, 0}, {3, 1}, i / 100.0)));
  EXPECT_FALSE(d.contains({3.0 + 1e-9, 1.0}));
}

TEST(FaceDomain, IsBlindToTheStartOfALoop) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1.5, 1.5);
  // A star has corners at the height of other corners, where a ray is hardest to count.
  std::vector<Uv> star;
  for (int i = 0; i < 10; ++i) {
    const double r = i % 2 == 0 ? 1.0 : 0.4, t = kPi * i / 5;
    star.push_back({r * std::cos(t), r * std::sin(t)});
  }
  FaceBuilder first(plane());
  first.polygon(star);
  const FaceDomain d = domain_of(first);
  std::rotate(star.begin(), star.begin() + 3, star.end());
  FaceBuilder second(plane());
  second.polygon(star);
  const FaceDomain e = domain_of(second);
  for (int i = 0; i < 20000; ++i) {
    const Uv p{coordinate(random), i % 3 == 0 ? star[i % 10].v : coordinate(random)};
    ASSERT_EQ(d.contains(p), e.contains(p)) << p.u << " " << p.v;
  }
}

TEST(FaceDomain, FlattensWithinTheDeflectionMeasuredInSpace) {
  for (const double deflection : {1e-1, 1e-3, 1e-5}) {
    // A cylinder of radius 50: one unit of u is 50 in space.
    FaceBuilder b(cylinder(50.0));
    b.ellipse({1.0, 0.0}, 0.5, 10.0);
    const FaceDomain d = domain_of(b, deflection);
    const std::vector<Uv>& loop = d.loops()[0];
    double worst = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      // On the developed cylinder the midpoint of a chord lies this far inside the ellipse, to first order.
      const Uv m = lerp(loop[i], loop[(i + 1) % loop.size()], 0.5);
      const double x = 50.0 * (m.u - 1.0), y = m.v, f = std::hypot(x / 25.0, y / 10.0);
      const double slope = std::hypot(x / (25.0 * 25.0), y / (10.0 * 10.0)) / f;
      worst = std::max(worst, (1.0 - f) / slope);
    }
    EXPECT_LE(worst, 1.05 * deflection);
    EXPECT_GE(worst, 0.05 * deflection) << "far more points than asked for";
  }
}

TEST(FaceDomain, KeepsStraightBordersAtTwoPoints) {
  FaceBuilder b(cylinder(1.0));
  b.rectangle(0, 0, 1, 1);
  EXPECT_EQ(domain_of(b).loops()[0].size(), 4u);
}

TEST(FaceDomain, TurnsOuterLoopsLeftAndHolesRight) {
  FaceBuilder b(plane());
  b.rectangle(-2, -2, 2, 2).ellipse({0, 0}, 1, 1, true);
  const FaceDomain d = domain_of(b);
  const auto twice_area = [](const std::vector<Uv>& loop) {
    double sum = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      sum += cross(loop[i] - Uv{}, loop[(i + 1) % loop.size()] - Uv{});
    }
    return sum;
  };
  EXPECT_DOUBLE_EQ(twice_area(d.loops()[0]), 32.0);
  EXPECT_NEAR(twice_area(d.loops()[1]), -2 * kPi, 1e-2);
}

TEST(FaceDomain, KnowsEveryCopyOfAPointOnAClosedSurface) {
  FaceBuilder b(torus(3.0, 1.0));
  b.rectangle(5.0, 3.0, 8.0, 7.0);  // across both seams of the principal rectangle
  const FaceDomain d = domain_of(b);
  const Uv inside{6.5, 6.5};
  for (int i = -3; i <= 3; ++i) {
    for (int j = -3; j <= 3; ++j) {
      const Uv copy{inside.u + 2 * kPi * i, inside.v + 2 * kPi * j};
      ASSERT_TRUE(d.contains(copy));
      EXPECT_NEAR(d.to_principal(copy).u, inside.u, 1e-12);
      EXPECT_NEAR(d.to_principal(copy).v, inside.v, 1e-12);
    }
  }
  const Uv outside{4.0, 5.0};
  EXPECT_FALSE(d.contains(outside));
  EXPECT_TRUE(d.to_principal(outside) == outside);
}

TEST(FaceDomain, HoldsPointsOnTheSeamAndAtThePoles) {
  FaceBuilder b(sphere(2.0));
  b.strip(0.0, -kPi / 2, kPi / 2, true, true);
  const FaceDomain d = domain_of(b);
  for (const Uv p : {Uv{0, 0.3}, {2 * kPi, 0.3}, {-1e-17, 0.3}, {1.0, kPi / 2}, {1.0, -kPi / 2}, {-40.0, 0.1}}) {
    EXPECT_TRUE(d.contains(p)) << p.u << " " << p.v;
  }
  EXPECT_EQ(d.distance_to_border({1.0, 0.5}), std::numeric_limits<double>::infinity());
}

TEST(FaceDomain, MeasuresTheWayToTheBorderInSpace) {
  FaceBuilder b(cylinder(10.0));
  b.strip(0.0, 0.0, 5.0).ellipse({0.2, 2.5}, 0.05, 0.5, true);
  const FaceDomain d = domain_of(b);
  EXPECT_NEAR(d.distance_to_border({3.0, 1.25}), 1.25, 1e-12);
  // The seam at u = 0 is no border, and the hole beyond it is 0.2 + 0.1 - 0.05 rad away.
  EXPECT_NEAR(d.distance_to_border({2 * kPi - 0.1, 2.5}), 2.5, 1e-12);
  EXPECT_NEAR(d.distance_to_border({2 * kPi - 0.02, 2.5}), 10.0 * (0.22 - 0.05), 1e-3);
}

TEST(FaceDomain, CoversTheWholeDomainWithoutLoops) {
  FaceBuilder b(sphere(1.0));
  const FaceDomain d = domain_of(b);
  EXPECT_TRUE(d.contains({1.0, 0.5}));
  EXPECT_EQ(d.distance_to_border({1.0, 0.5}), std::numeric_limits<double>::infinity());
}

TEST(FaceDomain, FindsWhereAPathLeaves) {
  FaceBuilder b(plane());
  b.rectangle(0, 0, 10, 10).ellipse({5, 5}, 1, 1, true);
  const FaceDomain d = domain_of(b);
  EXPECT_FALSE(d.first_exit({{1, 1}, {9, 1}, {9, 9}}));
  // Both ends inside, the hole between them.
  const auto hole = d.first_exit({{1, 1}, {1, 5}, {9, 5}});
  ASSERT_TRUE(hole);
  EXPECT_EQ(hole->out.segment, 1);
  EXPECT_NEAR(hole->out.uv.u, 4.0, 1e-3);
  EXPECT_NEAR(hole->out.k, 3.0 / 8.0, 1e-3);
  ASSERT_TRUE(hole->back);
  EXPECT_EQ(hole->back->segment, 1);
  EXPECT_NEAR(hole->back->uv.u, 6.0, 1e-3);
  const auto out = d.first_exit({{1, 1}, {3, 2}, {-1, 2}, {3, 3}});
  ASSERT_TRUE(out);
  EXPECT_EQ(out->out.segment, 1);
  EXPECT_NEAR(out->out.uv.u, 0.0, 1e-12);
  ASSERT_TRUE(out->back);
  EXPECT_EQ(out->back->segment, 2);
  EXPECT_NEAR(out->back->uv.u, 0.0, 1e-12);
  const auto from_outside = d.first_exit({{5, 5}, {1, 1}});
  ASSERT_TRUE(from_outside);
  EXPECT_EQ(from_outside->out.segment, 0);
}

TEST(FaceDomain, DoesNotCallAWalkAlongTheBorderAnExit) {
  FaceBuilder b(plane());
  b.rectangle(0, 0, 10, 10).ellipse({5, 5}, 1, 1, true);
  const FaceDomain d = domain_of(b);
  EXPECT_FALSE(d.first_exit({{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}}));
  std::vector<Uv> around;
  for (int i = 0; i <= 1000; ++i) around.push_back({5 + std::cos(i * 0.01), 5 + std::sin(i * 0.01)});
  EXPECT_FALSE(d.first_exit(around));
  // The same walk a little inside the hole is one.
  for (Uv& p : around) p = lerp({5, 5}, p, 0.99);
  around.insert(around.begin(), {5, 8});
  EXPECT_TRUE(d.first_exit(around));
}

TEST(FaceDomain, LetsAPathCrossASeamButNotTheRim) {
  FaceBuilder b(cylinder(1.0));
  b.strip(0.0, 0.0, 5.0);
  const FaceDomain d = domain_of(b);
  EXPECT_FALSE(d.first_exit({{6.0, 1.0}, {7.0, 2.0}, {20.0, 4.0}, {-20.0, 1.0}}));
  const auto rim = d.first_exit({{6.0, 1.0}, {20.0, 4.0}, {22.0, 6.0}});
  ASSERT_TRUE(rim);
  EXPECT_EQ(rim->out.segment, 1);
  EXPECT_NEAR(rim->out.uv.u, 21.0, 1e-9);
  EXPECT_NEAR(rim->out.uv.v, 5.0, 1e-9);
  EXPECT_FALSE(rim->back);
}

TEST(FaceDomain, SaysWhatIsWrongWithABrokenFace) {
  FaceBuilder no_surface(nullptr);
  EXPECT_THROW(domain_of(no_surface), Error);
  FaceBuilder no_pcurve(plane());
  no_pcurve.loop();
  no_pcurve.face().loops[0].coedges.push_back({0, nullptr, {0, 1}, false});
  EXPECT_THROW(domain_of(no_pcurve), Error);
  FaceBuilder not_finite(plane());
  not_finite.polygon({{0, 0}, {1, std::nan("")}, {1, 1}});
  EXPECT_THROW(domain_of(not_finite), Error);
  FaceBuilder fine(plane());
  fine.rectangle(0, 0, 1, 1);
  EXPECT_THROW(domain_of(fine, 0.0), Error);
}

TEST(ParameterStretch, IsOneForAnEvenlyScaledPlaneAndSeesAShear) {
  const auto affine = [](Xyz Su, Xyz Sv) {
    FaceBuilder b(std::make_shared<FunctionSurface>(UvBox{{0, 1}, {0, 1}}, [=](Uv p) {
      return SurfaceJet{Su * p.u + Sv * p.v, Su, Sv, Xyz::Zero(), Xyz::Zero(), Xyz::Zero()};
    }));
    return parameter_stretch(domain_of(b));
  };
  EXPECT_NEAR(affine({5, 0, 0}, {0, 0.01, 0}).anisotropy, 1.0, 1e-12);
  EXPECT_NEAR(affine({5, 0, 0}, {0, 0.01, 0}).smallest_angle, kPi / 2, 1e-12);
  // Unit vectors at the angle a: singular values sqrt(1 +- cos a).
  const double a = 0.3;
  const Stretch sheared = affine({7, 0, 0}, {2 * std::cos(a), 2 * std::sin(a), 0});
  EXPECT_NEAR(sheared.smallest_angle, a, 1e-12);
  EXPECT_NEAR(sheared.anisotropy, std::sqrt((1 + std::cos(a)) / (1 - std::cos(a))), 1e-9);
}

TEST(ParameterStretch, SeesHowUnequallyACurveIsRunThrough) {
  // r = (u^2, v): |Su| = 2u on [1, 3], |Sv| = 1. After scaling, the ratio at u is (u / g) or its inverse, with g the
  // geometric mean of u: log g = (3 log 3 - 2) / 2; the largest is g at u = 1.
  FaceBuilder b(std::make_shared<FunctionSurface>(UvBox{{1, 3}, {0, 1}}, [](Uv p) {
    return SurfaceJet{{p.u * p.u, p.v, 0}, {2 * p.u, 0, 0}, {0, 1, 0}, Xyz::Zero(), Xyz::Zero(), Xyz::Zero()};
  }));
  const double g = std::exp((3 * std::log(3.0) - 2) / 2);
  EXPECT_NEAR(parameter_stretch(domain_of(b)).anisotropy, g, 0.05 * g);
}

}  // namespace
}  // namespace geovor::testing
