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
#include "surface/bspline_surface.h"
#include "surface/elementary_curves.h"
#include "surface/elementary_surfaces.h"
#include "surface/forms.h"
#include "surface/offset_surface.h"
#include "surface/reparameterize.h"
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

/// The ellipsoid with the semi-axes a, b, c as a rational biquadratic, `quarters` of a turn in u; its poles are the
/// rows v = 0 and v = last, moved by `centre`. `upper`: the half z >= 0 only.
struct SplineEllipsoid {
  double a = 1.0, b = 1.0, c = 1.0;
  int quarters = 4;
  bool upper = false, periodic = false, swapped = false;
  Xyz centre = Xyz::Zero();

  BSplineSurface surface() const {
    const double kHalf = std::numbers::sqrt2 / 2.0;
    const double around[9][3] = {{1, 0, 1},       {1, 1, kHalf}, {0, 1, 1},      {-1, 1, kHalf}, {-1, 0, 1},
                                 {-1, -1, kHalf}, {0, -1, 1},    {1, -1, kHalf}, {1, 0, 1}};
    const double up[5][3] = {{0, -1, 1}, {1, -1, kHalf}, {1, 0, 1}, {1, 1, kHalf}, {0, 1, 1}};
    std::vector<double> knots;
    std::vector<int> multiplicities;
    for (int i = 0; i <= quarters; ++i) {
      knots.push_back(i + 1.0);
      multiplicities.push_back(periodic || (i > 0 && i < quarters) ? 2 : 3);
    }
    const KnotVector u(knots, multiplicities, 2, periodic);
    const KnotVector v = upper ? KnotVector({0.25, 1.25}, {3, 3}, 2) : KnotVector({-1.0, 0.0, 1.0}, {3, 2, 3}, 2);
    const int nu = u.pole_count(), nv = v.pole_count();
    std::vector<Xyz> poles;
    std::vector<double> weights;
    auto add = [&](int i, int j) {
      const double *x = around[i], *z = up[upper ? j + 2 : j];
      poles.push_back(centre + Xyz(a * z[0] * x[0], b * z[0] * x[1], c * z[1]));
      weights.push_back(x[2] * z[2]);
    };
    if (swapped) {
      for (int j = 0; j < nv; ++j)
        for (int i = 0; i < nu; ++i) add(i, j);
      return {v, u, poles, weights};
    }
    for (int i = 0; i < nu; ++i)
      for (int j = 0; j < nv; ++j) add(i, j);
    return {u, v, poles, weights};
  }
};

/// Jets of a chart against the cap's closed form, whatever the chart's own axes are: a, b, c along x, y, z.
void expect_cap_in_space(const PoleChart& chart, const SplineEllipsoid& e, double bound, double from, double to) {
  const Frame& f = chart.frame();
  for (const double distance : kDistances)
    for (int i = 0; i < 24; ++i) {
      const double t = from + (to - from) * (i + 0.3) / 24, r = chart.radius() * distance;
      const Xyz d = r * Xyz(std::cos(t), std::sin(t), 0.0);
      const CapTruth truth(e.a, e.b, f.z.z() * (f.origin.z() > e.centre.z() ? e.c : -e.c), d.x(), d.y());
      const SurfaceJet j = chart.jet({d.dot(f.x), d.dot(f.y)});
      // The second derivatives as a form in space.
      auto second = [&](const Xyz& p, const Xyz& q) {
        const double pa = p.dot(f.x), pb = p.dot(f.y), qa = q.dot(f.x), qb = q.dot(f.y);
        return f.z.dot(pa * qa * j.Suu + (pa * qb + pb * qa) * j.Suv + pb * qb * j.Svv);
      };
      const Xyz X = Xyz::UnitX(), Y = Xyz::UnitY();
      const double slope_x = f.z.dot(f.x.x() * j.Su + f.y.x() * j.Sv),
                   slope_y = f.z.dot(f.x.y() * j.Su + f.y.y() * j.Sv);
      EXPECT_NEAR(second(X, X), double(truth.fuu), bound) << "distance " << distance << " direction " << t;
      EXPECT_NEAR(second(X, Y), double(truth.fuv), bound) << "distance " << distance << " direction " << t;
      EXPECT_NEAR(second(Y, Y), double(truth.fvv), bound) << "distance " << distance << " direction " << t;
      EXPECT_NEAR(slope_x, double(truth.fu), bound * r);
      EXPECT_NEAR(slope_y, double(truth.fv), bound * r);
    }
}

