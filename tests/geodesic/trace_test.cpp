#include "geodesic/trace.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "geodesic/offset.h"
#include "support/differences.h"
#include "support/geodesic_oracles.h"
#include "surface/analytic_surfaces.h"
#include "surface/elementary_surfaces.h"
#include "surface/forms.h"
#include "surface/reparameterize.h"

namespace geovor {
namespace {

using namespace testing;
constexpr double kPi = std::numbers::pi;
const UvBox kSquare{{-4.0, 4.0}, {-4.0, 4.0}};

// A sphere to the integrator, not to the closed forms.
std::shared_ptr<const Surface> function_sphere(double R) { return std::make_shared<Ellipsoid>(R, R, R); }

TEST(TraceGeodesic, FollowsGreatCirclesOnSphere) {
  std::mt19937 random(1);
  for (const double R : {1e-3, 1.0, 1e6}) {
    const auto sphere = function_sphere(R);
    for (int i = 0; i < 50; ++i) {
      const Uv p{uniform(random, 0.0, 6.0), uniform(random, -0.5, 0.5)};
      const UvVec d = heading(*sphere, p, uniform(random, -0.5, 0.5));
      const double s = R * uniform(random, 0.1, 6.0);
      const TraceResult path = trace_geodesic(*sphere, p, d, s);
      ASSERT_EQ(path.status, TraceStatus::Converged);
      const SurfaceJet j = sphere->jet(p);
      const Xyz end = std::cos(s / R) * j.S + R * std::sin(s / R) * push_forward(j, d);
      EXPECT_LT((sphere->position(path.end.p) - end).norm(), 2e-12 * s);
      EXPECT_NEAR(path.end.y, R * std::sin(s / R), 2e-12 * s);
      EXPECT_NEAR(path.end.dy, std::cos(s / R), 1e-11);
    }
  }
}

TEST(TraceGeodesic, ClosedFormOfSphereAgreesWithTheIntegrator) {
  const Frame frame{{1.0, 2.0, 3.0}, Xyz::UnitY(), Xyz::UnitZ(), Xyz::UnitX()};
  const auto closed = std::make_shared<Sphere>(frame, 2.0);
  const Reparameterized open(closed, affine_map(1.0, 0.0), nullptr);
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    const Uv p{uniform(random, -6.0, 6.0), uniform(random, -0.6, 0.6)};
    const UvVec d = heading(*closed, p, uniform(random, -0.5, 0.5) + (i % 2) * kPi);
    const double s = uniform(random, 0.0, 25.0);
    const TraceResult a = trace_geodesic(*closed, p, d, s), b = trace_geodesic(open, p, d, s);
    EXPECT_NEAR(a.end.p.u, b.end.p.u, 1e-10);
    EXPECT_NEAR(a.end.p.v, b.end.p.v, 1e-10);
    EXPECT_NEAR(a.end.d.u, b.end.d.u, 1e-10);
    EXPECT_NEAR(a.end.d.v, b.end.d.v, 1e-10);
    EXPECT_NEAR(a.end.y, b.end.y, 1e-10);
    EXPECT_NEAR(a.end.dy, b.end.dy, 1e-10);
  }
}

TEST(TraceGeodesic, RunsOverThePoleOfASphere) {
  const Sphere sphere({}, 2.0);
  const TraceResult path = trace_geodesic(sphere, {0.3, 1.0}, {0.0, 1.0}, 2.0 * (kPi - 2.0));
  EXPECT_EQ(path.status, TraceStatus::Converged);
  EXPECT_LT(gap(sphere, path.end.p, {0.3 + kPi, 1.0}), 1e-14);
  EXPECT_NEAR(path.end.d.v, -0.5, 1e-14);
}

TEST(TraceGeodesic, IsStraightOnPlaneAndHelixOnCylinder) {
  const Cylinder cylinder({}, 2.0);
  const TraceResult helix = trace_geodesic(cylinder, {1.0, 1.0}, {0.15, 0.4}, 10.0);
  EXPECT_NEAR(helix.end.p.u, 1.0 + 0.3 * 10.0, 1e-14);
  EXPECT_NEAR(helix.end.p.v, 1.0 + 0.8 * 10.0, 1e-14);
  EXPECT_EQ(helix.end.y, 10.0);
  const Plane plane(Frame{});
  EXPECT_NEAR(trace_geodesic(plane, {0.0, 0.0}, {3.0, 4.0}, 5.0).end.p.v, 4.0, 1e-14);
}

// The integrator on the developable cone: its distance to the apex and the angle swept are those of the straight line
// in the development.
TEST(TraceGeodesic, IsStraightInTheDevelopmentOfACone) {
  const double a = 0.4, R = 1.5;
  const Cone cone({}, R, a);
  const Uv p{0.2, 0.7};
  const double t = 2.0, s = 4.0;
  const TraceResult path = trace_geodesic(cone, p, heading(cone, p, t), s);
  ASSERT_EQ(path.status, TraceStatus::Converged);
  const double rho = p.v - cone.apex_v();
  const double x = rho + s * std::sin(t), y = s * std::cos(t);
  EXPECT_NEAR(path.end.p.v - cone.apex_v(), std::hypot(x, y), 1e-11);
  EXPECT_NEAR(path.end.p.u - p.u, std::atan2(y, x) / std::sin(a), 1e-11);
  EXPECT_NEAR(path.end.y, s, 1e-11);
}

template <class SurfaceType>
void expect_clairaut(const SurfaceType& surface, Interval v) {
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    const Uv p{uniform(random, 0.0, 6.0), uniform(random, v.lo, v.hi)};
    const UvVec d = heading(surface, p, uniform(random, 0.0, 6.0));
    const TraceResult path = trace_geodesic(surface, p, d, 5.0);
    ASSERT_EQ(path.status, TraceStatus::Converged);
    const SurfaceJet end = surface.jet(path.end.p);
    EXPECT_NEAR(clairaut(end, path.end.d), clairaut(surface.jet(p), d), 2e-11);
    EXPECT_NEAR(push_forward(end, path.end.d).norm(), 1.0, 1e-11);
  }
}

