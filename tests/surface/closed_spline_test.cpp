// B-splines that are closed without periodic knots: held against the same surface with periodic ones.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "support/splines.h"
#include "surface/bspline_curve.h"
#include "surface/bspline_surface.h"
#include "surface/swept_surfaces.h"

namespace geovor {
namespace {

using testing::SplineData;
using testing::uniform;

double distance(const SurfaceJet& a, const SurfaceJet& b) {
  return std::max({(a.S - b.S).norm(), (a.Su - b.Su).norm(), (a.Sv - b.Sv).norm(), (a.Suu - b.Suu).norm(),
                   (a.Suv - b.Suv).norm(), (a.Svv - b.Svv).norm()});
}

constexpr int kAround = 7;  // poles of the periodic tube, and its period

std::vector<Xyz> wavy_ring(int rows) {
  std::mt19937 random(5);
  std::vector<Xyz> poles;
  for (int i = 0; i < kAround; ++i)
    for (int j = 0; j < rows; ++j) {
      const double t = 2.0 * std::numbers::pi * i / kAround, r = 2.0 + uniform(random, -0.3, 0.3);
      poles.push_back({r * std::cos(t), r * std::sin(t), 2.0 * j + uniform(random, -0.2, 0.2)});
    }
  return poles;
}

const KnotVector kLine({0.0, 1.0}, {3, 3}, 2);
constexpr int kRows = 3;

BSplineSurface periodic_tube() {
  std::vector<double> knots;
  for (int i = 0; i <= kAround; ++i) knots.push_back(i);
  return {KnotVector(knots, std::vector<int>(kAround + 1, 1), 3, true), kLine, wavy_ring(kRows)};
}

/// The same cubic tube with clamped knots, by inserting the ends three times (Boehm) and leaving away what lies
/// outside.
SplineData clamped_tube() {
  const std::vector<Xyz> ring = wavy_ring(kRows);
  SplineData d;
  d.v_degree = 2;
  d.v_knots = kLine.flat();
  for (int i = -3; i <= kAround + 3; ++i) d.u_knots.push_back(i);
  for (int i = 0; i < d.u_count(); ++i)
    for (int j = 0; j < kRows; ++j) d.poles.push_back(ring[(i % kAround) * kRows + j]);
  for (int k = 0; k < 3; ++k) d = testing::insert_u_knot(d, 0.0);
  // Boehm's algorithm looks for the span to the right of the knot: the upper end is inserted in the mirrored spline.
  auto mirror = [](SplineData& s) {
    SplineData m = s;
    for (size_t i = 0; i < s.u_knots.size(); ++i) m.u_knots[i] = kAround - s.u_knots[s.u_knots.size() - 1 - i];
    for (int i = 0; i < s.u_count(); ++i)
      for (int j = 0; j < kRows; ++j) m.poles[i * kRows + j] = s.poles[(s.u_count() - 1 - i) * kRows + j];
    s = m;
  };
  mirror(d);
  for (int k = 0; k < 3; ++k) d = testing::insert_u_knot(d, 0.0);
  mirror(d);
  SplineData out = d;
  const auto first = std::find(d.u_knots.begin(), d.u_knots.end(), 0.0) - d.u_knots.begin();
  const auto end = std::find(d.u_knots.rbegin(), d.u_knots.rend(), double(kAround)).base() - d.u_knots.begin();
  out.u_knots.assign(d.u_knots.begin() + first, d.u_knots.begin() + end);
  out.poles.assign(d.poles.begin() + first * kRows, d.poles.begin() + (end - 4) * kRows);
  return out;
}

TEST(ClosedSpline, HasThePeriodAndTheJetsOfThePeriodicOne) {
  const BSplineSurface periodic = periodic_tube(), clamped = clamped_tube().surface();
  ASSERT_EQ(clamped.u_period(), std::optional(double(kAround)));
  EXPECT_FALSE(clamped.v_period());
  EXPECT_EQ(periodic.continuity(), 2);
  EXPECT_EQ(clamped.continuity(), 2);
  for (int i = -200; i < 400; ++i) {
    const Uv p{0.05 * i, 0.3};
    EXPECT_LT(distance(periodic.jet(p), clamped.jet(p)), 1e-13) << p.u;
    EXPECT_LT((periodic.position(p) - clamped.position(p)).norm(), 1e-14) << p.u;
    for (const double towards : {-1.0, 1.0}) {
      const Span a = periodic.span(p, {towards, 0.0}), b = clamped.span(p, {towards, 0.0});
      EXPECT_EQ(a.box.u.lo, b.box.u.lo) << p.u;
      EXPECT_EQ(a.box.u.hi, b.box.u.hi) << p.u;
      EXPECT_LT(distance(periodic.jet(p, a), clamped.jet(p, b)), 1e-13) << p.u;
    }
  }
}

/// A seam is as smooth as its poles make it.
TEST(ClosedSpline, MeasuresContinuityAtTheSeam) {
  const SplineData smooth = clamped_tube();
  SplineData bent = smooth, broken = smooth, other_speed = smooth;
  for (int j = 0; j < kRows; ++j) {
    bent.poles[2 * kRows + j] += Xyz(0.0, 0.0, 1e-3);    // the second derivative at u = 0
    broken.poles[1 * kRows + j] += Xyz(0.0, 0.0, 1e-3);  // the first one
    Xyz& next = other_speed.poles[1 * kRows + j];
    next += 0.1 * (next - other_speed.poles[j]);  // its length only
  }
  EXPECT_EQ(smooth.surface().continuity(), 2);
  EXPECT_EQ(bent.surface().continuity(), 1);
  EXPECT_EQ(broken.surface().continuity(), 0);
  EXPECT_EQ(other_speed.surface().continuity(), 0);
  for (const SplineData& d : {bent, broken, other_speed}) EXPECT_TRUE(d.surface().u_period());
}

TEST(ClosedSpline, OfRationalArcsRunsOnOverBothSeams) {
  const BSplineSurface periodic = testing::spline_torus(3.0, 1.0, true),
                       clamped = testing::spline_torus(3.0, 1.0, false);
  EXPECT_EQ(clamped.u_period(), periodic.u_period());
  EXPECT_EQ(clamped.v_period(), periodic.v_period());
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    const Uv p = testing::random_point(random, {{-9.0, 9.0}, {-9.0, 9.0}});
    EXPECT_LT(distance(periodic.jet(p), clamped.jet(p)), 1e-12);
  }
}

TEST(ClosedSpline, IsNotClosedWhereTheEndsAreApart) {
  SplineData open = clamped_tube();
  open.poles[0] += Xyz(1e-9, 0.0, 0.0);
  EXPECT_FALSE(open.surface().u_period());
  // Outside, the last span goes on.
  const Span last = open.surface().span({kAround + 1.0, 0.5}, {1.0, 0.0});
  EXPECT_TRUE(std::isinf(last.box.u.hi));
}

/// Both ends are one point, and the same one: a pole twice, but no seam.
TEST(ClosedSpline, IsNotClosedAtAPoint) {
  std::vector<Xyz> poles;
  for (const double z : {0.0, 1.0, 1.0, 0.0})
    for (const double x : {-1.0, 0.0, 1.0}) poles.push_back(Xyz(x * z, z * (1.0 - x * x), z));
  const BSplineSurface s(KnotVector({0.0, 1.0}, {4, 4}, 3), kLine, poles);
  EXPECT_FALSE(s.u_period());
}

/// Sweeps of a closed curve are closed: a circle as a clamped spline gives a torus and a cylinder.
TEST(ClosedSpline, GivesClosedSweeps) {
  const double kHalf = std::numbers::sqrt2 / 2.0;
  std::vector<Xyz> poles;
  std::vector<double> weights;
  for (int i = 0; i < 9; ++i) {
    const double t = 0.25 * std::numbers::pi * i, r = i % 2 == 1 ? std::numbers::sqrt2 : 1.0;
    poles.push_back(i == 8 ? poles.front() : Xyz(3.0 + r * std::cos(t), 0.0, r * std::sin(t)));
    weights.push_back(i % 2 == 1 ? kHalf : 1.0);
  }
  const auto circle =
      std::make_shared<BSplineCurve<3>>(KnotVector({0, 1, 2, 3, 4}, {3, 2, 2, 2, 3}, 2), poles, weights);
  const RevolutionSurface torus(circle, {0, 0, 0}, {0, 0, 1});
  const ExtrusionSurface cylinder(circle, {0, 1, 0});
  EXPECT_EQ(torus.v_period(), 4.0);
  EXPECT_EQ(cylinder.u_period(), 4.0);
  EXPECT_TRUE(torus.poles().empty());
  for (double x = -6.003; x < 10.0; x += 0.07) {
    const Xyz S = torus.position({0.3, x}), C = cylinder.position({x, 2.0});
    EXPECT_NEAR(std::hypot(std::hypot(S.x(), S.y()) - 3.0, S.z()), 1.0, 1e-15 * 4.0);
    EXPECT_NEAR(std::hypot(C.x() - 3.0, C.z()), 1.0, 1e-15 * 4.0);
    const Span span = cylinder.span({x, 0.0}, {-1.0, 0.0});
    EXPECT_TRUE(span.box.u.lo <= x && x <= span.box.u.hi);
    EXPECT_LT(distance(cylinder.jet({x, 2.0}, span), cylinder.jet({x, 2.0})), 1e-12);
  }
}

}  // namespace
}  // namespace geovor
