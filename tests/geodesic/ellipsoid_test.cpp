// Geodesics on ellipsoids of revolution against the elliptic integrals of GeographicLib (C. F. F. Karney, Algorithms
// for geodesics, J. Geodesy 87, 2013).
#include <gtest/gtest.h>

#include <GeographicLib/GeodesicExact.hpp>
#include <cmath>
#include <numbers>

#include "geodesic/connect.h"
#include "geodesic/offset.h"
#include "support/differences.h"
#include "support/geodesic_oracles.h"
#include "surface/analytic_surfaces.h"
#include "surface/forms.h"

namespace geovor {
namespace {

using testing::uniform;
constexpr double kDegree = std::numbers::pi / 180.0;

// The ellipsoid's v is the reduced latitude.
double reduced(double latitude, double flattening) {
  return std::atan((1.0 - flattening) * std::tan(latitude * kDegree));
}

class EllipsoidOfRevolution : public ::testing::TestWithParam<double> {};

TEST_P(EllipsoidOfRevolution, DirectProblemAgreesWithGeographicLib) {
  const double a = 2.0, f = GetParam();
  const Ellipsoid ellipsoid(a, a, a * (1.0 - f));
  const GeographicLib::GeodesicExact exact(a, f);
  std::mt19937 random(1);
  for (int i = 0; i < 60; ++i) {
    const double latitude = uniform(random, -40.0, 40.0), azimuth = uniform(random, 60.0, 120.0);
    const double s = uniform(random, 0.1, 5.0);
    double latitude2, longitude2, azimuth2, m12, M12, M21;
    exact.Direct(latitude, 0.0, azimuth, s, latitude2, longitude2, azimuth2, m12, M12, M21);
    const Uv p{0.0, reduced(latitude, f)}, q{longitude2 * kDegree, reduced(latitude2, f)};
    // Azimuths run from north to east, angles from e1 (east) to north.
    const UvVec d = testing::heading(ellipsoid, p, (90.0 - azimuth) * kDegree);
    const TraceResult path = trace_geodesic(ellipsoid, p, d, s);
    ASSERT_EQ(path.status, TraceStatus::Converged);
    EXPECT_LT(testing::gap(ellipsoid, path.end.p, q), 1e-11);
    EXPECT_NEAR(path.end.y, m12, 1e-11);
    EXPECT_NEAR(path.end.dy, M21, 1e-10);  // dm12 / ds2
  }
}

TEST_P(EllipsoidOfRevolution, InverseProblemAgreesWithGeographicLib) {
  const double a = 2.0, f = GetParam();
  const Ellipsoid ellipsoid(a, a, a * (1.0 - f));
  const GeographicLib::GeodesicExact exact(a, f);
  std::mt19937 random(2);
  for (int i = 0; i < 60; ++i) {
    const double latitude1 = uniform(random, -50.0, 50.0), latitude2 = uniform(random, -50.0, 50.0);
    const double longitude = uniform(random, 1.0, 80.0);
    double s12, azimuth1, azimuth2, m12, M12, M21;
    exact.Inverse(latitude1, 0.0, latitude2, longitude, s12, azimuth1, azimuth2, m12, M12, M21);
    const Connection c = connect(ellipsoid, {0.0, reduced(latitude1, f)}, {longitude * kDegree, reduced(latitude2, f)});
    ASSERT_EQ(c.status, ConnectStatus::Converged);
    EXPECT_NEAR(c.length, s12, 1e-11);
    EXPECT_NEAR(c.y, m12, 1e-10);
    EXPECT_NEAR(c.angle, (90.0 - azimuth1) * kDegree, 1e-10);
  }
}

// Over both poles and past them at any distance: azimuths from 60 degrees down to nothing.
TEST_P(EllipsoidOfRevolution, PathsPastThePolesAgreeWithGeographicLib) {
  const double a = 2.0, f = GetParam();
  const Ellipsoid ellipsoid(a, a, a * (1.0 - f));
  const GeographicLib::GeodesicExact exact(a, f);
  std::mt19937 random(3);
  for (const double azimuth : {60.0, 10.0, 1.0, 1e-2, 1e-4, 1e-7, 1e-10, 1e-13, 0.0}) {
    for (int i = 0; i < 10; ++i) {
      const double latitude = uniform(random, -60.0, 60.0), s = uniform(random, 2.0, 10.0);
      double latitude2, longitude2, azimuth2, m12, M12, M21;
      exact.Direct(latitude, 0.0, azimuth, s, latitude2, longitude2, azimuth2, m12, M12, M21);
      const Uv p{0.0, reduced(latitude, f)}, q{longitude2 * kDegree, reduced(latitude2, f)};
      const UvVec d = testing::heading(ellipsoid, p, (90.0 - azimuth) * kDegree);
      const TraceResult path = trace_geodesic(ellipsoid, p, d, s);
      ASSERT_EQ(path.status, TraceStatus::Converged);
      EXPECT_LT(testing::gap(ellipsoid, path.end.p, q), 5e-12 * s) << azimuth;
      EXPECT_NEAR(path.end.y, m12, 2e-11 * s) << azimuth;
      EXPECT_NEAR(path.end.dy, M21, 2e-11 * s) << azimuth;
    }
  }
}

TEST_P(EllipsoidOfRevolution, ReducedLengthVanishesAtTheFirstConjugatePoint) {
  const double a = 2.0, f = GetParam();
  const Ellipsoid ellipsoid(a, a, a * (1.0 - f));
  const GeographicLib::GeodesicExact exact(a, f);
  for (int i = 0; i < 30; ++i) {
    const double latitude = -60.0 + 4.0 * i, azimuth = 12.0 * i;
    const Uv p{0.0, reduced(latitude, f)};
    const auto conjugate = first_conjugate_point(ellipsoid, p, (90.0 - azimuth) * kDegree, 12.0);
    ASSERT_TRUE(conjugate);
    double latitude2, longitude2, azimuth2, m12, M12, M21;
    exact.Direct(latitude, 0.0, azimuth, conjugate->s, latitude2, longitude2, azimuth2, m12, M12, M21);
    EXPECT_NEAR(m12, 0.0, 1e-10) << latitude << ' ' << azimuth;
    EXPECT_GT(conjugate->s, 4.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Flattenings, EllipsoidOfRevolution, ::testing::Values(1.0 / 298.257223563, 0.2, -0.25));

}  // namespace
}  // namespace geovor
