// Charts of poles against closed forms in more digits and against the surfaces that they belong to.
#include "surface/pole_chart.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "support/differences.h"
#include "surface/analytic_surfaces.h"
#include "surface/bspline_curve.h"
#include "surface/elementary_curves.h"
#include "surface/elementary_surfaces.h"
#include "surface/forms.h"
#include "surface/swept_surfaces.h"
#include "surface/tangent_frame.h"

namespace geovor {
namespace {

using testing::uniform;

constexpr double kPi = std::numbers::pi;

/// In units of the chart's radius, from its border to less than one atom of a part as large as the earth.
constexpr double kDistances[] = {1.0, 1e-1, 1e-2, 1e-4, 1e-7, 1e-10, 1e-14, 1e-20, 0.0};

/// The height of the ellipsoid's cap over the tangent plane, c sqrt(1 - x^2/a^2 - y^2/b^2) - c, in long double, so that
/// eleven bits more stand against rounding.
struct CapTruth {
  long double f, fu, fv, fuu, fuv, fvv;
  CapTruth(double a, double b, double c, double x, double y) {
    const long double A = 1.0L / a / a, B = 1.0L / b / b, q = A * x * x + B * y * y, r = sqrtl(1.0L - q);
    f = -c * q / (1.0L + r);
    fu = -c * A * x / r;
    fv = -c * B * y / r;
    fuu = -c * A / r - c * A * A * x * x / (r * r * r);
    fuv = -c * A * B * x * y / (r * r * r);
    fvv = -c * B / r - c * B * B * y * y / (r * r * r);
  }
};

/// Places in a chart, in all directions and at all distances.
template <class Visit>
void for_places(const PoleChart& chart, const Visit& visit) {
  for (const double distance : kDistances)
    for (int i = 0; i < 24; ++i) {
      const double r = chart.radius() * distance, t = 2.0 * kPi * (i + 0.3) / 24;
      visit(Uv{r * std::cos(t), r * std::sin(t)});
    }
}

/// The chart's jets against the cap of an ellipsoid with semi-axes a, b, c whose pole and axes e1 = x are the chart's.
void expect_cap(const PoleChart& chart, double a, double b, double c, double bound) {
  const Frame& f = chart.frame();
  for_places(chart, [&](Uv ab) {
    const CapTruth truth(a, b, c, ab.u, ab.v);
    const SurfaceJet j = chart.jet(ab);
    const double r = std::hypot(ab.u, ab.v);
    EXPECT_NEAR((j.S - f.origin - ab.u * f.x - ab.v * f.y).dot(f.z), double(truth.f),
                bound * r * r + 4e-16 * f.origin.norm());
    EXPECT_NEAR(j.Su.dot(f.z), double(truth.fu), bound * r);
    EXPECT_NEAR(j.Sv.dot(f.z), double(truth.fv), bound * r);
    EXPECT_NEAR(j.Suu.dot(f.z), double(truth.fuu), bound) << ab.u << " " << ab.v;
    EXPECT_NEAR(j.Suv.dot(f.z), double(truth.fuv), bound);
    EXPECT_NEAR(j.Svv.dot(f.z), double(truth.fvv), bound);
  });
}

/// The same point, normal and curvatures on the surface and in its chart; parameters there and back. `bound` is
/// relative to the size of the surface.
void expect_same_surface(const Surface& surface, const PoleChart& chart, double size, double bound) {
  const Frame& f = chart.frame();
  EXPECT_NEAR(f.x.cross(f.y).dot(f.z), 1.0, 1e-15);
  for_places(chart, [&](Uv ab) {
    const double r = std::hypot(ab.u, ab.v);
    const Uv p = chart.to_base(ab);
    const SurfaceJet c = chart.jet(ab), j = surface.jet(p);
    EXPECT_LT((c.S - j.S).norm(), bound * size) << r;
    const Uv back = chart.from_base(p);
    EXPECT_LT(std::hypot(back.u - ab.u, back.v - ab.v), bound * size) << r;
    // The base's own normal and curvatures lose digits as the pole comes near.
    if (r < 1e-3 * chart.radius()) return;
    EXPECT_LT((unit_normal(c) - unit_normal(j)).norm(), 1e4 * bound);
    EXPECT_NEAR(curvatures(c).gauss * size * size, curvatures(j).gauss * size * size, 1e7 * bound);
    EXPECT_NEAR(curvatures(c).mean * size, curvatures(j).mean * size, 1e7 * bound);
    EXPECT_TRUE(chart.holds(p) || r > 0.999 * chart.radius());
  });
}

TEST(PoleChart, IsTheEllipsoidsCapInClosedForm) {
  for (const double c : {0.5, 1.0, 2.0, 8.0}) {
    const Ellipsoid surface(1.0, 0.8, c);
    ASSERT_EQ(surface.poles().size(), 2u);
    for (const auto& chart : surface.poles()) {
      expect_cap(*chart, 1.0, 0.8, c, 2e-14 * c);
      expect_same_surface(surface, *chart, 1.0 + c, 1e-15);
    }
  }
}

TEST(PoleChart, HoldsBothPolesOfASphereAnywhereInSpace) {
  Frame frame;
  frame.origin = {3.0, -7.0, 2.0};
  frame.x = Xyz(1.0, 2.0, 2.0) / 3.0;
  frame.y = Xyz(2.0, 1.0, -2.0) / 3.0;
  for (const double hand : {1.0, -1.0}) {
    frame.z = hand * frame.x.cross(frame.y);
    const Sphere surface(frame, 2.5);
    ASSERT_EQ(surface.poles().size(), 2u);
    for (const auto& chart : surface.poles()) expect_same_surface(surface, *chart, 10.0, 1e-15);
  }
}

/// A whole ellipse turned about its axis: an ellipsoid with the semi-axes a, a, c.
TEST(PoleChart, IsExactWhereAMeridianRunsThroughTheAxis) {
  const double a = 1.5, c = 0.7;
  const ConicFrame<3> conic{{5.0, 0.0, 2.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
  const RevolutionSurface surface(std::make_shared<Ellipse<3>>(conic, a, c), {5.0, 0.0, -1.0}, {0.0, 0.0, 1.0});
  ASSERT_EQ(surface.poles().size(), 4u);
  for (const auto& chart : surface.poles()) {
    expect_same_surface(surface, *chart, 5.0, 1e-15);
    const double sign = chart->jet({0.0, 0.0}).Suu.dot(chart->frame().z) < 0.0 ? 1.0 : -1.0;
    expect_cap(*chart, a, a, sign * c, 1e-13);
  }
}

/// A parabola z = r^2 / (4 f) as a polynomial Bezier arc, both ways round: h = r^2 / (4 f) exactly.
TEST(PoleChart, OfARevolvedParabolaIsTheParaboloid) {
  const std::vector<Xyz> arc{{0.0, 0.0, 3.0}, {0.5, 0.0, 3.0}, {1.0, 0.0, 3.5}};  // (t, 0, 3 + t^2 / 2)
  for (const bool reversed : {false, true}) {
    const std::vector<Xyz> poles = reversed ? std::vector<Xyz>(arc.rbegin(), arc.rend()) : arc;
    const auto meridian = std::make_shared<BSplineCurve<3>>(KnotVector({2.0, 5.0}, {3, 3}, 2), poles);
    const RevolutionSurface surface(meridian, {0.0, 0.0, 0.0}, {0.0, 0.0, 2.0});
    ASSERT_EQ(surface.poles().size(), 1u);
    const PoleChart& chart = *surface.poles().front();
    expect_same_surface(surface, chart, 3.0, 1e-15);
    for_places(chart, [&](Uv ab) {
      const SurfaceJet j = chart.jet(ab);
      EXPECT_NEAR(j.Suu.z(), 1.0, 3e-14);
      EXPECT_NEAR(j.Suv.z(), 0.0, 3e-14);
      EXPECT_NEAR(j.Svv.z(), 1.0, 3e-14);
      EXPECT_NEAR(j.Su.z(), ab.u, 3e-14 * chart.radius());
      EXPECT_NEAR(j.S.z() - 3.0, 0.5 * (ab.u * ab.u + ab.v * ab.v), 1e-15);
    });
  }
}

TEST(PoleChart, IsNotMadeForAConesTip) {
  const auto ruling = std::make_shared<BSplineCurve<3>>(KnotVector({0.0, 1.0}, {2, 2}, 1),
                                                        std::vector<Xyz>{{0.0, 0.0, 0.0}, {1.0, 0.0, 1.0}});
  EXPECT_TRUE(RevolutionSurface(ruling, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}).poles().empty());
}

TEST(PoleChart, DoesNotTakeTheOtherPoleForItsOwn) {
  const Sphere surface({}, 1.0);
  const auto& south = *surface.poles()[0];
  const auto& north = *surface.poles()[1];
  EXPECT_TRUE(south.holds({1.0, -0.5 * kPi}));
  EXPECT_TRUE(north.holds({1.0, 0.5 * kPi - 1e-9}));
  EXPECT_FALSE(north.holds({1.0, -0.5 * kPi + 1e-3}));
  EXPECT_FALSE(north.holds({1.0, 0.2}));
}

TEST(PoleChart, CopiedSurfacesFindTheirOwnPoles) {
  const Ellipsoid surface(1.0, 2.0, 3.0);
  const auto* first = &surface.poles();
  const Ellipsoid copy = surface;
  EXPECT_EQ(&surface.poles(), first);
  EXPECT_NE(&copy.poles(), first);
  EXPECT_EQ(copy.poles().size(), 2u);
  EXPECT_TRUE(Torus({}, 2.0, 1.0).poles().empty());
  EXPECT_TRUE(Cone({}, 0.0, 0.5).poles().empty());
}

/// The frame at depth t inside of the pole against that of the chart's limit: both turn by O(t).
TEST(TangentFrame, TendsToItsLimitAtAPole) {
  const Ellipsoid surface(1.0, 0.7, 0.6);
  for (const double pole : {-0.5 * kPi, 0.5 * kPi})
    for (const double u : {0.0, 0.4, 2.0, 5.5}) {
      const TangentFrame at = tangent_frame(surface, {u, pole});
      for (const double t : {1e-3, 1e-6, 1e-9, 1e-12}) {
        const TangentFrame f = tangent_frame(surface, {u, pole * (1.0 - t)});
        EXPECT_LT((f.e1 - at.e1).norm(), 2.0 * t + 4e-16);
        EXPECT_LT((f.e2 - at.e2).norm(), 4.0 * t + 4e-16);
        EXPECT_LT((f.n - at.n).norm(), 4.0 * t + 4e-16);
      }
    }
}

TEST(TangentFrame, AnglesAreThoseOfDefinition32) {
  std::mt19937 random(1);
  const WaveSurface surface({{-2.0, 2.0}, {-2.0, 2.0}});
  for (int i = 0; i < 200; ++i) {
    const Uv p = testing::random_point(random, surface.domain());
    const TangentFrame f = tangent_frame(surface, p);
    const SurfaceJet j = surface.jet(p);
    const double t = uniform(random, -kPi, kPi);
    const UvVec d = direction_at_angle(first_form(j), t);
    EXPECT_LT((f.at_angle(t) - push_forward(j, d)).norm(), 1e-14);
    EXPECT_NEAR(f.angle_of(3.0 * f.at_angle(t)), t, 1e-14);
  }
}

TEST(TangentFrame, AtTheTipOfAConeIsTheLimitAlongTheRuling) {
  const Cone surface({}, 1.0, 0.4);
  const TangentFrame tip = tangent_frame(surface, {0.7, surface.apex_v()});
  const TangentFrame above = tangent_frame(surface, {0.7, surface.apex_v() + 0.5});
  EXPECT_LT((tip.e1 - above.e1).norm() + (tip.n - above.n).norm(), 1e-15);
}

}  // namespace
}  // namespace geovor
