#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "geodesic/trace.h"
#include "support/geodesic_oracles.h"
#include "support/splines.h"
#include "surface/elementary_surfaces.h"
#include "surface/forms.h"

namespace geovor {
namespace {

using namespace testing;
constexpr double kPi = std::numbers::pi;

// The unit sphere up to the latitude `border`, and beyond it the cone that touches it there: C1, and K jumps. The
// meridian's arc length from the border is v exp(skew u), so that paths have no symmetry in u and v.
class ConedSphere final : public Surface {
 public:
  ConedSphere(double border, double skew) : border_(border), skew_(skew) {}
  SurfaceKind kind() const override { return SurfaceKind::Function; }
  UvBox domain() const override { return {{-8.0, 8.0}, {-kFar, kFar}}; }
  int continuity() const override { return 1; }
  Span span(Uv p, UvVec towards) const override {
    const bool up = p.v > 0.0 || (p.v == 0.0 && towards.v > 0.0);
    return {0, up ? 1 : 0, {domain().u, up ? Interval{0.0, kFar} : Interval{-kFar, 0.0}}};
  }
  SurfaceJet jet(Uv p) const override { return jet(p, span(p, {0.0, 0.0})); }
  SurfaceJet jet(Uv p, const Span& span) const override {
    const double e = std::exp(skew_ * p.u), m = e * p.v, mu = skew_ * m, muu = skew_ * mu, muv = skew_ * e;
    const SurfaceJet j = by_arc_length(p.u, m, span.v == 1);
    return {j.S,
            j.Su + mu * j.Sv,
            e * j.Sv,
            j.Suu + 2.0 * mu * j.Suv + mu * mu * j.Svv + muu * j.Sv,
            e * j.Suv + mu * e * j.Svv + muv * j.Sv,
            e * e * j.Svv};
  }

 private:
  SurfaceJet by_arc_length(double u, double m, bool cone) const {
    const double cb = std::cos(border_), sb = std::sin(border_), c = std::cos(border_ + m), s = std::sin(border_ + m);
    const double r = cone ? cb - m * sb : c, z = cone ? sb + m * cb : s;
    const double r1 = cone ? -sb : -s, z1 = cone ? cb : c, r2 = cone ? 0.0 : -c, z2 = cone ? 0.0 : -s;
    const Xyz out{std::cos(u), std::sin(u), 0.0}, along{-std::sin(u), std::cos(u), 0.0}, up = Xyz::UnitZ();
    return {r * out + z * up, r * along, r1 * out + z1 * up, -r * out, r1 * along, r2 * out + z2 * up};
  }

  static constexpr double kFar = 1e3;
  double border_, skew_;
};

BSplineSurface bicubic(int spans, unsigned seed) { return random_spline(3, 3, spans, false, seed).surface(); }

// The second method steps over the knots blindly, with steps so short that their error, second order at a C2 knot and
// fourth elsewhere, does not count.
TEST(TraceAcrossKnots, AgreesWithTinyStepsOnABicubic) {
  const BSplineSurface spline = bicubic(12, 3);
  std::mt19937 random(1);
  for (int i = 0; i < 4; ++i) {
    const Uv p = random_point(random, {{5.0, 7.0}, {5.0, 7.0}});
    const UvVec d = heading(spline, p, uniform(random, 0.0, 6.0));
    const TraceResult path = trace_geodesic(spline, p, d, 4.0);
    ASSERT_EQ(path.status, TraceStatus::Converged);
    const GeodesicState slow = fine_steps(spline, p, d, 4.0, 200000);
    EXPECT_LT(gap(spline, path.end.p, slow.p), 5e-11);
    EXPECT_NEAR(path.end.y, slow.y, 1e-9 * std::max(1.0, std::abs(slow.y)));
  }
}

TEST(TraceAcrossKnots, ReturnsToItsStart) {
  const BSplineSurface spline = random_spline(3, 2, 10, true, 5).surface();
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    const Uv p = random_point(random, {{4.0, 6.0}, {4.0, 6.0}});
    const TraceResult out = trace_geodesic(spline, p, heading(spline, p, uniform(random, 0.0, 6.0)), 2.5);
    ASSERT_EQ(out.status, TraceStatus::Converged);
    const TraceResult back = trace_geodesic(spline, out.end.p, -out.end.d, 2.5);
    EXPECT_LT(gap(spline, back.end.p, p), 1e-10);
    EXPECT_NEAR(back.end.y, out.end.y, 1e-9 * std::max(1.0, std::abs(out.end.y)));  // Jacobi fields are reciprocal
  }
}

TEST(TraceAcrossKnots, IsBlindToAnInsertedKnot) {
  const SplineData data = random_spline(3, 3, 4, false, 7);
  const BSplineSurface plain = data.surface(), more = insert_u_knot(insert_u_knot(data, 1.37), 2.6).surface();
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    const Uv p = random_point(random, {{1.5, 2.5}, {1.5, 2.5}});
    const UvVec d = heading(plain, p, uniform(random, 0.0, 6.0));
    EXPECT_LT(gap(plain, trace_geodesic(plain, p, d, 1.5).end.p, trace_geodesic(more, p, d, 1.5).end.p), 1e-11);
  }
}

