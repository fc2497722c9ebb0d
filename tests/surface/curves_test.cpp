#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "support/differences.h"
#include "surface/bspline_curve.h"
#include "surface/elementary_curves.h"

namespace geovor {
namespace {

using testing::worst_derivative_error;

constexpr double kPi = std::numbers::pi;

const ConicFrame<3> kFrame{{1, 2, 3}, {0.6, 0.8, 0}, {0, 0, 1}};
const ConicFrame<2> kClockwise{{1, 2}, {0, 1}, {1, 0}};

// The circle of four rational quadratic arcs, periodic as OpenCASCADE writes it, or clamped.
BSplineCurve<2> spline_circle(bool periodic) {
  const double h = std::numbers::sqrt2 / 2.0;
  std::vector<Eigen::Vector2d> poles{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
  std::vector<double> weights{1, h, 1, h, 1, h, 1, h};
  if (periodic) return {KnotVector({0, 1, 2, 3, 4}, {2, 2, 2, 2, 2}, 2, true), poles, weights};
  poles.push_back({1, 0});
  weights.push_back(1);
  return {KnotVector({0, 1, 2, 3, 4}, {3, 2, 2, 2, 3}, 2), poles, weights};
}

BSplineCurve<3> random_curve(int degree, bool rational) {
  std::mt19937 random(degree);
  std::vector<int> multiplicities{degree + 1, 1, 1, 1, degree + 1};
  const KnotVector knots({0, 0.7, 2.1, 3.2, 4}, multiplicities, degree);
  std::vector<Xyz> poles;
  std::vector<double> weights;
  for (int i = 0; i < knots.pole_count(); ++i) {
    poles.push_back({testing::uniform(random, -1, 1), testing::uniform(random, -1, 1), 1.0 * i});
    if (rational) weights.push_back(testing::uniform(random, 0.5, 2));
  }
  return {knots, poles, weights};
}

TEST(ElementaryCurves, HaveDerivativesThatMatchDifferences) {
  const Interval range{-2, 2};
  EXPECT_LT(worst_derivative_error(Line<3>({1, 2, 3}, {4, 5, 6}), range), 1e-10);
  EXPECT_LT(worst_derivative_error(Circle<3>(kFrame, 2.0), range), 1e-10);
  EXPECT_LT(worst_derivative_error(Ellipse<2>(kClockwise, 3.0, 2.0), range), 1e-10);
  EXPECT_LT(worst_derivative_error(Parabola<3>(kFrame, 0.5), range), 1e-10);
  EXPECT_LT(worst_derivative_error(Hyperbola<2>(kClockwise, 3.0, 2.0), range), 1e-10);
}

TEST(ElementaryCurves, LieOnTheirConics) {
  for (double t : {-1.3, 0.0, 0.4, 2.0}) {
    const Xyz e = Ellipse<3>(kFrame, 3.0, 2.0).position(t) - kFrame.centre;
    EXPECT_NEAR(std::pow(e.dot(kFrame.x) / 3.0, 2) + std::pow(e.dot(kFrame.y) / 2.0, 2), 1.0, 1e-14);
    const Xyz h = Hyperbola<3>(kFrame, 3.0, 2.0).position(t) - kFrame.centre;
    EXPECT_NEAR(std::pow(h.dot(kFrame.x) / 3.0, 2) - std::pow(h.dot(kFrame.y) / 2.0, 2), 1.0, 1e-13);
    // As far from the focus as from the directrix.
    const double f = 0.5;
    const Xyz p = Parabola<3>(kFrame, f).position(t) - kFrame.centre;
    EXPECT_NEAR((p - f * kFrame.x).norm(), p.dot(kFrame.x) + f, 1e-14);
    EXPECT_NEAR(p.dot(kFrame.y), t, 1e-14);
    EXPECT_NEAR((Circle<2>(kClockwise, 2.0).position(t) - kClockwise.centre).norm(), 2.0, 1e-14);
  }
  EXPECT_NEAR((Circle<2>(kClockwise, 2.0).position(kPi / 2) - Eigen::Vector2d(3, 2)).norm(), 0.0, 1e-15);
}

TEST(ElementaryCurves, RejectSizesWithoutSense) {
  EXPECT_THROW((Line<2>({0, 0}, {0, 0})), Error);
  EXPECT_THROW((Circle<2>(kClockwise, -1.0)), Error);
  EXPECT_THROW((Parabola<3>(kFrame, 0.0)), Error);
}

TEST(BSplineCurve, HasDerivativesThatMatchDifferences) {
  for (bool rational : {false, true})
    for (int degree : {1, 2, 3, 4, 7}) {
      const BSplineCurve<3> c = random_curve(degree, rational);
      EXPECT_LT(worst_derivative_error(c, c.domain()), 1e-7) << degree;
    }
}

TEST(BSplineCurve, IsACircleToRounding) {
  for (bool periodic : {false, true}) {
    const BSplineCurve<2> c = spline_circle(periodic);
    for (int i = 0; i <= 400; ++i) {
      const CurveJet<2> j = c.jet(0.01 * i);
      EXPECT_NEAR(j.C.norm(), 1.0, 1e-15);
      // Curvature x' y'' - y' x'' = |c'|^3.
      EXPECT_NEAR((j.d1.x() * j.d2.y() - j.d1.y() * j.d2.x()) / std::pow(j.d1.norm(), 3), 1.0, 1e-13);
    }
  }
}

TEST(BSplineCurve, PeriodicEqualsClampedAndRepeats) {
  const BSplineCurve<2> open = spline_circle(false), closed = spline_circle(true);
  for (int i = 0; i < 100; ++i) {
    const double t = 0.04 * i + 0.013;
    for (double turn : {0.0, 4.0, -8.0}) {
      EXPECT_NEAR((open.jet(t).C - closed.jet(t + turn).C).norm(), 0.0, 1e-14);
      EXPECT_NEAR((open.jet(t).d3 - closed.jet(t + turn).d3).norm(), 0.0, 1e-11);
    }
  }
  EXPECT_EQ(closed.period(), 4.0);
  EXPECT_FALSE(random_curve(3, false).period().has_value());
}

TEST(BSplineCurve, ClosedWithoutPeriodicKnotsRunsOnOverItsEnds) {
  const BSplineCurve<2> clamped = spline_circle(false), periodic = spline_circle(true);
  EXPECT_EQ(clamped.period(), 4.0);
  for (double t = -9.03; t < 9.0; t += 0.1) {
    EXPECT_LT((clamped.jet(t).C - periodic.jet(t).C).norm(), 1e-14) << t;
    EXPECT_LT((clamped.jet(t).d2 - periodic.jet(t).d2).norm(), 1e-12) << t;
  }
  EXPECT_EQ(clamped.breaks({-1.5, 4.5}), periodic.breaks({-1.5, 4.5}));
  EXPECT_EQ(clamped.breaks({0.0, 4.0}), (std::vector<double>{1.0, 2.0, 3.0}));
}

// A drop: degree 2, closed at a corner, then at a point of common tangents, then open by 1e-9.
TEST(BSplineCurve, MeasuresHowItsEndsMeet) {
  using P = BSplineCurve<2>::Point;
  const KnotVector knots({0, 1, 2}, {3, 1, 3}, 2);
  const BSplineCurve<2> corner(knots, {P(0, 0), P(1, 0), P(0, 1), P(0, 0)});
  EXPECT_EQ(corner.period(), 2.0);
  EXPECT_EQ(corner.continuity(), 0);
  const BSplineCurve<2> smooth(knots, {P(0, 0), P(1, 0), P(-1, 0), P(0, 0)});
  EXPECT_EQ(smooth.continuity(), 1);
  EXPECT_FALSE(BSplineCurve<2>(knots, {P(0, 0), P(1, 0), P(0, 1), P(1e-9, 0)}).period());
  EXPECT_FALSE(BSplineCurve<2>(knots, {P(1, 1), P(1, 1), P(1, 1), P(1, 1)}).period());
}

TEST(BSplineCurve, BreaksAreTheKnotsInsideTheRange) {
  const BSplineCurve<3> c = random_curve(3, false);
  EXPECT_EQ(c.breaks({0.0, 4.0}), (std::vector<double>{0.7, 2.1, 3.2}));
  EXPECT_EQ(c.breaks({0.7, 2.5}), (std::vector<double>{2.1}));
  EXPECT_EQ(spline_circle(true).breaks({3.5, 8.0}), (std::vector<double>{4, 5, 6, 7}));
  EXPECT_EQ(spline_circle(true).breaks({-1.5, 0.5}), (std::vector<double>{-1, 0}));
  EXPECT_TRUE((Circle<2>(kClockwise, 2.0).breaks({0, 6}).empty()));
}

TEST(BSplineCurve, PieceIsOnePolynomial) {
  const BSplineCurve<3> c = random_curve(3, false);
  const CurvePiece left = c.piece(2.1, -1.0), right = c.piece(2.1, 1.0);
  EXPECT_EQ(left.box.hi, 2.1);
  EXPECT_EQ(right.box.lo, 2.1);
  EXPECT_LT((c.jet(2.1, left).d2 - c.jet(2.1, right).d2).norm(), 1e-12);  // C2 between cubic pieces
  EXPECT_GT((c.jet(2.1, left).d3 - c.jet(2.1, right).d3).norm(), 1e-3);   // and no more
  EXPECT_LT((c.jet(9.0, left).d3 - c.jet(-5.0, left).d3).norm(), 1e-12);  // a cubic's third derivative is constant
}

TEST(BSplineCurve, RejectsDataThatDoNotFit) {
  const KnotVector knots({0, 1}, {3, 3}, 2);
  using P = Eigen::Vector2d;
  const std::vector<P> poles{P(0, 0), P(1, 1), P(2, 0)};
  EXPECT_NO_THROW(BSplineCurve<2>(knots, poles));
  EXPECT_THROW(BSplineCurve<2>(knots, {P(0, 0), P(1, 1)}), Error);
  EXPECT_THROW(BSplineCurve<2>(knots, poles, {1, 0, 1}), Error);
  EXPECT_THROW(BSplineCurve<2>(knots, poles, {1, 1}), Error);
  EXPECT_THROW(BSplineCurve<2>(knots, {P(0, 0), P(NAN, 1), P(2, 0)}), Error);
}

}  // namespace
}  // namespace geovor
