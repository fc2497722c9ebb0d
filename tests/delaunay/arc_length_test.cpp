#include "delaunay/arc_length.h"

#include <gtest/gtest.h>

#include <boost/math/special_functions/ellint_2.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>

#include "base/xyz.h"
#include "surface/bspline_curve.h"
#include "surface/elementary_curves.h"

namespace geovor {
namespace {

constexpr double kPi = std::numbers::pi;

ConicFrame<3> frame() { return {{1, 2, 3}, Xyz(1, 2, 2) / 3.0, Xyz(2, 1, -2) / 3.0}; }

/// base(map(t)), with the map's derivative.
class Renamed final : public Curve3 {
 public:
  using Map = std::function<std::pair<double, double>(double)>;
  Renamed(const Curve3& base, Interval range, Map map) : base_(base), range_(range), map_(std::move(map)) {}
  Interval domain() const override { return range_; }
  CurveJet<3> jet(double t) const override {
    const auto [x, d] = map_(t);
    CurveJet<3> j = base_.jet(x);
    j.d1 *= d;
    return j;
  }

 private:
  const Curve3& base_;
  Interval range_;
  Map map_;
};

struct KnownWay {
  const char* name;
  const Curve3* curve;
  Interval range;
  std::function<double(double)> way;  // from range.lo to t
};

void PrintTo(const KnownWay& known, std::ostream* out) { *out << known.name; }

// The arc of an ellipse from the end of its major axis, a the larger half: a (E(e) - E(pi/2 - t, e)).
double ellipse_way(double a, double b, double t) {
  const double e = std::sqrt(1.0 - b * b / (a * a));
  return a * (boost::math::ellint_2(e, kPi / 2) - boost::math::ellint_2(e, kPi / 2 - t));
}

// Of t^2 / (4 f), t from its vertex: t/2 sqrt(1 + t^2/4f^2) + f asinh(t / 2f).
double parabola_way(double f, double t) {
  return 0.5 * t * std::sqrt(1.0 + t * t / (4 * f * f)) + f * std::asinh(t / (2 * f));
}

const Circle<3> kCircle(frame(), 2.5);
const Ellipse<3> kEllipse(frame(), 7.0, 0.05);  // curvature 2800 at the sharp end
const Parabola<3> kParabola(frame(), 0.3);
const Line<3> kLine({1, 2, 3}, {0.5, 0.0, 0.0});
const Renamed kCubed(kCircle, {0, 1}, [](double t) { return std::pair(t * t * t, 3 * t * t); });
const Renamed kSmooth(kCircle, {0, 1}, [](double t) { return std::pair(t * t * (3 - 2 * t), 6 * t * (1 - t)); });
const Renamed kMoebius(kEllipse, {0, 1}, [](double t) {
  constexpr double a = 64.0;
  const double w = t + a * (1 - t);
  return std::pair(kPi / 2 * t / w, kPi / 2 * a / (w * w));
});

const KnownWay kKnown[] = {
    {"line", &kLine, {-3, 5}, [](double t) { return 0.5 * (t + 3); }},
    {"circle", &kCircle, {0.3, 6.2}, [](double t) { return 2.5 * (t - 0.3); }},
    {"ellipse", &kEllipse, {0, kPi / 2}, [](double t) { return ellipse_way(7.0, 0.05, t); }},
    {"parabola", &kParabola, {-2, 9}, [](double t) { return parabola_way(0.3, t) - parabola_way(0.3, -2); }},
    {"circle by t^3", &kCubed, {0, 1}, [](double t) { return 2.5 * t * t * t; }},
    {"circle at rest at both ends", &kSmooth, {0, 1}, [](double t) { return 2.5 * t * t * (3 - 2 * t); }},
    {"ellipse by a Moebius map", &kMoebius, {0, 1}, [](double t) {
       return ellipse_way(7.0, 0.05, kPi / 2 * t / (t + 64.0 * (1 - t)));
     }}};

class ArcLengthOf : public ::testing::TestWithParam<KnownWay> {};

TEST_P(ArcLengthOf, IsTheClosedForm) {
  const KnownWay& known = GetParam();
  const ArcLength way(*known.curve, known.range);
  EXPECT_NEAR(way.length(), known.way(known.range.hi), 1e-13 * way.length());
}

// The closed form of the way at the parameter is the way that was asked for.
TEST_P(ArcLengthOf, IsInvertedTo13Digits) {
  const KnownWay& known = GetParam();
  const ArcLength way(*known.curve, known.range);
  constexpr int kPlaces = 997;
  double last = known.range.lo;
  for (int k = 1; k < kPlaces; ++k) {
    const double s = way.length() * k / kPlaces, t = way.parameter(s);
    EXPECT_NEAR(known.way(t), s, 1e-13 * way.length()) << k;
    EXPECT_GT(t, last);
    last = t;
  }
  EXPECT_EQ(way.parameter(0.0), known.range.lo);
  EXPECT_EQ(way.parameter(way.length()), known.range.hi);
}

INSTANTIATE_TEST_SUITE_P(Curves, ArcLengthOf, ::testing::ValuesIn(kKnown));

// Two straight pieces of length 5 and 1 with a corner at the knot, run through at different speeds.
TEST(ArcLength, TakesAPolylineKnotByKnot) {
  const BSplineCurve<3> corner(KnotVector({0, 1, 9}, {2, 1, 2}, 1, false), {{0, 0, 0}, {3, 4, 0}, {3, 4, 1}});
  const ArcLength way(corner, {0, 9});
  EXPECT_NEAR(way.length(), 6.0, 1e-14);
  EXPECT_NEAR(way.parameter(2.5), 0.5, 1e-14);
  EXPECT_NEAR(way.parameter(5.5), 5.0, 1e-14);
}

// Coordinates a million times the length: the digits that are left are found, without end.
TEST(ArcLength, ComesToAnEndFarFromTheOrigin) {
  const Xyz far(3e6, -4e6, 5e6);
  const BSplineCurve<3> arc(KnotVector({0, 1}, {4, 4}, 3, false),
                            {far, far + Xyz(0, 1, 0), far + Xyz(1, 2, 0), far + Xyz(2, 0, 1)});
  const BSplineCurve<3> near(KnotVector({0, 1}, {4, 4}, 3, false), {{0, 0, 0}, {0, 1, 0}, {1, 2, 0}, {2, 0, 1}});
  EXPECT_NEAR(ArcLength(arc, {0, 1}).length(), ArcLength(near, {0, 1}).length(), 1e-8);
}

TEST(ArcLength, OfACurveThatIsNotANumberIsNone) {
  const Renamed nan(kCircle, {0, 1}, [](double) { return std::pair(0.0, std::numeric_limits<double>::quiet_NaN()); });
  EXPECT_TRUE(std::isnan(ArcLength(nan, {0, 1}).length()));
}

}  // namespace
}  // namespace geovor
