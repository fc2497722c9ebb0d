#include "geodesic/connect.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/differences.h"
#include "support/geodesic_oracles.h"
#include "support/splines.h"
#include "surface/analytic_surfaces.h"
#include "surface/elementary_surfaces.h"
#include "surface/forms.h"
#include "surface/reparameterize.h"

namespace geovor {
namespace {

using namespace testing;
constexpr double kPi = std::numbers::pi;
const UvBox kSquare{{-4.0, 4.0}, {-4.0, 4.0}};

// What every converged connection promises, held against the initial-value solver.
void expect_arrives(const Surface& surface, Uv from, Uv to, const Connection& c, double tolerance) {
  ASSERT_EQ(c.status, ConnectStatus::Converged);
  TraceOptions options;
  options.stop_at_domain = false;
  options.tolerance = 1e-14;
  const TraceResult path = trace_geodesic(surface, from, c.start_direction, c.length, options);
  EXPECT_LT(gap(surface, path.end.p, to), tolerance * c.length);
  EXPECT_NEAR(path.end.y, c.y, 1e-9 * c.length);
  const SurfaceJet a = surface.jet(path.end.p), b = surface.jet(to);
  EXPECT_LT((push_forward(a, path.end.d) - push_forward(b, c.end_direction)).norm(), 1e-9);
  EXPECT_NEAR(std::remainder(angle_of_direction(first_form(surface.jet(from)), c.start_direction) - c.angle, 2.0 * kPi),
              0.0, 1e-10);
}

TEST(Connect, ArrivesOnWaveAtAllDistances) {
  const WaveSurface wave(kSquare);
  std::mt19937 random(1);
  for (const double d : {0.01, 0.1, 0.5, 1.0, 2.0, 4.0}) {
    for (int i = 0; i < 60; ++i) {
      const Uv p = random_point(random, kSquare);
      const double t = uniform(random, 0.0, 2.0 * kPi);
      const Uv q{p.u + d * std::cos(t), p.v + d * std::sin(t)};
      expect_arrives(wave, p, q, connect(wave, p, q), 5e-12);
    }
  }
}

TEST(Connect, LengthIsTheGreatCirclesOnAFunctionSphere) {
  std::mt19937 random(2);
  for (const double R : {1e-3, 1.0, 1e6}) {
    const Ellipsoid sphere(R, R, R);
    for (int i = 0; i < 100; ++i) {
      const Uv p = random_point(random, {{0.0, 1.5}, {-0.8, 0.8}}), q = random_point(random, {{0.0, 1.5}, {-0.8, 0.8}});
      const Connection c = connect(sphere, p, q);
      const double d = great_circle_distance(sphere.position(p), sphere.position(q), R);
      expect_arrives(sphere, p, q, c, 5e-12);
      EXPECT_NEAR(c.length, d, 1e-12 * R);
      EXPECT_NEAR(c.y, R * std::sin(d / R), 1e-11 * R);
    }
  }
}

TEST(Connect, WorksAtTinyDistances) {
  const WaveSurface wave(kSquare);
  const Uv p{0.7, 0.4};
  for (const double h : {1e-3, 1e-5, 1e-8}) {
    const Uv q{p.u + h, p.v + 0.5 * h};
    const Connection c = connect(wave, p, q);
    ASSERT_EQ(c.status, ConnectStatus::Converged);
    const double chord = gap(wave, p, q);
    EXPECT_GE(c.length, chord * (1.0 - 1e-7 * (h < 1e-6)));
    EXPECT_LT(c.length, chord * (1.0 + h * h) + 1e-15);
    EXPECT_NEAR(c.y, c.length, h * h * h + 1e-14 * h);
    // The position itself is known to 1e-16 only.
    EXPECT_LT(c.residual, 1e-11 * c.length + 1e-15);
  }
}

TEST(Connect, ZeroDistanceHasLengthZero) {
  const WaveSurface wave(kSquare);
  const Connection c = connect(wave, {0.7, 0.4}, {0.7, 0.4});
  EXPECT_EQ(c.status, ConnectStatus::Converged);
  EXPECT_EQ(c.length, 0.0);
  EXPECT_EQ(c.y, 0.0);
  EXPECT_NEAR(norm(first_form(wave.jet({0.7, 0.4})), c.start_direction), 1.0, 1e-14);
}

TEST(Connect, IsSymmetric) {
  const WaveSurface wave(kSquare);
  std::mt19937 random(3);
  for (int i = 0; i < 60; ++i) {
    const Uv p = random_point(random, kSquare);
    const Uv q{p.u + uniform(random, -1.0, 1.0), p.v + uniform(random, -1.0, 1.0)};
    const Connection there = connect(wave, p, q);
    const Connection back =
        connect(wave, q, p,
                Polar{there.length,
                      std::remainder(angle_of_direction(first_form(wave.jet(q)), -there.end_direction), 2.0 * kPi)});
    ASSERT_EQ(back.status, ConnectStatus::Converged);
    EXPECT_NEAR(there.length, back.length, 5e-12 * there.length);
    EXPECT_NEAR(there.y, back.y, 1e-9);
  }
}

TEST(Connect, AGuessSavesEvaluations) {
  const WaveSurface wave(kSquare);
  std::mt19937 random(8);
  int cold_evaluations = 0, warm_evaluations = 0;
  for (int i = 0; i < 30; ++i) {
    const Uv p = random_point(random, kSquare), q{p.u + 2.5, p.v + uniform(random, -0.8, 0.8)};
    const Uv near{q.u + 1e-4, q.v - 1e-4};
    const Connection known = connect(wave, p, q), cold = connect(wave, p, near);
    const Connection warm = connect(wave, p, near, Polar{known.length, known.angle});
    EXPECT_NEAR(warm.length, cold.length, 1e-11);
    cold_evaluations += cold.evaluations;
    warm_evaluations += warm.evaluations;
  }
  EXPECT_LT(warm_evaluations, cold_evaluations);
}

// From a guess that points the wrong way shooting gives up and the energy method takes over.
TEST(Connect, RecoversFromABadGuess) {
  const WaveSurface wave(kSquare);
  const Uv p{0.3, 0.2}, q{1.1, 0.9};
  const Connection good = connect(wave, p, q), bad = connect(wave, p, q, Polar{good.length, good.angle + 2.5});
  expect_arrives(wave, p, q, bad, 5e-12);
}

TEST(Connect, IsBlindToStretchedAndShearedParameters) {
  const auto wave = std::make_shared<WaveSurface>(kSquare);
  const Reparameterized stretched(wave, affine_map(1e-3, 0.0), affine_map(1.0, 0.0));
  const Reparameterized uneven(wave, moebius_map(kSquare.u, 30.0), moebius_map(kSquare.v, 1.0 / 30.0));
  std::mt19937 random(4);
  for (int i = 0; i < 60; ++i) {
    const Uv p = random_point(random, {{-3.0, 3.0}, {-3.0, 3.0}});
    const Uv q{p.u + uniform(random, -0.7, 0.7), p.v + uniform(random, -0.7, 0.7)};
    const Connection plain = connect(*wave, p, q);
    for (const Reparameterized* other : {&stretched, &uneven}) {
      const Connection c = connect(*other, other->from_base(p), other->from_base(q));
      ASSERT_EQ(c.status, ConnectStatus::Converged);
      EXPECT_NEAR(c.length, plain.length, 1e-10 * plain.length);
      EXPECT_NEAR(c.y, plain.y, 1e-9);
    }
  }
}

// A plane whose parameter lines meet at a thousandth of a radian, bent into a cylinder.
class ShearedCylinder final : public Surface {
 public:
  SurfaceKind kind() const override { return SurfaceKind::Function; }
  UvBox domain() const override { return {{-3e3, 3e3}, {-3e3, 3e3}}; }
  SurfaceJet jet(Uv p) const override {
    const double k = 1e-3, x = p.u + p.v, c = std::cos(x), s = std::sin(x);
    const Xyz around{-s, c, 0.0}, in{-c, -s, 0.0};
    return {{c, s, k * p.v}, around, around + k * Xyz::UnitZ(), in, in, in};
  }
  using Surface::jet;
};

TEST(Connect, WorksWhereParameterLinesAreSheared) {
  const ShearedCylinder cylinder;
  std::mt19937 random(5);
  for (int i = 0; i < 60; ++i) {
    const double x = uniform(random, -2.0, 2.0), z = uniform(random, -1.0, 1.0);
    const Connection c = connect(cylinder, {0.0, 0.0}, {x - 1e3 * z, 1e3 * z});
    ASSERT_EQ(c.status, ConnectStatus::Converged);
    // u'^2 Suu + ... is a unit left of terms of |(u',v')|^2 = 1e6 units: their rounding, 1e-10, over s^2 / 2 < 2.5.
    EXPECT_NEAR(c.length, std::hypot(x, z), 4e-10);
  }
}

TEST(Connect, ArrivesAcrossKnots) {
  const BSplineSurface spline = random_spline(3, 3, 10, false, 17).surface();
  std::mt19937 random(6);
  for (int i = 0; i < 60; ++i) {
    const Uv p = random_point(random, {{3.0, 7.0}, {3.0, 7.0}});
    const Uv q{p.u + uniform(random, -1.5, 1.5), p.v + uniform(random, -1.5, 1.5)};
    expect_arrives(spline, p, q, connect(spline, p, q), 1e-11);
  }
}

TEST(Connect, SaysWhenThePathLeavesTheDomain) {
  const Paraboloid bowl({{-1.0, 1.0}, {-1.0, 1.0}});
  const Connection out = connect(bowl, {1.0, -0.9}, {1.0, 0.9});
  ASSERT_EQ(out.status, ConnectStatus::Converged);
  EXPECT_TRUE(out.leaves_domain);
  EXPECT_NEAR(out.length, 1.950, 1e-3);  // notes of the paper's figure 4: it runs out to u = 1.30
  EXPECT_FALSE(connect(bowl, {0.5, -0.4}, {0.5, 0.4}).leaves_domain);
  EXPECT_FALSE(connect(bowl, {0.0, -1.0}, {0.0, 1.0}).leaves_domain);
}

TEST(Connect, TakesTheWindingOfTheGuessOnACylinder) {
  const Cylinder cylinder({}, 2.0);
  const Uv p{0.1, 0.0}, q{0.1 + 0.5, 3.0};
  EXPECT_NEAR(connect(cylinder, p, q).length, std::hypot(1.0, 3.0), 1e-14);
  EXPECT_NEAR(connect(cylinder, p, {q.u + 2.0 * kPi, q.v}).length, std::hypot(1.0, 3.0), 1e-14);
  const double round = 1.0 - 4.0 * kPi;
  const Connection other = connect(cylinder, p, q, Polar{12.0, std::atan2(3.0, -12.0)});
  EXPECT_NEAR(other.length, std::hypot(round, 3.0), 1e-13);
  EXPECT_NEAR(other.angle, std::atan2(3.0, round), 1e-14);
}

TEST(Connect, IsTheGreatCircleOnTheSpherePolesAndAll) {
  const Sphere sphere({}, 2.0);
  std::mt19937 random(7);
  for (int i = 0; i < 100; ++i) {
    const Uv p = random_point(random, {{0.0, 6.0}, {-1.57, 1.57}}),
             q = random_point(random, {{0.0, 6.0}, {-1.57, 1.57}});
    const Connection c = connect(sphere, p, q);
    const double d = great_circle_distance(sphere.position(p), sphere.position(q), 2.0);
    EXPECT_NEAR(c.length, d, 1e-14);
    const TraceResult path = trace_geodesic(sphere, p, c.start_direction, c.length);
    EXPECT_LT(gap(sphere, path.end.p, q), 1e-13);
    const Connection around = connect(sphere, p, q, Polar{4.0 * kPi - d, c.angle + kPi});
    EXPECT_NEAR(around.length, 4.0 * kPi - d, 1e-13);
  }
  EXPECT_NEAR(connect(sphere, {0.0, kPi / 2.0}, {1.0, 0.0}).length, kPi, 1e-14);
  EXPECT_NEAR(connect(sphere, {0.0, 0.0}, {kPi, 0.0}).length, 2.0 * kPi, 1e-14);
  EXPECT_EQ(connect(sphere, {0.3, 0.1}, {0.3, 0.1}).length, 0.0);
}

// From the pole down a meridian, an ellipse: its length by Simpson's rule.
TEST(Connect, StartsAtAPole) {
  const Ellipsoid ellipsoid(1.0, 1.0, 0.8);
  constexpr int kPieces = 2000;
  const double h = (kPi / 2.0 - 1.0) / kPieces;
  double arc = 0.0;
  for (int i = 0; i <= kPieces; ++i) {
    const double v = 1.0 + i * h, weight = i == 0 || i == kPieces ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    arc += weight * h / 3.0 * std::hypot(std::sin(v), 0.8 * std::cos(v));
  }
  const Connection c = connect(ellipsoid, {0.0, kPi / 2.0}, {1.0, 1.0});
  ASSERT_EQ(c.status, ConnectStatus::Converged);
  EXPECT_NEAR(c.length, arc, 1e-12);
}

}  // namespace
}  // namespace geovor
