// Geodesics of B-splines, across many knot lines and grazing them, held against the second method in 113 bits.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "geodesic/connect.h"
#include "geodesic/trace.h"
#include "support/geodesic_oracles.h"
#include "support/quad_geodesic.h"
#include "support/splines.h"

namespace geovor {
namespace {

using namespace testing;
constexpr double kPi = std::numbers::pi;
constexpr double kBar = 1e-12;
constexpr double kAsked = 1e-14;
constexpr int kSeen = 9;
constexpr double kFinest = 4e-15;  ///< steps short enough to see every dip beyond a knot line

TraceOptions fine() {
  TraceOptions options;
  options.tolerance = kAsked;
  return options;
}

/// One rounding of the start point's parameters moves the end point by this: what no double can promise less than.
double conditioning(const QuadSurface& quad, Uv p, UvVec d, double length, const QuadEnd& truth) {
  const Float128 shift = 2.2e-16 * std::max(std::abs(p.u), std::abs(p.v));
  const QuadEnd other = quad_geodesic(quad, {Float128(p.u) + shift, Float128(p.v) - shift},
                                      {Float128(d.u), Float128(d.v)}, Float128(length));
  return static_cast<double>(norm(other.x - truth.x) + norm(other.tangent - truth.tangent) +
                             Float128(abs(other.y - truth.y)));
}

struct Case {
  const char* name;
  int degree;
  bool rational;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class SecondMethodOnSplines : public ::testing::TestWithParam<Case> {
 protected:
  static constexpr int kSpans = 10;
  SplineData data_ = random_spline(GetParam().degree, GetParam().degree, kSpans, GetParam().rational, 21);
  BSplineSurface spline_ = data_.surface();
  QuadSpline quad_{data_};
};
INSTANTIATE_TEST_SUITE_P(Splines, SecondMethodOnSplines,
                         ::testing::Values(Case{"C1", 2, false}, Case{"C1_rational", 2, true}, Case{"C2", 3, false},
                                           Case{"C2_rational", 3, true}, Case{"C4", 5, false}),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST_P(SecondMethodOnSplines, AgreesAcrossManyKnotLines) {
  std::mt19937 random(1);
  int crossed = 0;
  for (int i = 0; i < 12; ++i) {
    const Uv p = random_point(random, {{4.0, 6.0}, {4.0, 6.0}});
    const UvVec d = heading(spline_, p, uniform(random, -kPi, kPi));
    const double length = 3.0;
    const TraceResult path = trace_geodesic(spline_, p, d, length, fine());
    ASSERT_EQ(path.status, TraceStatus::Converged);
    const QuadEnd truth = quad_geodesic(quad_, p, d, Float128(length));
    crossed += truth.lines_crossed;
    const TraceErrors e = errors_of(quad_, truth, path.end);
    const double size = length * std::max(1.0, std::abs(path.end.y) / length + std::abs(path.end.dy));
    EXPECT_LT(e.place, kBar * length);
    EXPECT_LT(e.direction, kBar * std::max(1.0, size));
    EXPECT_LT(e.y, kBar * size);
  }
  EXPECT_GT(crossed, 12 * 3);
}

// Paths that run along a knot line where they are nearest to it, at distances to either side down to rounding. On a C1
// line a path that dips beyond it by delta stays there for about sqrt(delta), so that the rounding of its start is felt
// by as much more; this much, measured in 113 bits, is allowed.
TEST_P(SecondMethodOnSplines, AgreesOnPathsThatGrazeAKnotLine) {
  TraceOptions finest;
  finest.tolerance = kFinest;
  int touched = 0;
  for (const double line : {quad_.lines(0)[3], quad_.lines(0)[4]}) {
    for (int k = 3; k <= 12; ++k) {
      for (const double side : {-1.0, 1.0}) {
        const Uv near{line + side * std::pow(10.0, -k), 4.3 + 0.1 * k};
        const TraceResult back = trace_geodesic(spline_, near, {0.0, -1.0}, 0.8, finest);
        ASSERT_EQ(back.status, TraceStatus::Converged);
        const Uv p = back.end.p;
        const UvVec d = -back.end.d;
        const double length = 1.6;
        const TraceResult path = trace_geodesic(spline_, p, d, length, finest);
        ASSERT_EQ(path.status, TraceStatus::Converged);
        const QuadEnd truth = quad_geodesic(quad_, p, d, Float128(length));
        touched += truth.lines_crossed;
        const double slack = 16.0 * conditioning(quad_, p, d, length, truth);
        const TraceErrors e = errors_of(quad_, truth, path.end);
        // A dip beyond a C1 line that is less deep than 10^-kSeen may go unseen: then y lacks what the jump of the
        // curvature does to it over the dip, which is up to about sqrt(8 delta / curvature) long.
        const double dip = k > kSeen ? 4.0 * std::sqrt(std::pow(10.0, -k)) : 0.0;
        EXPECT_LT(e.place, kBar * length + slack) << line << " " << side * k;
        EXPECT_LT(e.direction, 2.0 * kBar + slack) << line << " " << side * k;
        EXPECT_LT(e.y, kBar * length + slack + dip) << line << " " << side * k;
      }
    }
  }
  EXPECT_GT(touched, 0);
}

TEST_P(SecondMethodOnSplines, AgreesWithConnections) {
  std::mt19937 random(3);
  ConnectOptions options;
  options.tolerance = kAsked;
  double length = 0.0, angle = 0.0, y = 0.0, end_direction = 0.0;
  for (int i = 0; i < 60; ++i) {
    const Uv p = random_point(random, {{4.0, 6.0}, {4.0, 6.0}});
    const double far = std::exp(uniform(random, std::log(0.05), std::log(1.5))), t = uniform(random, -kPi, kPi);
    const Uv q = trace_geodesic(spline_, p, heading(spline_, p, t), far).end.p;
    const Connection c = connect(spline_, p, q, Polar{far, t}, options);
    ASSERT_EQ(c.status, ConnectStatus::Converged);
    const QuadEnd end = quad_geodesic(quad_, p, c.start_direction, Float128(c.length));
    const QuadJet j = quad_jet(quad_, q);
    const QuadVec miss = j.S - end.x;
    const Float128 along = dot(miss, end.tangent), turn = dot(miss, end.across) / end.y;
    length = std::max(length, static_cast<double>(abs(along)) / c.length);
    angle = std::max(angle, static_cast<double>(abs(turn)));
    const QuadVec T = Float128(c.end_direction.u) * j.Su + Float128(c.end_direction.v) * j.Sv;
    end_direction = std::max(end_direction, static_cast<double>(norm(T - end.tangent - (turn * end.dy) * end.across)));
    y = std::max(y, static_cast<double>(abs(Float128(c.y) - end.y - along * end.dy)) / c.length);
  }
  constexpr double kOfConnections = 2e-13;  // y of a C1 surface turns sharply with the angle, and is as good
  EXPECT_LT(length, kOfConnections);
  EXPECT_LT(angle, kOfConnections);
  EXPECT_LT(end_direction, kOfConnections);
  EXPECT_LT(y, kOfConnections);
}

}  // namespace
}  // namespace geovor
