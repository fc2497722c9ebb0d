// Geodesics of smooth surfaces held against a second method of other make in 113 bits (support/quad_geodesic.h).
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "geodesic/connect.h"
#include "geodesic/distance.h"
#include "geodesic/trace.h"
#include "support/differences.h"
#include "support/geodesic_oracles.h"
#include "support/quad_geodesic.h"
#include "surface/analytic_surfaces.h"
#include "surface/elementary_surfaces.h"

namespace geovor {
namespace {

using namespace testing;
constexpr double kPi = std::numbers::pi;

/// Of the length of the path. The integrator shares its tolerance out over the path; 1e-14 is what is asked here so
/// that 1e-13 is kept where neighbouring paths spread.
constexpr double kBar = 1e-13;
constexpr double kAsked = 1e-14;

struct Pair {
  const char* name;
  std::shared_ptr<const Surface> surface;
  std::shared_ptr<const QuadSurface> quad;
  UvBox box;    ///< of starts
  double size;  ///< of a curvature radius
};
void PrintTo(const Pair& pair, std::ostream* out) { *out << pair.name; }

const UvBox kWide{{-50.0, 50.0}, {-50.0, 50.0}};
const UvBox kTurns{{0.0, 2.0 * kPi}, {-1.4, 1.4}};
const Pair kPairs[] = {
    {"wave", std::make_shared<WaveSurface>(kWide), std::make_shared<QuadWave>(), {{-3, 3}, {-3, 3}}, 1.0},
    {"oblate", std::make_shared<Ellipsoid>(1.0, 1.0, 0.5), std::make_shared<QuadEllipsoid>(1.0, 1.0, 0.5), kTurns, 0.5},
    {"triaxial", std::make_shared<Ellipsoid>(3.0, 2.0, 1.0), std::make_shared<QuadEllipsoid>(3.0, 2.0, 1.0), kTurns,
     1.0},
    {"torus", std::make_shared<Torus>(Frame{}, 3.0, 1.0), std::make_shared<QuadTorus>(3.0, 1.0), kTurns, 1.0},
    {"bump",
     std::make_shared<GaussianBumps>(std::vector<GaussianBumps::Bump>{{{0.0, 0.0}, 1.5, 0.5}}, kWide),
     std::make_shared<QuadBump>(1.5, 0.5),
     {{-1, 1}, {-1, 1}},
     0.5},
};

class SecondMethod : public ::testing::TestWithParam<Pair> {};
INSTANTIATE_TEST_SUITE_P(Surfaces, SecondMethod, ::testing::ValuesIn(kPairs),
                         [](const auto& instance) { return std::string(instance.param.name); });

// An error of the start grows on the way as the Jacobi field says; what the rounding of the start alone would cost is
// not the integrator's.
double growth(const QuadEnd& truth, double length) {
  return std::max(1.0, std::abs(static_cast<double>(truth.y)) / length + std::abs(static_cast<double>(truth.dy)));
}

TEST_P(SecondMethod, AgreesWithTraces) {
  const auto& [name, surface, quad, box, size] = GetParam();
  std::mt19937 random(1);
  TraceOptions options;
  options.tolerance = kAsked;
  for (const double length : {0.05, 0.3, 1.0, 3.0}) {
    double place = 0.0, direction = 0.0, y = 0.0;
    for (int i = 0; i < 25; ++i) {
      const Uv p = random_point(random, box);
      const UvVec d = heading(*surface, p, uniform(random, -kPi, kPi));
      const double s = length * size;
      const TraceResult path = trace_geodesic(*surface, p, d, s, options);
      ASSERT_EQ(path.status, TraceStatus::Converged);
      const QuadEnd truth = quad_geodesic(*quad, p, d, Float128(s));
      const TraceErrors e = errors_of(*quad, truth, path.end);
      const double allowed = s * growth(truth, s);
      place = std::max(place, e.place / allowed);
      direction = std::max(direction, e.direction * size / std::max(allowed, size));
      y = std::max(y, e.y / allowed);
    }
    EXPECT_LT(place, kBar) << length;
    EXPECT_LT(direction, kBar) << length;
    EXPECT_LT(y, kBar) << length;
  }
}

TEST_P(SecondMethod, AgreesWithItselfOnTheJacobiField) {
  const auto& [name, surface, quad, box, size] = GetParam();
  std::mt19937 random(2);
  for (int i = 0; i < 3; ++i) {
    const Uv p = random_point(random, box);
    const UvVec d = heading(*surface, p, uniform(random, -kPi, kPi));
    const QuadEnd end = quad_geodesic(*quad, p, d, Float128(size));
    const Float128 spread = neighbours_spread(*quad, p, d, Float128(size));
    EXPECT_LT(static_cast<double>(abs(spread - end.y)), 1e-16) << name;
  }
}

// One step of Newton's method in 113 bits from our answer to the true geodesic between the points: what it corrects is
// our error.
TEST_P(SecondMethod, AgreesWithConnections) {
  const auto& [name, surface, quad, box, size] = GetParam();
  std::mt19937 random(3);
  ConnectOptions options;
  options.tolerance = kAsked;
  double length = 0.0, angle = 0.0, y = 0.0, end_direction = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Uv p = random_point(random, box);
    const double far = size * std::exp(uniform(random, std::log(0.01), std::log(1.0))), t = uniform(random, -kPi, kPi);
    const Uv q = trace_geodesic(*surface, p, heading(*surface, p, t), far).end.p;
    const Connection c = connect(*surface, p, q, std::nullopt, options);
    ASSERT_EQ(c.status, ConnectStatus::Converged);
    const QuadEnd end = quad_geodesic(*quad, p, c.start_direction, Float128(c.length));
    const QuadVec miss = quad_jet(*quad, q).S - end.x;
    const Float128 along = dot(miss, end.tangent), turn = dot(miss, end.across) / end.y;
    length = std::max(length, static_cast<double>(abs(along)) / c.length);
    angle = std::max(angle, static_cast<double>(abs(turn)));
    const QuadJet j = quad_jet(*quad, q);
    const QuadVec T = Float128(c.end_direction.u) * j.Su + Float128(c.end_direction.v) * j.Sv;
    end_direction = std::max(end_direction, static_cast<double>(norm(T - end.tangent - (turn * end.dy) * end.across)));
    y = std::max(y, static_cast<double>(abs(Float128(c.y) - end.y - along * end.dy)) / c.length);
  }
  EXPECT_LT(length, kBar);
  EXPECT_LT(angle, kBar);
  EXPECT_LT(end_direction, kBar);
  EXPECT_LT(y, kBar);
}

// Steps come from flat ground, as far as from 1e-13 of the bump's height, and end where it rises; and neighbours spread
// behind it by 20 radians a radian.
class TallBump : public ::testing::Test {
 protected:
  static constexpr double kHeight = 3.0, kWidth = 0.3;
  const UvBox square_{{-2.0, 2.0}, {-2.0, 2.0}};
  GaussianBumps bump_{{{{0.0, 0.0}, kHeight, kWidth}}, square_};
  QuadBump quad_{kHeight, kWidth};
};

TEST_F(TallBump, TracesFromFlatGroundKeepTheirTolerance) {
  std::mt19937 random(5);
  TraceOptions options;
  options.stop_at_domain = false;
  for (const double tolerance : {1e-9, 1e-12}) {
    options.tolerance = tolerance;
    double worst = 0.0;
    for (int i = 0; i < 60; ++i) {
      const Uv p = random_point(random, square_);
      const double towards = std::atan2(-p.v, -p.u) + uniform(random, -0.2, 0.2), s = 4.0;
      const UvVec d = UvVec{std::cos(towards), std::sin(towards)};
      const TraceResult path = trace_geodesic(bump_, p, d, s, options);
      ASSERT_EQ(path.status, TraceStatus::Converged);
      const QuadEnd truth = quad_geodesic(quad_, p, d, Float128(s));
      worst = std::max(worst, errors_of(quad_, truth, path.end).place / (s * growth(truth, s)));
    }
    EXPECT_LT(worst, 5.0 * tolerance);
  }
}

TEST_F(TallBump, DistancesAcrossItKeepTheirTolerance) {
  constexpr double kTolerance = 1e-12;
  std::mt19937 random(6);
  DistanceOptions options;
  options.connect.tolerance = kTolerance;
  const DistanceFinder finder(bump_, options);
  for (int i = 0; i < 60; ++i) {
    const Uv p = i == 0 ? Uv{-1.69237, -1.60349} : random_point(random, square_);
    const Uv q = i == 0 ? Uv{1.05903, 1.03831} : Uv{-uniform(random, 0.5, 1.1) * p.u, -uniform(random, 0.5, 1.1) * p.v};
    const DistanceResult r = finder.distance(p, q);
    ASSERT_EQ(r.status, ConnectStatus::Converged);
    for (const Connection& c : r.candidates) {
      const QuadEnd end = quad_geodesic(quad_, p, c.start_direction, Float128(c.length));
      const QuadVec miss = quad_jet(quad_, q).S - end.x;
      EXPECT_LT(static_cast<double>(abs(dot(miss, end.tangent))), 5.0 * kTolerance * c.length) << i;
      EXPECT_LT(static_cast<double>(abs(dot(miss, end.across) / end.y)), 5.0 * kTolerance) << i;
    }
  }
}

}  // namespace
}  // namespace geovor