TEST(PoleChart, OfARationalSplineIsTheEllipsoidsCap) {
  for (const bool periodic : {false, true})
    for (const bool swapped : {false, true}) {
      SplineEllipsoid e{1.0, 0.8, 0.6, 4, false, periodic, swapped};
      const BSplineSurface surface = e.surface();
      ASSERT_EQ(surface.poles().size(), 2u);
      for (const auto& chart : surface.poles()) {
        expect_same_surface(surface, *chart, 2.0, 1e-15);
        expect_cap_in_space(*chart, e, 3e-14, 0.0, 2.0 * kPi);
      }
    }
}

/// An octant: the pole is a corner of the patch, with a right angle.
TEST(PoleChart, HoldsTheWedgeOfAnOctant) {
  for (const bool swapped : {false, true}) {
    SplineEllipsoid e{1.0, 0.8, 1.2, 1, true, false, swapped};
    const BSplineSurface surface = e.surface();
    ASSERT_EQ(surface.poles().size(), 1u);
    expect_cap_in_space(*surface.poles().front(), e, 3e-14, 0.0, 0.5 * kPi);
    // A little outside of the wedge the map goes on.
    expect_cap_in_space(*surface.poles().front(), e, 3e-14, -0.1, 0.0);
  }
}

/// Far from the origin coordinates are rounded more coarsely, but the surface that they describe is as smooth as ever.
TEST(PoleChart, IsSmoothFarFromTheOrigin) {
  SplineEllipsoid e{1.0, 0.8, 0.6};
  e.centre = {1000.0, 2000.0, -500.0};
  const BSplineSurface surface = e.surface();
  ASSERT_EQ(surface.poles().size(), 2u);
  for (const auto& chart : surface.poles()) expect_cap_in_space(*chart, e, 1e-11, 0.0, 2.0 * kPi);
}

/// A collapsed side with a common tangent plane, but curvatures that depend on the direction: no smooth pole.
TEST(PoleChart, IsNotMadeWhereCurvatureDependsOnTheSideItIsSeenFrom) {
  std::vector<Xyz> poles;
  std::vector<int> multiplicities{3, 3};
  for (int i = 0; i < 3; ++i) {
    const Xyz out = i == 0 ? Xyz(1.0, 0.0, 0.0) : i == 1 ? Xyz(1.0, 1.0, 0.0) : Xyz(0.0, 1.0, 0.0);
    for (int j = 0; j < 3; ++j) poles.push_back(0.5 * j * out + Xyz(0.0, 0.0, j == 2 ? 0.3 + 0.1 * i : 0.0));
  }
  const KnotVector knots({0.0, 1.0}, multiplicities, 2);
  EXPECT_TRUE(BSplineSurface(knots, knots, poles).poles().empty());
}

TEST(PoleChart, FollowsAChangeOfParameters) {
  const auto base = std::make_shared<Ellipsoid>(1.0, 0.8, 0.6);
  const Interval v = base->domain().v;
  for (const bool swap : {false, true})
    for (const double scale : {0.5, -2.0})
      for (const ParameterMapPtr& v_map :
           {moebius_map(v, 3.0), cubic_map(v, 0.7), affine_map(1.0, 1.0), affine_map(-3.0, 1.0)}) {
        const Reparameterized surface(base, affine_map(scale, 0.3), v_map, swap);
        ASSERT_EQ(surface.poles().size(), 2u);
        for (const auto& chart : surface.poles()) {
          expect_same_surface(surface, *chart, 2.0, 2e-15);
          for_places(*chart, [&](Uv ab) {
            const Uv p = chart->to_base(ab);
            const double r = std::hypot(ab.u, ab.v);
            if (r < 1e-9) return;
            const TangentFrame f = tangent_frame(surface, p);
            EXPECT_LT((f.e1 - surface.jet(p).Su.normalized()).norm(), 1e-14 / r) << r;
          });
        }
      }
}

