// Paths over, past, from and into poles, on spheres that know their poles in different ways, against great circles.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "geodesic/integrator.h"
#include "support/differences.h"
#include "support/geodesic_oracles.h"
#include "surface/analytic_surfaces.h"
#include "surface/bspline_surface.h"
#include "surface/elementary_curves.h"
#include "surface/pole_chart.h"
#include "surface/swept_surfaces.h"
#include "surface/tangent_frame.h"

namespace geovor {
namespace {

using namespace testing;
constexpr double kPi = std::numbers::pi;
constexpr double kMisses[] = {1e-1, 1e-2, 1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13, 1e-15, 0.0};

// The unit sphere as a rational biquadratic of quarter arcs, poles at v = 0 and v = 2; `quarters` of a turn in u.
SurfacePtr spline_sphere(int quarters, bool periodic) {
  const double kHalf = std::numbers::sqrt2 / 2.0;
  const double around[9][3] = {{1, 0, 1},       {1, 1, kHalf}, {0, 1, 1},      {-1, 1, kHalf}, {-1, 0, 1},
                               {-1, -1, kHalf}, {0, -1, 1},    {1, -1, kHalf}, {1, 0, 1}};
  const double up[5][3] = {{0, -1, 1}, {1, -1, kHalf}, {1, 0, 1}, {1, 1, kHalf}, {0, 1, 1}};
  std::vector<double> knots;
  std::vector<int> multiplicities;
  for (int i = 0; i <= quarters; ++i) {
    knots.push_back(i);
    multiplicities.push_back(periodic || (i > 0 && i < quarters) ? 2 : 3);
  }
  const KnotVector u(knots, multiplicities, 2, periodic), v({0.0, 1.0, 2.0}, {3, 2, 3}, 2);
  std::vector<Xyz> poles;
  std::vector<double> weights;
  for (int i = 0; i < u.pole_count(); ++i)
    for (const auto& z : up) {
      poles.push_back({z[0] * around[i][0], z[0] * around[i][1], z[1]});
      weights.push_back(around[i][2] * z[2]);
    }
  return std::make_shared<BSplineSurface>(u, v, poles, weights);
}

SurfacePtr revolved_sphere() {
  const ConicFrame<3> circle{Xyz::Zero(), Xyz::UnitX(), Xyz::UnitZ()};
  return std::make_shared<RevolutionSurface>(std::make_shared<Circle<3>>(circle, 1.0), Xyz::Zero(), Xyz::UnitZ());
}

struct Ball {
  const char* name;
  SurfacePtr surface;
  Uv low, high;  // corners of a region of starts in the northern temperate zone
};

const std::vector<Ball>& balls() {
  static const std::vector<Ball> all{
      {"function", std::make_shared<Ellipsoid>(1.0, 1.0, 1.0), {0.0, 0.4}, {6.2, 1.2}},
      {"revolution", revolved_sphere(), {0.0, 0.4}, {6.2, 1.2}},
      {"spline", spline_sphere(4, true), {0.0, 1.3}, {4.0, 1.8}},
      {"spline closed by its end rows", spline_sphere(4, false), {0.0, 1.3}, {4.0, 1.8}},
  };
  return all;
}

// The unit tangent at S of the great circle that passes the north pole at the angle `miss`, on its left for miss > 0.
Xyz past_the_pole(const Xyz& S, double miss) {
  const Xyz a = (Xyz::UnitZ() - S.z() * S).normalized();
  const double k = std::sin(miss) / a.z();
  return (k * a + std::sqrt(1.0 - k * k) * S.cross(a)).cross(S);
}

TEST(PolePassage, FollowsGreatCirclesAtAnyDistanceFromThePole) {
  for (const Ball& ball : balls()) {
    ASSERT_FALSE(ball.surface->poles().empty());
    std::mt19937 random(1);
    for (const double miss : kMisses)
      for (int i = 0; i < 20; ++i) {
        const Uv p = random_point(random, {{ball.low.u, ball.high.u}, {ball.low.v, ball.high.v}});
        const Xyz S = ball.surface->position(p);
        const Xyz T = past_the_pole(S, i % 2 == 0 ? miss : -miss);
        const double s = uniform(random, 0.2, 2.2);
        GeodesicIntegrator path(*ball.surface, p, T, s, {});
        ASSERT_EQ(path.advance(s), TraceStatus::Converged) << ball.name << miss;
        const SpaceState end = path.at();
        EXPECT_LT((end.S - std::cos(s) * S - std::sin(s) * T).norm(), 5e-12 * (1.0 + s)) << ball.name << miss;
        EXPECT_LT((end.tangent + std::sin(s) * S - std::cos(s) * T).norm(), 5e-12 * (1.0 + s)) << ball.name << miss;
        EXPECT_LT((ball.surface->position(end.p) - end.S).norm(), 1e-14) << ball.name << miss;
        EXPECT_NEAR(end.y, std::sin(s), 5e-12 * (1.0 + s));
        EXPECT_NEAR(end.dy, std::cos(s), 1e-11 * (1.0 + s));
        EXPECT_LT(path.evaluations(), 1000) << ball.name << miss;
      }
  }
}

// u turns by less than half a turn before the pole and after it, to the side on which the path passes.
TEST(PolePassage, RunsOnOverTheSeam) {
  const Ellipsoid sphere(1.0, 1.0, 1.0);
  std::mt19937 random(2);
  for (const double miss : kMisses) {
    if (miss == 0.0) continue;  // either way is right
    for (const double side : {1.0, -1.0}) {
      const Uv p{uniform(random, -6.0, 6.0), uniform(random, 0.6, 1.2)};
      const Xyz S = sphere.position(p), T = past_the_pole(S, side * miss);
      GeodesicIntegrator path(sphere, p, T, 2.0, {});
      ASSERT_EQ(path.advance(2.0), TraceStatus::Converged);
      const Xyz end = path.at().S;
      double swept = std::atan2(S.x() * end.y() - S.y() * end.x(), S.x() * end.x() + S.y() * end.y());
      if (swept * side < 0.0) swept += 2.0 * kPi * side;
      EXPECT_NEAR(path.state().p.u - p.u, swept, 1e-10) << miss << side;
    }
  }
}

TEST(PolePassage, StartsAndEndsAtThePoleItself) {
  for (const Ball& ball : balls()) {
    for (const auto& chart : ball.surface->poles()) {
      for (int i = 0; i < 12; ++i) {
        const Uv pole = chart->side().point(0.1 + 0.3 * i, 0.0);
        const TangentFrame frame = tangent_frame(*ball.surface, pole);
        const Xyz T = frame.at_angle(0.5 * i);
        GeodesicIntegrator out(*ball.surface, pole, T, 1.0, {});
        ASSERT_EQ(out.advance(1.0), TraceStatus::Converged) << ball.name;
        const SpaceState there = out.at();
        EXPECT_LT((there.S - std::cos(1.0) * chart->pole() - std::sin(1.0) * T).norm(), 5e-12) << ball.name;
        GeodesicIntegrator back(*ball.surface, there.p, Xyz(-there.tangent), 1.0, {});
        ASSERT_EQ(back.advance(1.0), TraceStatus::Converged) << ball.name;
        EXPECT_LT((back.at().S - chart->pole()).norm(), 5e-12) << ball.name;
        EXPECT_TRUE(is_finite(back.state().p) && is_finite(back.state().d)) << ball.name;
      }
    }
  }
}

// An octant has its pole at a corner: paths end where they leave it, on whichever side.
TEST(PolePassage, StopsAtTheSidesOfAnOctant) {
  const SurfacePtr octant = spline_sphere(1, false);
  ASSERT_FALSE(octant->poles().empty());
  for (const double miss : {0.2, 1e-2, 1e-5, 1e-9}) {
    const Uv p{0.4, 1.6};
    const Xyz S = octant->position(p), T = past_the_pole(S, miss);
    GeodesicIntegrator path(*octant, p, T, 2.0, {});
    ASSERT_EQ(path.advance(2.0), TraceStatus::LeftDomain) << miss;
    // Counterclockwise the circle leaves through the plane x = 0.
    const double s = std::atan2(-S.x(), T.x()) < 0.0 ? std::atan2(-S.x(), T.x()) + kPi : std::atan2(-S.x(), T.x());
    EXPECT_NEAR(path.covered(), s, 1e-11) << miss;
    EXPECT_LT((path.at().S - std::cos(s) * S - std::sin(s) * T).norm(), 1e-11) << miss;
  }
}

}  // namespace
}  // namespace geovor