// On this sheet, even in u - 1 about its knot line u = 1, geodesics that start along the line stay on it, and those
// that start at a small angle graze it again and again.
TEST(TraceAcrossKnots, GrazingPathsArriveAndAgreeWithTinySteps) {
  SplineData data;
  data.u_knots = {0, 0, 0, 0, 1, 2, 2, 2, 2};
  data.v_knots = {0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4};
  const double heights[] = {0.0, 0.3, 0.6, 0.3, 0.0};
  for (int i = 0; i < data.u_count(); ++i)
    for (int j = 0; j < data.v_count(); ++j) data.poles.push_back({0.5 * i, j / 1.5, heights[i] * (1.0 + 0.2 * j)});
  const BSplineSurface ridge = data.surface();
  for (const double angle : {0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, -1e-9, -1e-3}) {
    const UvVec d{angle, 1.0};
    const TraceResult path = trace_geodesic(ridge, {1.0, 0.5}, d, 2.5);
    ASSERT_EQ(path.status, TraceStatus::Converged) << angle;
    EXPECT_LT(path.steps, 400) << angle;
    const GeodesicState slow = fine_steps(ridge, {1.0, 0.5}, d, 2.5, 200000);
    EXPECT_LT(gap(ridge, path.end.p, slow.p), 1e-10) << angle;
  }
}

// Paths that touch a knot line from one side: aimed at it from where they are parallel to it.
TEST(TraceAcrossKnots, TouchingAKnotLineMakesWay) {
  const BSplineSurface spline = bicubic(8, 11);
  const double line = spline.knot_lines().u[3];
  for (int i = 0; i < 60; ++i) {
    const Uv touch{line, 2.0 + 0.07 * i};
    const TraceResult back = trace_geodesic(spline, touch, {0.0, -1.0}, 0.7);
    ASSERT_EQ(back.status, TraceStatus::Converged);
    const TraceResult path = trace_geodesic(spline, back.end.p, -back.end.d, 1.4);
    const TraceResult on = trace_geodesic(spline, touch, {0.0, 1.0}, 0.7);
    ASSERT_EQ(path.status, TraceStatus::Converged);
    EXPECT_LT(path.steps, 300);
    EXPECT_LT(gap(spline, path.end.p, on.end.p), 1e-10);
  }
}

// A sheet z(u, v) over [0, 3]^2 with these Bernstein coefficients.
SplineData bicubic_graph(const std::function<double(int, int)>& z) {
  SplineData data;
  data.u_knots = data.v_knots = {0, 0, 0, 0, 3, 3, 3, 3};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) data.poles.push_back({1.0 * i, 1.0 * j, z(i, j)});
  return data;
}

// About v = 1.5 both sheets are odd in v, but for what depends on u alone, so that geodesics along u = const have no
// curvature there: they leave the line by the third power of the way (z = q(u) + o(v)) or the fourth (z = a(u) o(v)).
TEST(TraceAcrossKnots, PathsThatLeaveAKnotLineMoreSlowlyThanAParabolaMakeWay) {
  const double odd[] = {-0.5, 0.7, -0.7, 0.5}, rise[] = {0.2, 0.5, 0.9, 1.6};
  const auto third = [&](int i, int j) { return rise[i] + odd[j]; };
  const auto fourth = [&](int i, int j) { return rise[i] * odd[j]; };
  constexpr double line = 1.25;
  for (const SplineData& data : {bicubic_graph(third), bicubic_graph(fourth)}) {
    const BSplineSurface plain = data.surface(), more = insert_u_knot(insert_u_knot(data, line), 0.8).surface();
    for (const double beside : {0.0, 1e-15, 1e-12, 1e-9, 1e-6, -1e-15, -1e-9, -1e-6}) {
      for (const double towards : {1.0, -1.0}) {
        for (const double tolerance : {1e-4, 1e-8, 1e-12}) {
          TraceOptions options;
          options.tolerance = tolerance;
          const TraceResult path = trace_geodesic(more, {line + beside, 1.5}, {0.0, towards}, 1.4, options);
          const TraceResult same = trace_geodesic(plain, {line + beside, 1.5}, {0.0, towards}, 1.4);
          ASSERT_EQ(path.status, TraceStatus::Converged) << beside << ", " << tolerance;
          EXPECT_LT(path.steps, 100) << beside << ", " << tolerance;
          EXPECT_LT(gap(plain, path.end.p, same.end.p), 10.0 * tolerance) << beside;
          EXPECT_NEAR(path.end.y, same.end.y, 10.0 * tolerance) << beside;
        }
      }
    }
  }
}

