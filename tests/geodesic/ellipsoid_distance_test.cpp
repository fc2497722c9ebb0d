// Distances on ellipsoids of revolution held against GeographicLib's GeodesicExact (elliptic integrals), 1e5 pairs an
// ellipsoid.
#include <gtest/gtest.h>

#include <GeographicLib/GeodesicExact.hpp>
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <tuple>

#include "geodesic/distance.h"
#include "support/differences.h"
#include "surface/analytic_surfaces.h"
#include "surface/forms.h"
#include "surface/tangent_frame.h"

namespace geovor {
namespace {

using testing::uniform;
constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

// Of 1e5 pairs an ellipsoid; each shard is a ctest case of its own.
constexpr int kShards = 8;
constexpr int kPairs = 100000 / kShards;

constexpr double kWgs84 = 1.0 / 298.257223563;

struct Pair {
  Uv from, to;
};

double scale(std::mt19937& random, double least) { return std::pow(10.0, uniform(random, least, -1.0)); }

Uv moved(Uv p, double d, double t) {
  return {p.u + d * std::cos(t) / std::max(std::cos(p.v), d), std::clamp(p.v + d * std::sin(t), -0.5 * kPi, 0.5 * kPi)};
}

// In turn: near points at all scales; points all over; nearly opposite ones; one at a pole, one or both next to poles;
// both on one meridian or its continuation over the pole.
Pair random_pair(std::mt19937& random, int kind) {
  const Uv p{uniform(random, 0.0, 2.0 * kPi), std::asin(uniform(random, -1.0, 1.0))};
  const Uv q{uniform(random, 0.0, 2.0 * kPi), std::asin(uniform(random, -1.0, 1.0))};
  const double t = uniform(random, 0.0, 2.0 * kPi), side = uniform(random, -1.0, 1.0) < 0.0 ? -1.0 : 1.0;
  switch (kind % 10) {
    case 0:
    case 1:
    case 2:
    case 3:
      return {p, moved(p, 5.0 * scale(random, -6.0), t)};
    case 4:
      return {p, q};
    case 5: {
      const double d = scale(random, -8.0);
      return {p, {p.u + kPi + d * std::cos(t), std::clamp(-p.v + d * std::sin(t), -0.5 * kPi, 0.5 * kPi)}};
    }
    case 6:
      return {{p.u, side * 0.5 * kPi}, q};
    case 7:
      return {{p.u, side * (0.5 * kPi - scale(random, -12.0))}, q};
    case 8:
      return {{p.u, side * (0.5 * kPi - scale(random, -9.0))}, {q.u, side * (0.5 * kPi - scale(random, -9.0))}};
    default:
      return {p, {p.u + (side < 0.0 ? 0.0 : kPi), q.v}};
  }
}

double latitude(double v, double flattening) {
  return std::atan2(std::sin(v), (1.0 - flattening) * std::cos(v)) / kDegree;
}

// Angles from north clockwise, in degrees -> from east counter-clockwise.
double angle_of_azimuth(double azimuth) { return 0.5 * kPi - azimuth * kDegree; }

double difference(double a, double b) { return std::abs(std::remainder(a - b, 2.0 * kPi)); }

// What GeographicLib says of a pair, with our angles.
struct Truth {
  double length, reduced_length, angle, angle_at_end;
};

Truth truth(const GeographicLib::GeodesicExact& exact, double flattening, const Pair& pair) {
  double s = 0.0, azimuth = 0.0, azimuth_at_end = 0.0, m = 0.0, M12 = 0.0, M21 = 0.0;
  exact.Inverse(latitude(pair.from.v, flattening), pair.from.u / kDegree, latitude(pair.to.v, flattening),
                pair.to.u / kDegree, s, azimuth, azimuth_at_end, m, M12, M21);
  return {s, m, angle_of_azimuth(azimuth), angle_of_azimuth(azimuth_at_end)};
}

// How far from the pair's second point GeographicLib's direct problem ends, on the ellipsoid.
double miss(const GeographicLib::GeodesicExact& exact, const Ellipsoid& ellipsoid, double flattening, const Pair& pair,
            double angle, double length) {
  double lat = 0.0, lon = 0.0;
  exact.Direct(latitude(pair.from.v, flattening), pair.from.u / kDegree, 90.0 - angle / kDegree, length, lat, lon);
  const Uv end{lon * kDegree, std::atan2((1.0 - flattening) * std::sin(lat * kDegree), std::cos(lat * kDegree))};
  return (ellipsoid.position(end) - ellipsoid.position(pair.to)).norm();
}

// Of several shortest paths any may be the other's.
const Connection& nearest(const DistanceResult& result, double angle) {
  return *std::min_element(result.shortest_paths.begin(), result.shortest_paths.end(),
                           [angle](const Connection& a, const Connection& b) {
                             return difference(a.angle, angle) < difference(b.angle, angle);
                           });
}

class EllipsoidPairs : public ::testing::TestWithParam<std::tuple<double, int>> {};

// An angle moves the other end by y a radian: the smaller y, for near points and for points near to conjugate ones, the
// less the points tell the angle. Hence its weight.
TEST_P(EllipsoidPairs, HaveGeographicLibsDistanceAngleAndReducedLength) {
  const auto [flattening, shard] = GetParam();
  const GeographicLib::GeodesicExact exact(1.0, flattening);
  const Ellipsoid ellipsoid(1.0, 1.0, 1.0 - flattening);
  const double accuracy = 1e-13 * std::max(1.0, 1.0 - flattening);  // of the larger semi-axis
  DistanceOptions options;
  options.connect.tolerance = 1e-14;
  const DistanceFinder finder(ellipsoid, options);
  std::mt19937 random(100 + shard);
  int passed_over = 0;
  for (int i = 0; i < kPairs; ++i) {
    const Pair pair = random_pair(random, i);
    const Truth expected = truth(exact, flattening, pair);
    const DistanceResult r = finder.distance(pair.from, pair.to);
    SCOPED_TRACE(::testing::Message() << std::setprecision(17) << "from " << pair.from.u << ' ' << pair.from.v << " to "
                                      << pair.to.u << ' ' << pair.to.v);
    ASSERT_EQ(r.status, ConnectStatus::Converged);
    // On prolate ellipsoids GeographicLib's inverse now and then takes a path for shortest that has passed a conjugate
    // point, as its reduced length tells, or is 1e-12 off, as its own direct problem tells.
    const bool passed_conjugate = expected.reduced_length < -1e-9;
    if (passed_conjugate || std::abs(r.shortest.length - expected.length) > accuracy) {
      ++passed_over;
      EXPECT_LT(flattening, 0.0);
      const double ours = miss(exact, ellipsoid, flattening, pair, r.shortest.angle, r.shortest.length);
      const double other = miss(exact, ellipsoid, flattening, pair, expected.angle, expected.length);
      EXPECT_LT(ours, accuracy);
      EXPECT_TRUE(other > accuracy || (passed_conjugate && r.shortest.length < expected.length));
      continue;
    }
    const Connection& c = nearest(r, expected.angle);
    const double weight = std::min(1.0, expected.reduced_length);
    EXPECT_NEAR(c.y, expected.reduced_length, 1e-12);
    EXPECT_LT(weight * difference(c.angle, expected.angle), 1.5e-13);
    if (c.end_direction.u == 0.0 && c.end_direction.v == 0.0) continue;  // at a pole
    const Xyz end = push_forward(ellipsoid.jet(pair.to), c.end_direction);
    EXPECT_LT(weight * difference(tangent_frame(ellipsoid, pair.to).angle_of(end), expected.angle_at_end), 1.5e-13);
  }
  EXPECT_LE(passed_over, kPairs / 200);
}

TEST(EllipsoidDistance, PolesAreJoinedByEveryMeridian) {
  const Ellipsoid ellipsoid(1.0, 1.0, 0.6);
  const GeographicLib::GeodesicExact exact(1.0, 0.4);
  double length = 0.0;
  exact.Inverse(90.0, 0.0, -90.0, 0.0, length);
  const DistanceResult r = DistanceFinder(ellipsoid).distance({0.3, 0.5 * kPi}, {1.3, -0.5 * kPi});
  EXPECT_NEAR(r.shortest.length, length, 1e-12);
  EXPECT_TRUE(r.family);
  EXPECT_EQ(r.shortest_paths.size(), 1u);
}

INSTANTIATE_TEST_SUITE_P(Shards, EllipsoidPairs,
                         ::testing::Combine(::testing::Values(0.5, 0.0, -1.0, kWgs84), ::testing::Range(0, kShards)));

}  // namespace
}  // namespace geovor
