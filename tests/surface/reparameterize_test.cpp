#include "surface/reparameterize.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/differences.h"
#include "support/splines.h"
#include "surface/analytic_surfaces.h"
#include "surface/elementary_surfaces.h"
#include "surface/forms.h"

namespace geovor {
namespace {

using testing::random_point;
using testing::worst_derivative_error;

struct Case {
  const char* name;
  ParameterMapPtr u, v;
  bool swap;
};

std::vector<Case> cases(const UvBox& box) {
  return {{"swapped", nullptr, nullptr, true},
          {"u reversed", affine_map(-1.0, box.u.lo + box.u.hi), nullptr, false},
          {"scaled", affine_map(3.0, 0.5), affine_map(-0.1, 2.0), false},
          {"Moebius", moebius_map(box.u, 0.3), moebius_map(box.v, 2.5), false},
          {"cubic", cubic_map(box.u, 1.2), cubic_map(box.v, -0.6), false},
          {"all at once", moebius_map(box.u, 3.0), cubic_map(box.v, 0.8), true}};
}

TEST(ParameterMap, InverseUndoesTheMap) {
  const Interval range{-3.0, 5.0};
  for (const ParameterMapPtr& map : {affine_map(-2.0, 1.0), moebius_map(range, 0.2), moebius_map(range, 5.0),
                                     cubic_map(range, 1.9), cubic_map(range, -0.9)}) {
    for (double t = 0.0; t <= 1.0; t += 0.0625) EXPECT_NEAR(map->inverse(map->jet(t).x), t, 1e-13);
  }
  EXPECT_EQ(moebius_map(range, 0.2)->jet(0.0).x, -3.0);
  EXPECT_EQ(moebius_map(range, 0.2)->jet(1.0).x, 5.0);
  EXPECT_EQ(cubic_map(range, 1.2)->jet(1.0).x, 5.0);
}

TEST(Reparameterized, HasDerivativesThatMatchDifferences) {
  const auto spline = std::make_shared<BSplineSurface>(testing::random_spline(3, 3, 4, true, 3).surface());
  for (const Case& c : cases(spline->domain())) {
    const Reparameterized s(spline, c.u, c.v, c.swap);
    EXPECT_LT(worst_derivative_error(s, s.domain(), 1e-4, 100), 1e-6) << c.name;
  }
}

TEST(Reparameterized, ChangesNoPointAndNoCurvature) {
  const auto spline = std::make_shared<BSplineSurface>(testing::random_spline(3, 3, 4, false, 4).surface());
  std::mt19937 random(1);
  for (const Case& c : cases(spline->domain())) {
    const Reparameterized s(spline, c.u, c.v, c.swap);
    for (int i = 0; i < 50; ++i) {
      const Uv p = random_point(random, spline->domain());
      const Uv q = s.from_base(p);
      EXPECT_TRUE(s.domain().contains(q)) << c.name;
      EXPECT_NEAR((s.position(q) - spline->position(p)).norm(), 0.0, 1e-12) << c.name;
      const Curvatures a = curvatures(spline->jet(p)), b = curvatures(s.jet(q));
      EXPECT_NEAR(a.gauss, b.gauss, 1e-9 * (1 + a.largest() * a.largest())) << c.name;
      EXPECT_NEAR(a.largest(), b.largest(), 1e-9 * (1 + a.largest())) << c.name;
    }
  }
}

TEST(Reparameterized, PassesOnThePieces) {
  const auto spline = std::make_shared<BSplineSurface>(testing::random_spline(3, 3, 4, false, 5).surface());
  std::mt19937 random(2);
  for (const Case& c : cases(spline->domain())) {
    const Reparameterized s(spline, c.u, c.v, c.swap);
    for (int i = 0; i < 50; ++i) {
      const Uv q = random_point(random, s.domain());
      const Span span = s.span(q, {1, 1});
      EXPECT_TRUE(span.box.contains(q)) << c.name;
      EXPECT_LT(testing::distance(s.jet(q, span), s.jet(q)), 1e-12) << c.name;
      // Just beyond the border lies another piece, unless there is no border.
      if (std::isfinite(span.box.u.hi)) {
        const Span next = s.span({span.box.u.hi, q.v}, {1, 0});
        EXPECT_TRUE(next.u != span.u || next.v != span.v) << c.name;
      }
    }
  }
}

TEST(Reparameterized, KeepsPeriodsUnderAffineMapsOnly) {
  const auto torus = std::make_shared<Torus>(Frame{}, 3.0, 1.0);
  const Reparameterized scaled(torus, affine_map(-2.0, 0.0), nullptr, true);
  EXPECT_EQ(scaled.v_period(), *torus->u_period() / 2.0);
  EXPECT_EQ(scaled.u_period(), *torus->v_period());
  EXPECT_FALSE(Reparameterized(torus, cubic_map(torus->domain().u, 0.5), nullptr).u_period().has_value());

  const auto spline = std::make_shared<BSplineSurface>(testing::spline_torus(3.0, 1.0, true));
  const Reparameterized turned(spline, affine_map(-0.5, 0.25), nullptr);
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) {
    const Uv q = random_point(random, {{-30, 30}, {-9, 9}});
    const Span span = turned.span(q, {1, 1});
    EXPECT_TRUE(span.box.contains(q));
    EXPECT_LT(testing::distance(turned.jet(q, span), turned.jet(q)), 1e-11);
  }
}

}  // namespace
}  // namespace geovor