TEST(TraceAcrossKnots, StartsOnCornersOfSpans) {
  const BSplineSurface spline = bicubic(6, 13);
  for (const double u : spline.knot_lines().u)
    for (const double v : spline.knot_lines().v)
      for (int k = 0; k < 8; ++k) {
        const UvVec d{std::cos(k * kPi / 4.0), std::sin(k * kPi / 4.0)};
        TraceOptions options;
        options.stop_at_domain = false;
        const TraceResult path = trace_geodesic(spline, {u, v}, d, 0.5, options);
        ASSERT_EQ(path.status, TraceStatus::Converged);
        const TraceResult back = trace_geodesic(spline, path.end.p, -path.end.d, 0.5, options);
        EXPECT_LT(gap(spline, back.end.p, {u, v}), 1e-10);
      }
}

// Quarter arcs with double knots: the parameterization is C0 by its knots, the shape a torus.
TEST(TraceAcrossKnots, SplineTorusIsATorus) {
  const Torus torus({}, 3.0, 1.0);
  for (const bool periodic : {true, false}) {
    const BSplineSurface spline = spline_torus(3.0, 1.0, periodic);
    std::mt19937 random(4);
    for (int i = 0; i < 30; ++i) {
      const Uv p = random_point(random, {{1.2, 1.8}, {0.0, 4.0}});
      const SurfaceJet j = spline.jet(p);
      const Xyz T = push_forward(j, direction_at_angle(first_form(j), uniform(random, 0.0, 6.0)));
      const double axis = std::hypot(j.S.x(), j.S.y());
      const Uv q{std::atan2(j.S.y(), j.S.x()), std::atan2(j.S.z(), axis - 3.0)};
      TraceOptions options;
      options.stop_at_domain = false;
      const TraceResult a = trace_geodesic(spline, p, tangent_components(j, T), 3.0, options);
      const TraceResult b = trace_geodesic(torus, q, tangent_components(torus.jet(q), T), 3.0, options);
      ASSERT_EQ(a.status, TraceStatus::Converged);
      if (!periodic && (a.end.p.u < 0.0 || a.end.p.u > 4.0 || a.end.p.v < 0.0 || a.end.p.v > 4.0)) continue;
      EXPECT_LT((spline.position(a.end.p) - torus.position(b.end.p)).norm(), 1e-10);
      EXPECT_NEAR(a.end.y, b.end.y, 1e-9);
    }
  }
}

// A great circle that rises to `depth` above the line, 0.8 before its highest point, and what the Jacobi field is 1.6
// later: sine and cosine before the line, linear over the chord of the cone, turned on behind it (by symmetry the cone
// gives the path back at the same angle).
struct Dip {
  double line, depth;
  Uv start;
  UvVec direction;

  Dip(double line_, double depth_) : line(line_), depth(depth_) {
    const double top = line + depth, latitude = std::asin(std::sin(top) * std::cos(0.8));
    start = {0.0, latitude - line};
    const double east = std::cos(top) / std::cos(latitude);  // Clairaut
    direction = {east / std::cos(latitude), std::sqrt(1.0 - east * east)};
  }
  double y(double d) const {
    const double k = d > 0.0 ? std::sqrt(std::sin(d) * std::sin(2.0 * line + d)) : 0.0;
    const double a = 0.8 - std::atan2(k, std::sin(line)), chord = 2.0 * k / std::sin(line);
    const double behind = 1.6 - a - chord;
    return (std::sin(a) + chord * std::cos(a)) * std::cos(behind) + std::cos(a) * std::sin(behind);
  }
};

