// Paths as a whole: their dense output and their events.
#include "geodesic/path.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "support/differences.h"
#include "support/geodesic_oracles.h"
#include "support/splines.h"
#include "surface/analytic_surfaces.h"
#include "surface/elementary_surfaces.h"
#include "surface/forms.h"
#include "surface/tangent_frame.h"

namespace geovor {
namespace {

using namespace testing;
constexpr double kPi = std::numbers::pi;
const UvBox kSquare{{-4.0, 4.0}, {-4.0, 4.0}};

std::vector<PathEvent> events_of(const GeodesicPath& path, PathEventKind kind) {
  std::vector<PathEvent> some;
  for (const PathEvent& e : path.events())
    if (e.kind == kind) some.push_back(e);
  return some;
}

// Two ways of the same sphere: in closed form, and integrated.
std::vector<SurfacePtr> unit_spheres() {
  return {std::make_shared<Sphere>(Frame{}, 1.0), std::make_shared<Ellipsoid>(1.0, 1.0, 1.0)};
}

// The promise of path.h, at places that are no ends of steps.
TEST(GeodesicPath, EveryPointIsAsExactAsTheEnd) {
  const WaveSurface wave(kSquare);
  const BSplineSurface spline = random_spline(3, 3, 8, false, 3).surface();
  std::mt19937 random(1);
  for (const Surface* surface : {static_cast<const Surface*>(&wave), static_cast<const Surface*>(&spline)}) {
    for (const double tolerance : {1e-8, 1e-12}) {
      PathOptions options;
      options.trace.tolerance = tolerance;
      options.trace.stop_at_domain = false;
      for (int i = 0; i < 40; ++i) {
        const Uv p = random_point(random, surface == &wave ? kSquare : UvBox{{2.0, 6.0}, {2.0, 6.0}});
        const UvVec d = heading(*surface, p, uniform(random, 0.0, 6.0));
        const GeodesicPath path(*surface, p, d, 2.0, options);
        ASSERT_EQ(path.result().status, TraceStatus::Converged);
        TraceOptions fine = options.trace;
        fine.tolerance = 1e-14;
        for (int k = 0; k < 5; ++k) {
          const double s = uniform(random, 0.0, 2.0);
          const TraceResult exact = trace_geodesic(*surface, p, d, s, fine);
          EXPECT_LT((path.at(s).S - surface->position(exact.end.p)).norm(), 10.0 * tolerance);
          EXPECT_LT((path.at(s).tangent - push_forward(surface->jet(exact.end.p), exact.end.d)).norm(),
                    100.0 * tolerance);
          EXPECT_NEAR(path.state(s).y, exact.end.y, 100.0 * tolerance);
        }
      }
    }
  }
}

TEST(GeodesicPath, EndsAreThoseOfTheTrace) {
  const WaveSurface wave(kSquare);
  const GeodesicPath path(wave, {0.1, 0.2}, UvVec{1.0, 0.5}, 2.0);
  const TraceResult trace = trace_geodesic(wave, {0.1, 0.2}, {1.0, 0.5}, 2.0);
  EXPECT_EQ(path.state(2.0).p, trace.end.p);
  EXPECT_EQ(path.state(5.0).p, trace.end.p);
  EXPECT_EQ(path.state(-1.0).p, (Uv{0.1, 0.2}));
  EXPECT_EQ(path.result().evaluations, trace.evaluations);
  const GeodesicPath none(wave, {0.1, 0.2}, UvVec{1.0, 0.5}, 0.0);
  EXPECT_EQ(none.state(0.0).p, (Uv{0.1, 0.2}));
  EXPECT_TRUE(none.events().empty());
  EXPECT_THROW(GeodesicPath(wave, {0.0, 0.0}, UvVec{1.0, 0.0}, -1.0), Error);
}

TEST(GeodesicPath, ConjugatePointsOfASphereLieHalfACircleApart) {
  for (const SurfacePtr& sphere : unit_spheres()) {
    const TangentFrame frame = tangent_frame(*sphere, {1.0, 0.3});
    const GeodesicPath path(*sphere, {1.0, 0.3}, frame.at_angle(0.7), 10.0);
    const auto conjugate = events_of(path, PathEventKind::ConjugatePoint);
    ASSERT_EQ(conjugate.size(), 3u);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(conjugate[k].s, (k + 1) * kPi, 1e-11);
      const double side = k % 2 == 0 ? -1.0 : 1.0;
      EXPECT_LT((sphere->position(conjugate[k].p) - side * frame.S).norm(), 1e-10);
    }
    PathOptions first;
    first.stop_at_conjugate_point = true;
    const GeodesicPath stopped(*sphere, {1.0, 0.3}, frame.at_angle(0.7), 10.0, first);
    EXPECT_EQ(stopped.result().status, TraceStatus::AtConjugatePoint);
    EXPECT_NEAR(stopped.length(), kPi, 1e-11);
    EXPECT_NEAR(stopped.result().end.y, 0.0, 1e-12);
    EXPECT_EQ(events_of(stopped, PathEventKind::ConjugatePoint).size(), 1u);
  }
}

// Along the outer equator of a torus y'' = -K y with K = 1 / (r (R + r)) constant.
TEST(GeodesicPath, ConjugatePointOnTheOuterEquatorOfATorus) {
  const Torus torus({}, 3.0, 1.0);
  const GeodesicPath path(torus, {0.2, 0.0}, UvVec{1.0, 0.0}, 13.0);
  const auto conjugate = events_of(path, PathEventKind::ConjugatePoint);
  ASSERT_EQ(conjugate.size(), 2u);
  EXPECT_NEAR(conjugate[0].s, 2.0 * kPi, 2e-11);
  EXPECT_NEAR(conjugate[1].s, 4.0 * kPi, 2e-11);
}

TEST(GeodesicPath, SeamsAreCrossedWhereTheParameterBeginsAnew) {
  for (const SurfacePtr& sphere : unit_spheres()) {
    const GeodesicPath equator(*sphere, {6.0, 0.0}, UvVec{1.0, 0.0}, 8.0);
    const auto seams = events_of(equator, PathEventKind::Seam);
    ASSERT_EQ(seams.size(), 2u);
    EXPECT_NEAR(seams[0].s, 2.0 * kPi - 6.0, 1e-12);
    EXPECT_NEAR(seams[1].s, 4.0 * kPi - 6.0, 1e-11);
    EXPECT_NEAR(seams[1].p.u, 4.0 * kPi, 1e-11);
  }
  const Cylinder cylinder({}, 2.0);
  const GeodesicPath helix(cylinder, {0.5, 0.0}, UvVec{-0.3, 0.8}, 10.0);
  ASSERT_EQ(events_of(helix, PathEventKind::Seam).size(), 1u);
  EXPECT_NEAR(events_of(helix, PathEventKind::Seam)[0].s, 0.5 / 0.3, 1e-13);
  const GeodesicPath on_spline(spline_torus(3.0, 1.0, true), {3.9, 0.1}, UvVec{1.0, 0.0}, 2.0);
  EXPECT_EQ(events_of(on_spline, PathEventKind::Seam).size(), 1u);
}

TEST(GeodesicPath, PolesArePassedAtTheirDistance) {
  for (const SurfacePtr& sphere : unit_spheres()) {
    for (const double miss : {1e-1, 1e-4, 1e-9, 1e-13}) {
      // Nearest to the pole at x = (sin(miss), 0, cos(miss)), one unit before and behind.
      const Xyz top{std::sin(miss), 0.0, std::cos(miss)};
      const Xyz S = std::cos(1.0) * top - std::sin(1.0) * Xyz::UnitY();
      const Xyz T = std::sin(1.0) * top + std::cos(1.0) * Xyz::UnitY();
      const Uv p{std::atan2(S.y(), S.x()), std::asin(S.z())};
      const GeodesicPath path(*sphere, p, T, 2.0);
      const auto poles = events_of(path, PathEventKind::Pole);
      ASSERT_EQ(poles.size(), 1u) << miss;
      EXPECT_NEAR(poles[0].s, 1.0, 1e-7);  // a minimum: known to the root of the rounding
      EXPECT_NEAR(poles[0].distance, 2.0 * std::sin(0.5 * miss), 1e-11) << miss;
      EXPECT_LT((path.at(1.3).S - std::cos(0.3) * top - std::sin(0.3) * Xyz::UnitY()).norm(), 1e-11) << miss;
    }
  }
}

// Every knot line that the ends' spans differ by is crossed once on a path that runs straight on, at that line.
TEST(GeodesicPath, KnotLinesAreCrossedInOrder) {
  const SplineData data = random_spline(3, 3, 10, false, 3);
  const BSplineSurface spline = data.surface();
  const GeodesicPath path(spline, {2.2, 5.1}, UvVec{1.0, 0.02}, 3.0);
  ASSERT_EQ(path.result().status, TraceStatus::Converged);
  const auto lines = events_of(path, PathEventKind::KnotLine);
  std::vector<double> expected;
  for (const double u : spline.knot_lines().u)
    if (u > 2.2 && u < path.result().end.p.u) expected.push_back(u);
  std::vector<double> crossed;
  for (const PathEvent& e : lines)
    if (std::find(expected.begin(), expected.end(), e.p.u) != expected.end()) crossed.push_back(e.p.u);
  EXPECT_EQ(crossed, expected);
  for (const PathEvent& e : lines) {
    EXPECT_LT(std::abs(path.state(e.s).p.u - e.p.u), 1e-12);
    EXPECT_LT(std::abs(path.state(e.s).p.v - e.p.v), 1e-12);
  }
}

// Aimed at a knot line from where they are parallel to it: paths that touch it from one side.
TEST(GeodesicPath, KnotLinesAreGrazed) {
  const BSplineSurface spline = random_spline(3, 3, 8, false, 11).surface();
  const double line = spline.knot_lines().u[3];
  int bent = 0;
  for (int i = 0; i < 40; ++i) {
    const Uv touch{line, 2.0 + 0.07 * i};
    const TraceResult back = trace_geodesic(spline, touch, {0.0, -1.0}, 0.4);
    const TraceResult on = trace_geodesic(spline, touch, {0.0, 1.0}, 0.4);
    if (std::abs(back.end.p.u - line) < 1e-3 || (back.end.p.u - line) * (on.end.p.u - line) < 0.0) continue;
    PathOptions options;
    options.trace.tolerance = 1e-12;
    const GeodesicPath path(spline, back.end.p, -back.end.d, 0.8, options);
    ++bent;
    int grazed = 0, crossed = 0;
    for (const PathEvent& e : path.events()) {
      grazed += e.kind == PathEventKind::KnotLineGrazed && std::abs(e.s - 0.4) < 1e-4;
      crossed += e.kind == PathEventKind::KnotLine && std::abs(e.p.u - line) < 1e-9;
    }
    EXPECT_EQ(grazed, 1) << i;
    EXPECT_EQ(crossed, 0) << i;
  }
  EXPECT_GT(bent, 10);
}

TEST(GeodesicPath, CreasesAndBordersAreMet) {
  const Can can(1.0);
  const GeodesicPath path(can, {0.0, 0.5}, heading(can, {0.0, 0.5}, 1.57), 1.5);
  const auto creases = events_of(path, PathEventKind::Crease);
  ASSERT_EQ(creases.size(), 1u);
  EXPECT_NEAR(creases[0].s, 0.5, 1e-6);
  EXPECT_EQ(creases[0].p.v, 1.0);
  const Paraboloid bowl({{-1.0, 1.0}, {-1.0, 1.0}});
  const GeodesicPath out(bowl, {0.0, 0.0}, UvVec{1.0, 0.0}, 10.0);
  ASSERT_EQ(out.events().size(), 1u);
  EXPECT_EQ(out.events()[0].kind, PathEventKind::Border);
  EXPECT_EQ(out.events()[0].p.u, 1.0);
  EXPECT_NEAR(out.events()[0].s, std::sqrt(5.0) / 2.0 + std::asinh(2.0) / 4.0, 1e-12);  // arc length of z = u^2
}

}  // namespace
}  // namespace geovor