/// An ellipsoid's cap moved by d: points S + d n, and curvatures k / (1 - d k) (do Carmo, section 3.5, exercise 11).
TEST(PoleChart, OfAnOffsetHasThePrincipalCurvaturesMoved) {
  const auto basis = std::make_shared<Ellipsoid>(1.0, 0.8, 0.6);
  for (const double d : {0.3, -0.2}) {
    const OffsetSurface surface(basis, d);
    ASSERT_EQ(surface.poles().size(), 2u);
    for (size_t i = 0; i < 2; ++i) {
      const PoleChart &chart = *surface.poles()[i], &inner = *basis->poles()[i];
      for_places(chart, [&](Uv ab) {
        const Uv p = chart.to_base(ab);
        const SurfaceJet c = chart.jet(ab), b = inner.jet(inner.from_base(p));
        EXPECT_LT((c.S - b.S - d * unit_normal(b)).norm(), 4e-16);
        EXPECT_LT((unit_normal(c) - unit_normal(b)).norm(), 1e-15);
        const Curvatures k = curvatures(c), k0 = curvatures(b);
        EXPECT_NEAR(k.k1, k0.k1 / (1.0 - d * k0.k1), 1e-13);
        EXPECT_NEAR(k.k2, k0.k2 / (1.0 - d * k0.k2), 1e-13);
        const Uv back = chart.from_base(p);
        EXPECT_LT(std::hypot(back.u - ab.u, back.v - ab.v), 4e-16);
      });
      const Xyz along = tangent_frame(surface, {0.4, 0.5 * kPi * (i == 0 ? -1 : 1)}).e1;
      const Xyz near_by = tangent_frame(surface, {0.4, (0.5 * kPi - 0.01) * (i == 0 ? -1 : 1)}).e1;
      EXPECT_LT((along - near_by).norm(), 0.05);
    }
  }
  EXPECT_TRUE(OffsetSurface(std::make_shared<Sphere>(Frame{}, 1.0), -1.0).poles().empty());
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

/// The paraboloid z = r^2 / 2 over the unit disk, biquadratic in u and quartic in the radius, with one pole of the
/// fourth row lifted by `lift`: 4 lift t^3 (1 - t) times a function of u that has creases at two knots. `gap` opens the
/// seam.
BSplineSurface creased_paraboloid(double lift, double gap) {
  const double kHalf = std::numbers::sqrt2 / 2.0;
  const double around[9][3] = {{1, 0, 1},       {1, 1, kHalf}, {0, 1, 1},      {-1, 1, kHalf}, {-1, 0, 1},
                               {-1, -1, kHalf}, {0, -1, 1},    {1, -1, kHalf}, {1, 0, 1}};
  std::vector<Xyz> poles;
  std::vector<double> weights;
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 5; ++j) {
      const double r = j / 4.0, z = j * (j - 1) / 24.0;
      poles.push_back({r * around[i][0], r * around[i][1], z + (i == 2 && j == 3 ? lift : 0.0)});
      if (i == 8 && j >= 2) poles.back().z() += gap;
      weights.push_back(around[i][2]);
    }
  return {KnotVector({0, 1, 2, 3, 4}, {3, 2, 2, 2, 3}, 2), KnotVector({0, 1}, {5, 5}, 4), poles, weights};
}

/// A path in a chart meets no knot: where creases run into the pole the disk is so small that they are not felt.
TEST(PoleChart, IsSmallWhereCreasesRunIntoThePole) {
  ASSERT_EQ(creased_paraboloid(0.0, 0.0).poles().size(), 1u);
  EXPECT_GT(creased_paraboloid(0.0, 0.0).poles().front()->radius(), 0.1);
  for (const double lift : {1e-3, 0.1}) {
    const BSplineSurface surface = creased_paraboloid(lift, 0.0);
    ASSERT_EQ(surface.poles().size(), 1u);
    const PoleChart& chart = *surface.poles().front();
    EXPECT_GT(chart.radius(), 1e-6);
    for (int i = 0; i < 200; ++i) {
      const double t = 2.0 * std::numbers::pi * i / 200, r = chart.radius();
      EXPECT_NEAR(chart.jet({r * std::cos(t), r * std::sin(t)}).S.z(), 0.5 * r * r, 1e-14);
    }
  }
}

/// The last row of poles is off the first one by what CAD files allow: the slit between them is a border.
TEST(PoleChart, IsNoneWhereTheSeamIsOpen) {
  for (const double gap : {1e-12, 1e-9, 1e-7}) {
    const BSplineSurface surface = creased_paraboloid(0.0, gap);
    EXPECT_FALSE(surface.u_period());
    EXPECT_TRUE(surface.poles().empty()) << gap;
  }
  EXPECT_TRUE(creased_paraboloid(0.0, 1e-16).u_period());
}

/// A side that is one point only within CAD's tolerance is an ordinary, short side.
TEST(PoleChart, IsNoneWhereTheSideIsAPointOnlyNearly) {
  for (const double off : {1e-13, 1e-9, 1e-7}) {
    const BSplineSurface exact = creased_paraboloid(0.0, 0.0);
    std::vector<Xyz> poles;
    std::vector<double> weights;
    for (int i = 0; i < 9; ++i)
      for (int j = 0; j < 5; ++j) {
        poles.push_back(exact.centre() + exact.pole(i, j));
        if (i == 1 && j == 0) poles.back().z() += off;
        weights.push_back(exact.weight(i, j));
      }
    const BSplineSurface surface(exact.u_knots(), exact.v_knots(), poles, weights);
    EXPECT_TRUE(surface.poles().empty()) << off;
    for (int k = 0; k <= 16; ++k) {
      const TangentFrame f = tangent_frame(surface, {0.25 * k, 0.0});
      EXPECT_TRUE(f.S.allFinite());
    }
  }
}

}  // namespace
}  // namespace geovor