TEST(TraceGeodesic, KeepsClairautConstantOnTorus) { expect_clairaut(Torus({}, 3.0, 1.0), {0.0, 6.0}); }
TEST(TraceGeodesic, KeepsClairautConstantOnVase) { expect_clairaut(WavyVase(), {-1.0, 1.0}); }

TEST(TraceGeodesic, AgreesWithASlowIntegratorOnWave) {
  const WaveSurface wave(kSquare);
  std::mt19937 random(4);
  for (int i = 0; i < 20; ++i) {
    const Uv p = random_point(random, {{-1.0, 1.0}, {-1.0, 1.0}});
    const UvVec d = heading(wave, p, uniform(random, 0.0, 6.0));
    const TraceResult path = trace_geodesic(wave, p, d, 2.0);
    const GeodesicState slow = fine_steps(wave, p, d, 2.0, 4000);
    EXPECT_LT(gap(wave, path.end.p, slow.p), 5e-12);
    EXPECT_NEAR(path.end.y, slow.y, 1e-11);
    EXPECT_NEAR(path.end.dy, slow.dy, 1e-11);
  }
}

// The promise of trace.h, at tolerances from loose to tight and lengths from a fraction of a curvature radius on.
TEST(TraceGeodesic, ErrorStaysBelowTheTolerance) {
  const WaveSurface wave(kSquare);
  std::mt19937 random(5);
  TraceOptions exact;
  exact.tolerance = 1e-15;
  exact.stop_at_domain = false;
  for (const double length : {0.1, 0.5, 2.0}) {
    for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
      double worst = 0.0;
      for (int i = 0; i < 100; ++i) {
        const Uv p = random_point(random, kSquare);
        const UvVec d = heading(wave, p, uniform(random, 0.0, 6.0));
        TraceOptions options = exact;
        options.tolerance = tolerance;
        const Uv a = trace_geodesic(wave, p, d, length, options).end.p;
        worst = std::max(worst, gap(wave, a, trace_geodesic(wave, p, d, length, exact).end.p) / length);
      }
      EXPECT_LT(worst, 5.0 * tolerance) << length;
      EXPECT_GT(worst, 0.0);
    }
  }
}

TEST(TraceGeodesic, NeedsFewEvaluations) {
  const WaveSurface wave(kSquare);
  std::mt19937 random(6);
  TraceOptions options;
  options.tolerance = 1e-13;
  options.stop_at_domain = false;
  const double lengths[] = {0.1, 0.5, 2.0};
  const double budget[] = {20.0, 90.0, 340.0};
  for (int k = 0; k < 3; ++k) {
    double evaluations = 0.0;
    for (int i = 0; i < 200; ++i) {
      const Uv p = random_point(random, kSquare);
      evaluations +=
          trace_geodesic(wave, p, heading(wave, p, uniform(random, 0.0, 6.0)), lengths[k], options).evaluations / 200.0;
    }
    EXPECT_LT(evaluations, budget[k]) << lengths[k];
  }
}

TEST(TraceGeodesic, IsBlindToParameterization) {
  const auto wave = std::make_shared<WaveSurface>(kSquare);
  const auto moebius =
      std::make_shared<Reparameterized>(wave, moebius_map(kSquare.u, 3.0), moebius_map(kSquare.v, 0.5));
  const auto swapped =
      std::make_shared<Reparameterized>(moebius, cubic_map({0.0, 1.0}, 0.6), affine_map(1e-3, 0.2), true);
  std::mt19937 random(7);
  for (int i = 0; i < 30; ++i) {
    const Uv p = random_point(random, {{-1.0, 1.0}, {-1.0, 1.0}});
    const UvVec d = heading(*wave, p, uniform(random, 0.0, 6.0));
    const TraceResult plain = trace_geodesic(*wave, p, d, 1.5);
    const Uv q = swapped->from_base(moebius->from_base(p));
    const UvVec e = tangent_components(swapped->jet(q), push_forward(wave->jet(p), d));
    const TraceResult other = trace_geodesic(*swapped, q, e, 1.5);
    ASSERT_EQ(other.status, TraceStatus::Converged);
    EXPECT_LT((swapped->position(other.end.p) - wave->position(plain.end.p)).norm(), 1e-11);
    EXPECT_NEAR(other.end.y, plain.end.y, 1e-10);
  }
}

