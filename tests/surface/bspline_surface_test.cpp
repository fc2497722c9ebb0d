#include "surface/bspline_surface.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "support/differences.h"
#include "support/splines.h"
#include "surface/elementary_surfaces.h"
#include "surface/forms.h"

namespace geovor {
namespace {

using testing::insert_u_knot;
using testing::random_point;
using testing::random_spline;
using testing::spline_torus;
using testing::SplineData;
using testing::worst_derivative_error;

TEST(BSplineSurface, HasDerivativesThatMatchDifferences) {
  for (bool rational : {false, true}) {
    for (auto [p, q] : {std::pair{1, 1}, {2, 2}, {3, 3}, {5, 5}, {3, 2}, {1, 7}, {11, 4}}) {
      const BSplineSurface s = random_spline(p, q, 4, rational, 10 * p + q).surface();
      EXPECT_LT(worst_derivative_error(s, s.domain(), 1e-3, 100), 1e-7) << p << " x " << q << " rational " << rational;
    }
  }
}

// De Boor's corner cutting, written out for one curve of poles: a second method.
Xyz de_boor(const std::vector<double>& t, int p, std::vector<Xyz> d, int k, double x) {
  for (int r = 1; r <= p; ++r)
    for (int j = p; j >= r; --j) {
      const double a = (x - t[j + k - p]) / (t[j + 1 + k - r] - t[j + k - p]);
      d[j] = (1 - a) * d[j - 1] + a * d[j];
    }
  return d[p];
}

TEST(BSplineSurface, AgreesWithCornerCuttingAtEveryDegree) {
  std::mt19937 random(3);
  for (int p = 1; p <= kMaxDegree; ++p) {
    const SplineData data = random_spline(p, 3, 3, false, p);
    const BSplineSurface s = data.surface();
    for (int i = 0; i < 20; ++i) {
      const Uv q = random_point(random, s.domain());
      auto knot_below = [](const std::vector<double>& t, int degree, double x) {
        int k = degree;
        while (t[k + 1] <= x) ++k;
        return k;
      };
      const int ku = knot_below(data.u_knots, p, q.u), kv = knot_below(data.v_knots, 3, q.v);
      std::vector<Xyz> column;
      for (int a = ku - p; a <= ku; ++a) {
        const auto first = data.poles.begin() + a * data.v_count() + kv - 3;
        column.push_back(de_boor(data.v_knots, 3, {first, first + 4}, kv, q.v));
      }
      EXPECT_NEAR((s.position(q) - de_boor(data.u_knots, p, column, ku, q.u)).norm(), 0.0, 1e-14);
    }
  }
}

// Partition of unity: equal poles give a point, whatever the weights, and no derivative.
TEST(BSplineSurface, BasisFunctionsAddUpToOne) {
  for (int p : {1, 2, 3, 6, 25}) {
    SplineData data = random_spline(p, p, 5, true, p);
    for (Xyz& pole : data.poles) pole = {7, -8, 9};
    const BSplineSurface s = data.surface();
    std::mt19937 random(1);
    for (int i = 0; i < 50; ++i) {
      const SurfaceJet j = s.jet(random_point(random, s.domain()));
      EXPECT_NEAR((j.S - Xyz(7, -8, 9)).norm(), 0.0, 1e-14);
      EXPECT_NEAR(j.Su.norm() + j.Svv.norm(), 0.0, 1e-12);
    }
  }
}

TEST(BSplineSurface, StaysTheSameUnderKnotInsertion) {
  for (bool rational : {false, true}) {
    for (int p : {1, 2, 3, 4, 5}) {
      const SplineData before = random_spline(p, 3, 4, rational, 20 + p);
      const SplineData after = insert_u_knot(insert_u_knot(before, 1.47), 2.5);
      const BSplineSurface a = before.surface(), b = after.surface();
      std::mt19937 random(2);
      for (int i = 0; i < 200; ++i) {
        const Uv q = random_point(random, a.domain());
        EXPECT_LT(testing::distance(a.jet(q), b.jet(q)), 1e-11 * std::pow(10, p - 1)) << p;
      }
    }
  }
}

TEST(BSplineSurface, IsATorusToRounding) {
  for (bool periodic : {false, true}) {
    const BSplineSurface s = spline_torus(3.0, 1.0, periodic);
    std::mt19937 random(4);
    for (int i = 0; i < 200; ++i) {
      const Uv q = random_point(random, s.domain());
      const SurfaceJet j = s.jet(q);
      const double radius = std::hypot(j.S.x(), j.S.y());
      EXPECT_NEAR(std::hypot(radius - 3.0, j.S.z()), 1.0, 4e-15);
      const double circle = (radius - 3.0) / radius;  // cos v / (R + r cos v)
      EXPECT_NEAR(curvatures(j).gauss, circle, 1e-12);
    }
  }
}

TEST(BSplineSurface, PeriodicEqualsClampedAndRepeats) {
  const BSplineSurface open = spline_torus(3.0, 1.0, false), closed = spline_torus(3.0, 1.0, true);
  ASSERT_EQ(closed.u_period(), 4.0);
  EXPECT_EQ(open.u_period(), closed.u_period());  // closed without saying so
  std::mt19937 random(5);
  for (int i = 0; i < 200; ++i) {
    const Uv q = random_point(random, open.domain());
    EXPECT_LT(testing::distance(open.jet(q), closed.jet(q)), 1e-13);
    EXPECT_LT(testing::distance(open.jet(q), closed.jet({q.u + 8.0, q.v - 12.0})), 1e-12);
  }
}

// Simple knots at the ends of the period: the poles wrap round, and the seam is as smooth as any other knot.
TEST(BSplineSurface, IsSmoothAcrossTheSeamOfSimpleKnots) {
  const KnotVector around({0.0, 1.0, 2.5, 3.0, 5.0, 6.0}, {1, 1, 1, 1, 1, 1}, 3, true);
  const KnotVector along({0.0, 1.0}, {4, 4}, 3);
  ASSERT_EQ(around.pole_count(), 5);
  std::mt19937 random(6);
  std::vector<Xyz> poles;
  for (int i = 0; i < 20; ++i)
    poles.push_back(
        {testing::uniform(random, -1, 1), testing::uniform(random, -1, 1), testing::uniform(random, -1, 1)});
  const BSplineSurface s(around, along, poles);
  EXPECT_EQ(s.continuity(), 2);
  for (double seam : {0.0, 6.0, -6.0, 12.0}) {
    const Span left = s.span({seam, 0.3}, {-1, 0}), right = s.span({seam, 0.3}, {1, 0});
    EXPECT_NEAR(left.box.u.hi, seam, 1e-14);
    EXPECT_NEAR(left.box.u.lo, seam - 1.0, 1e-14);
    EXPECT_NEAR(right.box.u.lo, seam, 1e-14);
    EXPECT_NEAR(right.box.u.hi, seam + 1.0, 1e-14);
    EXPECT_LT(testing::distance(s.jet({seam, 0.3}, left), s.jet({seam, 0.3}, right)), 1e-13);
  }
}

TEST(BSplineSurface, LockedJetIsThePlainJetInsideItsSpan) {
  for (bool rational : {false, true}) {
    const BSplineSurface s = random_spline(3, 3, 6, rational, 30).surface();
    std::mt19937 random(7);
    for (int i = 0; i < 200; ++i) {
      const Uv q = random_point(random, s.domain());
      const Span span = s.span(q, {1, 1});
      EXPECT_TRUE(span.box.contains(q));
      EXPECT_EQ(testing::distance(s.jet(q), s.jet(q, span)), 0.0);
    }
  }
}

TEST(BSplineSurface, PositionIsThatOfTheJet) {
  std::mt19937 random(11);
  for (bool rational : {false, true}) {
    const BSplineSurface open = random_spline(4, 3, 5, rational, 34).surface(), closed = spline_torus(3.0, 1.0, true);
    for (int i = 0; i < 100; ++i) {
      const Uv q = random_point(random, {{-3, 9}, {0, 4}});
      EXPECT_NEAR((closed.position(q) - closed.jet(q).S).norm(), 0.0, 1e-14);
      const Uv r = random_point(random, open.domain());
      EXPECT_NEAR((open.position(r) - open.jet(r).S).norm(), 0.0, 1e-14);
    }
  }
}

// A bicubic span is one polynomial: its fourth difference in u vanishes also across the knots, where the plain jet's
// doesn't.
TEST(BSplineSurface, LockedJetContinuesThePolynomialAcrossKnots) {
  const BSplineSurface s = random_spline(3, 3, 6, false, 31).surface();
  const Span span = s.span({2.5, 2.5}, {1, 1});
  auto fourth_difference = [&](auto position) {
    Xyz sum = Xyz::Zero();
    constexpr double kBinomial[] = {1, -4, 6, -4, 1};
    for (int i = 0; i < 5; ++i) sum += kBinomial[i] * position(1.0 + 0.75 * i);
    return sum.norm();
  };
  EXPECT_LT(fourth_difference([&](double u) { return s.jet({u, 2.5}, span).S; }), 1e-12);
  EXPECT_GT(fourth_difference([&](double u) { return s.jet({u, 2.5}).S; }), 1e-3);
}

TEST(BSplineSurface, SpanOnAKnotFollowsTheDirection) {
  const BSplineSurface s = random_spline(3, 3, 6, false, 32).surface();
  for (double knot : s.knot_lines().u) {
    const Span left = s.span({knot, 1.1}, {-1e-3, 1}), right = s.span({knot, 1.1}, {1e-3, 1});
    EXPECT_EQ(left.box.u.hi, knot);
    EXPECT_EQ(right.box.u.lo, knot);
    // The same with a parameter that misses the knot by a rounding, on either side.
    for (double x : {std::nextafter(knot, -1.0), std::nextafter(knot, 99.0)}) {
      EXPECT_EQ(s.span({x, 1.1}, {-1, 0}).box.u.hi, knot);
      EXPECT_EQ(s.span({x, 1.1}, {1, 0}).box.u.lo, knot);
    }
    // C2 there: the two pieces agree up to the second order.
    EXPECT_LT(testing::distance(s.jet({knot, 1.1}, left), s.jet({knot, 1.1}, right)), 1e-12);
  }
}

TEST(BSplineSurface, BoxesAreOpenBeyondTheDomain) {
  const BSplineSurface s = random_spline(3, 2, 3, false, 33).surface();
  const Span first = s.span({0.0, 0.0}, {-1, -1}), last = s.span({3.0, 3.0}, {1, 1});
  EXPECT_EQ(first.box.u.lo, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(last.box.v.hi, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(s.span({-0.5, 4.0}, {}).box.contains({-0.5, 4.0}));
  // Continued by the same polynomial.
  EXPECT_EQ(testing::distance(s.jet({-0.5, 4.0}), s.jet({-0.5, 4.0}, s.span({0.01, 2.99}, {}))), 0.0);
}

// On a periodic surface an integrator leaves the principal period: the box must go along with it.
TEST(BSplineSurface, BoxesFollowAPathRoundThePeriod) {
  const BSplineSurface s = spline_torus(3.0, 1.0, true);
  Uv p{3.5, 0.5};
  for (int i = 0; i < 20; ++i) {
    const Span span = s.span(p, {1, 0});
    ASSERT_TRUE(span.box.contains(p));
    ASSERT_NEAR(span.box.u.length(), 1.0, 1e-13);
    EXPECT_LT(testing::distance(s.jet(p, span), s.jet(p)), 1e-11);
    ASSERT_GT(span.box.u.hi, p.u);
    p.u = span.box.u.hi;
  }
  EXPECT_NEAR(p.u, 23.0, 1e-12);
}

TEST(BSplineSurface, ContinuityComesFromTheMultiplicities) {
  EXPECT_EQ(random_spline(3, 3, 1, false, 1).surface().continuity(), Surface::kSmooth);
  const SplineData cubic = random_spline(3, 4, 4, false, 1);
  EXPECT_EQ(cubic.surface().continuity(), 2);
  EXPECT_EQ(insert_u_knot(cubic, cubic.u_knots[4]).surface().continuity(), 1);
  EXPECT_EQ(spline_torus(3, 1, true).continuity(), 0);
}

TEST(BSplineSurface, FarFromTheOriginItsDerivativesKeepTheirDigits) {
  SplineData data = random_spline(3, 3, 4, false, 40);
  const BSplineSurface at_home = data.surface();
  const Xyz far(1048576.0, -2097152.0, 524288.0);  // powers of two: moving rounds the poles only
  for (Xyz& p : data.poles) p += far;
  const BSplineSurface away = data.surface();
  std::mt19937 random(8);
  for (int i = 0; i < 100; ++i) {
    const Uv q = random_point(random, at_home.domain());
    EXPECT_LT((at_home.jet(q).Suu - away.jet(q).Suu).norm(), 3e-8);
    // The derivatives are those of the moved poles to rounding of *their* size: smooth, not noise of 1e6 * eps / h^2.
    const double h = 1e-5;
    const Xyz slope =
        (away.jet({q.u + h, q.v}, away.span(q, {})).Su - away.jet({q.u - h, q.v}, away.span(q, {})).Su) / (2 * h);
    EXPECT_LT((slope - away.jet(q).Suu).norm(), 1e-9);
  }
}

TEST(BSplineSurface, RejectsDataThatDoNotFit) {
  const SplineData good = random_spline(3, 3, 2, true, 50);
  auto broken = [&good](auto breakage) {
    SplineData d = good;
    breakage(d);
    return d;
  };
  EXPECT_NO_THROW(good.surface());
  EXPECT_THROW(broken([](SplineData& d) { d.poles.pop_back(); }).surface(), Error);
  EXPECT_THROW(broken([](SplineData& d) { d.weights.pop_back(); }).surface(), Error);
  EXPECT_THROW(broken([](SplineData& d) { d.weights[3] = 0.0; }).surface(), Error);
  EXPECT_THROW(broken([](SplineData& d) { d.weights[3] = -1.0; }).surface(), Error);
  EXPECT_THROW(broken([](SplineData& d) { d.poles[3].x() = NAN; }).surface(), Error);
  EXPECT_THROW(broken([](SplineData& d) { std::swap(d.u_knots[4], d.u_knots[5]); }).surface(), Error);
  EXPECT_THROW(broken([](SplineData& d) { d.u_knots[2] = NAN; }).surface(), Error);
  EXPECT_THROW(KnotVector({0, 1}, {27, 27}, 26), Error);
  EXPECT_THROW(KnotVector({0, 1}, {1, 1}, 0), Error);
  EXPECT_THROW(KnotVector({0, 1, 2}, {4, 4, 4}, 3), Error);        // torn apart in the middle
  EXPECT_THROW(KnotVector({0, 1, 2}, {1, 1, 2}, 3, true), Error);  // the seam's two ends differ
  EXPECT_THROW(KnotVector({0, 1}, {4, 3}, 3), Error);              // too few for one span
  try {
    broken([](SplineData& d) { d.poles.pop_back(); }).surface();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::FaceRejected);
  }
}

TEST(KnotVector, FindsTheSpanOfEveryParameterOnUnevenKnots) {
  std::mt19937 random(9);
  std::vector<double> knots{0.0};
  for (int i = 0; i < 300; ++i) knots.push_back(knots.back() + std::pow(10.0, testing::uniform(random, -5, 2)));
  std::vector<int> multiplicities(knots.size(), 1);
  multiplicities.front() = multiplicities.back() = 4;
  const KnotVector k(knots, multiplicities, 3);
  for (int i = 0; i < 20000; ++i) {
    const double x = testing::uniform(random, 0.0, knots.back());
    const KnotSpan s = k.find(x, 0.0);
    ASSERT_LE(k.flat()[s.index], x);
    ASSERT_GT(k.flat()[s.index + 1], x);
  }
  for (size_t i = 0; i + 1 < knots.size(); ++i) {
    ASSERT_EQ(k.flat()[k.find(knots[i], 1.0).index], knots[i]);
    ASSERT_EQ(k.flat()[k.find(knots[i + 1], -1.0).index], knots[i]);
  }
}

}  // namespace
}  // namespace geovor