// The dip is as long as the root of its depth, so that an error of the place is felt in y by as much more: that much,
// and no more, is allowed; a dip within the tolerance may go unseen.
TEST(TraceAcrossKnots, DipsBeyondALineWhereTheCurvatureJumpsAreSeen) {
  for (const double line : {0.3, 0.6, 0.8, 1.1})
    for (const double tolerance : {1e-14, 1e-12, 1e-9, 1e-6})
      for (double depth = 1e-2; depth > 1e-16; depth *= 0.2) {
        const double skew = 1.5 * std::sin(std::log(depth));
        const ConedSphere surface(line, skew);
        const Dip dip(line, depth);
        const UvVec direction{dip.direction.u, dip.direction.v - skew * dip.start.v * dip.direction.u};
        TraceOptions options;
        options.tolerance = tolerance;
        const TraceResult r = trace_geodesic(surface, dip.start, direction, 1.6, options);
        ASSERT_EQ(r.status, TraceStatus::Converged);
        const double place = 5.0 * tolerance * 1.6 + 2e-15, y = dip.y(depth);
        const double conditioning = std::max(std::abs(dip.y(depth + place) - y), std::abs(dip.y(depth - place) - y));
        EXPECT_LT(std::abs(r.end.y - y), place + conditioning) << line << ' ' << tolerance << ' ' << depth;
        EXPECT_LT(r.evaluations, 2000) << line << ' ' << tolerance << ' ' << depth;
      }
}

// Along the rim of the can, on its side and with the shortest of chords over the lid: geodesic curvature 1 of the rim
// is felt at both ends of the chord, twice y over the angle in all.
TEST(TraceAcrossKnots, CreaseMetNearlyParallelGivesNumbersOrAStatus) {
  const Can can(1.0);
  for (double angle = 1e-1; angle > 1e-20; angle *= 0.1)
    for (const double before : {0.0, 0.5}) {
      const double sine = std::sin(angle), chord = 2.0 * sine;
      const TraceResult r = trace_geodesic(can, {0.0, 1.0 + before * sine}, {std::cos(angle), -sine}, 1.2);
      SCOPED_TRACE(::testing::Message() << angle << ' ' << before << ' ' << int(r.status) << ' ' << r.length);
      EXPECT_TRUE(std::isfinite(r.end.y) && std::isfinite(r.end.dy) && std::isfinite(r.end.p.u + r.end.p.v));
      // Too flat to know y behind it, but still seen to come from outside of the rim.
      if (before > 0.0 && angle < 5e-9 && angle > 5e-13) {
        EXPECT_EQ(r.status, TraceStatus::DegenerateMetric);
        EXPECT_NEAR(r.length, before, 1e-15 / angle);
      }
      if (!(angle > 5e-7)) continue;
      ASSERT_EQ(r.status, TraceStatus::Converged);
      // y' jumps by y / sin(angle), y = 2 sin(angle): at each end of the chord errors of y count once and those of the
      // angle twice, times 1 / sin(angle).
      const double allowed = 6.0 * 5.0 * TraceOptions{}.tolerance / angle;
      const double y = before > 0.0 ? chord - before : chord;
      EXPECT_NEAR(r.end.y, y - (1.2 - before - chord), allowed);
    }
}

// From the disk over the rim onto the side: the angle to the rim is kept, and the Jacobi field is the spread of
// neighbouring paths.
TEST(TraceAcrossKnots, CreaseRefractsStraightAndBendsTheJacobiField) {
  const Can can(1.0);
  const Uv p{0.0, 0.5};
  const auto end = [&](double t) { return trace_geodesic(can, p, heading(can, p, t), 1.5); };
  for (const double t : {1.3, 1.57, 1.9}) {
    const TraceResult path = end(t);
    ASSERT_EQ(path.status, TraceStatus::Converged);
    ASSERT_GT(path.end.p.v, 1.0);
    // In the plane: p = (0.5, 0), heading (sin t, cos t) as e1 is along the circle and e2 outwards.
    const double b = 0.5 * std::sin(t), run = -b + std::sqrt(b * b + 0.75);
    const double x = 0.5 + run * std::sin(t), y = run * std::cos(t);
    const double radial = x * std::sin(t) + y * std::cos(t), round = x * std::cos(t) - y * std::sin(t);
    EXPECT_NEAR(path.end.p.v, 1.0 + (1.5 - run) * radial, 1e-11);
    EXPECT_NEAR(path.end.p.u, std::atan2(y, x) + (1.5 - run) * round, 1e-11);
    const Xyz spread = central_difference([&](double a) { return can.position(end(a).end.p); }, t, 1e-3);
    EXPECT_NEAR(std::abs(path.end.y), spread.norm(), 1e-8);
  }
}

}  // namespace
}  // namespace geovor