TEST(TraceGeodesic, StopsOnTheBorderOfTheDomain) {
  const Paraboloid bowl({{-1.0, 1.0}, {-1.0, 1.0}});
  const TraceResult out = trace_geodesic(bowl, {0.0, 0.0}, {1.0, 0.0}, 10.0);
  EXPECT_EQ(out.status, TraceStatus::LeftDomain);
  EXPECT_EQ(out.end.p.u, 1.0);
  EXPECT_NEAR(out.length, std::sqrt(5.0) / 2.0 + std::asinh(2.0) / 4.0, 1e-12);  // arc length of z = u^2
  const TraceResult at_once = trace_geodesic(bowl, {1.0, 0.0}, {1.0, 0.0}, 10.0);
  EXPECT_EQ(at_once.status, TraceStatus::LeftDomain);
  EXPECT_EQ(at_once.length, 0.0);
  TraceOptions on;
  on.stop_at_domain = false;
  EXPECT_EQ(trace_geodesic(bowl, {1.0, 0.0}, {1.0, 0.0}, 10.0, on).status, TraceStatus::Converged);
}

TEST(TraceGeodesic, StopsWhereTheMetricVanishes) {
  const Ellipsoid ellipsoid(1.0, 1.0, 0.8);
  const Cone cone({}, 1.0, 0.5);
  const TraceResult into = trace_geodesic(cone, {0.0, 0.0}, {0.0, -1.0}, 3.0);
  EXPECT_EQ(into.status, TraceStatus::DegenerateMetric);
  EXPECT_NEAR(into.length, -cone.apex_v(), 1e-9);
  EXPECT_EQ(trace_geodesic(ellipsoid, {0.0, 0.0}, {0.0, 0.0}, 1.0).status, TraceStatus::DegenerateMetric);
}

TEST(TraceGeodesic, CountsItsSteps) {
  TraceOptions options;
  options.max_steps = 3;
  const TraceResult path = trace_geodesic(WaveSurface(kSquare), {0.0, 0.0}, {1.0, 0.3}, 3.0, options);
  EXPECT_EQ(path.status, TraceStatus::StepLimit);
  EXPECT_EQ(path.steps, 3);
  EXPECT_LT(path.length, 3.0);
}

TEST(TraceGeodesic, RefusesANegativeLength) {
  EXPECT_THROW(trace_geodesic(Plane(Frame{}), {0.0, 0.0}, {1.0, 0.0}, -1.0), Error);
  EXPECT_THROW(trace_geodesic(Plane(Frame{}), {0.0, 0.0}, {1.0, 0.0}, std::nan("")), Error);
}

TEST(SampleGeodesic, PointsLieOnTheTracedGeodesic) {
  const WaveSurface wave(kSquare);
  const auto samples = sample_geodesic(wave, {0.1, 0.2}, {1.0, 0.5}, 2.0, 8);
  ASSERT_EQ(samples.size(), 9u);
  for (int i = 0; i <= 8; ++i) {
    const TraceResult path = trace_geodesic(wave, {0.1, 0.2}, {1.0, 0.5}, 0.25 * i);
    EXPECT_LT(gap(wave, samples[i].p, path.end.p), 1e-11);
    EXPECT_NEAR(samples[i].y, path.end.y, 1e-11);
  }
  EXPECT_LT(sample_geodesic(wave, {3.0, 0.0}, {1.0, 0.0}, 4.0, 8).size(), 9u);
}

TEST(Offset, DerivativesAreThoseOfDifferences) {
  const WaveSurface wave(kSquare);
  const Uv p{0.3, -0.2};
  const double s = 1.3, t = 0.8, h = 1e-3;
  const OffsetJet jet = offset(wave, p, s, t);
  const auto at = [&](double s1, double t1) {
    const Uv q = offset(wave, p, s1, t1).uv;
    return Eigen::Vector2d(q.u, q.v);
  };
  const Eigen::Vector2d ds = central_difference([&](double x) { return at(x, t); }, s, h);
  const Eigen::Vector2d dt = central_difference([&](double x) { return at(s, x); }, t, h);
  EXPECT_LT((ds - Eigen::Vector2d(jet.ds.u, jet.ds.v)).norm(), 1e-9);
  EXPECT_LT((dt - Eigen::Vector2d(jet.dt.u, jet.dt.v)).norm(), 1e-9);
  EXPECT_NEAR(push_forward(wave.jet(jet.uv), jet.dt).norm(), std::abs(jet.y), 1e-12);
}

}  // namespace
}  // namespace geovor
