// How the error follows the tolerance and the step, what a trace costs, and what is conserved on long ways.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "geodesic/geodesic_equation.h"
#include "geodesic/trace.h"
#include "numeric/dop853.h"
#include "support/differences.h"
#include "support/geodesic_oracles.h"
#include "support/splines.h"
#include "surface/analytic_surfaces.h"
#include "surface/elementary_surfaces.h"
#include "surface/forms.h"

namespace geovor {
namespace {

using namespace testing;
const UvBox kSquare{{-4.0, 4.0}, {-4.0, 4.0}};

TraceOptions with_tolerance(double tolerance) {
  TraceOptions options;
  options.tolerance = tolerance;
  options.stop_at_domain = false;
  return options;
}

// The end, and its error against a run whose steps are several times shorter.
struct Errors {
  double largest = 0.0, mean_log = 0.0, evaluations = 0.0;
};

Errors errors(const Surface& surface, const UvBox& starts, double length, double tolerance, int count) {
  std::mt19937 random(7);
  Errors e;
  for (int i = 0; i < count; ++i) {
    const Uv p = random_point(random, starts);
    const UvVec d = heading(surface, p, uniform(random, 0.0, 6.28));
    const TraceResult path = trace_geodesic(surface, p, d, length, with_tolerance(tolerance));
    EXPECT_EQ(path.status, TraceStatus::Converged);
    const TraceResult exact = trace_geodesic(surface, p, d, length, with_tolerance(4e-15));
    const double error = gap(surface, path.end.p, exact.end.p) / length;
    e.largest = std::max(e.largest, error);
    e.mean_log += std::log10(std::max(error, 1e-16)) / count;
    e.evaluations += double(path.evaluations) / count;
  }
  return e;
}

// A bicubic with spans of 0.3 whose poles are the wave at the Greville points: a sheet of the wave's curvatures.
BSplineSurface spline_wave() {
  constexpr int kSpans = 40;
  constexpr double L = 6.0;
  std::vector<double> knots(4, -L);
  for (int i = 1; i < kSpans; ++i) knots.push_back(-L + 2.0 * L * i / kSpans);
  knots.insert(knots.end(), 4, L);
  const int n = static_cast<int>(knots.size()) - 4;
  std::vector<Xyz> poles;
  const auto greville = [&](int i) { return (knots[i + 1] + knots[i + 2] + knots[i + 3]) / 3.0; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      poles.push_back({greville(i), greville(j), std::sin(greville(i)) * std::cos(greville(j))});
  return {KnotVector::from_flat(knots, 3), KnotVector::from_flat(knots, 3), poles};
}

// 5 tolerances are promised; at 1e-13 rounding is a part of it.
TEST(TraceAccuracy, KeepsThePromiseAtTheFinestTolerance) {
  for (const double length : {0.1, 0.5, 2.0}) {
    EXPECT_LT(errors(WaveSurface(kSquare), kSquare, length, 1e-13, 1000).largest, 5e-13) << length;
    EXPECT_LT(errors(Torus({}, 3.0, 1.0), {{0.0, 6.0}, {0.0, 6.0}}, length, 1e-13, 300).largest, 5e-13) << length;
    EXPECT_LT(errors(Ellipsoid(2.0, 2.0, 1.4), {{0.0, 6.0}, {-1.4, 1.4}}, length, 1e-13, 300).largest, 5e-13) << length;
    EXPECT_LT(errors(spline_wave(), {{-3.0, 3.0}, {-3.0, 3.0}}, length, 1e-13, 300).largest, 5e-13) << length;
  }
}

TEST(TraceCost, IsThatOfASmoothSurfaceUpToALittleAcrossKnots) {
  const double bars[] = {20.0, 90.0, 340.0}, lengths[] = {0.1, 0.5, 2.0};
  for (int k = 0; k < 3; ++k) {
    const double smooth = errors(WaveSurface(kSquare), kSquare, lengths[k], 1e-13, 1000).evaluations;
    const double pieces = errors(spline_wave(), {{-3.0, 3.0}, {-3.0, 3.0}}, lengths[k], 1e-13, 300).evaluations;
    EXPECT_LE(smooth, bars[k]);
    EXPECT_LE(pieces, 1.5 * smooth) << lengths[k];
  }
}

// The mean error falls with the tolerance, tenfold for tenfold.
TEST(TraceAccuracy, ErrorFollowsTheTolerance) {
  const WaveSurface wave(kSquare);
  double before = 0.0;
  for (const double tolerance : {1e-6, 1e-8, 1e-10, 1e-12}) {
    const double now = errors(wave, kSquare, 2.0, tolerance, 200).mean_log;
    if (tolerance < 1e-6) {
      EXPECT_NEAR((before - now) / 2.0, 1.0, 0.2) << tolerance;
    }
    before = now;
  }
}

// In equal steps without control, halving them divides the error by 2^8.
TEST(TraceAccuracy, ErrorOfEqualStepsFallsAtTheEighthOrder) {
  const WaveSurface wave(kSquare);
  std::mt19937 random(8);
  const auto end = [&](const GeodesicVector& start, int steps) {
    Xyz normal;
    const auto slope = [&](const GeodesicVector& x) { return geodesic_slope(wave.jet({x[0], x[1]}), x, normal); };
    GeodesicVector x = start;
    for (int i = 0; i < steps; ++i) x = dop853::step(x, slope(x), 2.0 / steps, slope).state;
    return x;
  };
  double order = 0.0;
  constexpr int kPaths = 100;
  for (int i = 0; i < kPaths; ++i) {
    const Uv p = random_point(random, kSquare);
    const GeodesicVector x = to_vector({p, heading(wave, p, uniform(random, 0.0, 6.28)), 0.0, 1.0});
    const GeodesicVector exact = end(x, 64);
    order += std::log2((end(x, 6) - exact).norm() / (end(x, 12) - exact).norm()) / kPaths;
  }
  EXPECT_GT(order, 7.5);
  EXPECT_LT(order, 10.0);
}

// Clairaut's constant turns into the error of the direction only: no drift on a way 100 long, 25 times round.
TEST(TraceAccuracy, ClairautDoesNotDriftOnALongWay) {
  const Torus torus({}, 3.0, 1.0);
  std::mt19937 random(9);
  for (int i = 0; i < 40; ++i) {
    const Uv p{uniform(random, 0.0, 6.0), uniform(random, 0.0, 6.0)};
    const UvVec d = heading(torus, p, uniform(random, 0.0, 6.28));
    const TraceResult path = trace_geodesic(torus, p, d, 100.0, with_tolerance(1e-12));
    ASSERT_EQ(path.status, TraceStatus::Converged);
    const SurfaceJet end = torus.jet(path.end.p);
    EXPECT_NEAR(clairaut(end, path.end.d), clairaut(torus.jet(p), d), 5e-12);
    EXPECT_NEAR(push_forward(end, path.end.d).norm(), 1.0, 5e-12);
  }
}

}  // namespace
}  // namespace geovor
