#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "geodesic/connect.h"
#include "geodesic/distance.h"
#include "surface/elementary_surfaces.h"
#include "surface/forms.h"

namespace geovor {
namespace {

constexpr double kPi = std::numbers::pi;

// The law of cosines in the development; the shorter way round.
double law_of_cosines(const Cone& cone, Uv p, Uv q) {
  const double a = std::abs(p.v - cone.apex_v()), b = std::abs(q.v - cone.apex_v());
  const double turn = std::abs(std::remainder(p.u - q.u, 2 * kPi)) * std::abs(std::sin(cone.half_angle()));
  return std::sqrt(a * a + b * b - 2 * a * b * std::cos(turn));
}

class ConeGeodesics : public ::testing::TestWithParam<double> {
 protected:
  Cone cone_{Frame{}, 2.0, GetParam()};
  std::mt19937 random_{7};
  Uv any() {
    std::uniform_real_distribution<double> u(0, 2 * kPi), v(0.01, 5.0);
    return {u(random_), cone_.apex_v() + v(random_)};
  }
};

TEST_P(ConeGeodesics, HaveTheLengthOfTheDevelopment) {
  for (int i = 0; i < 1000; ++i) {
    const Uv p = any(), q = any();
    const double d = distance(cone_, p, q).shortest.length;
    EXPECT_NEAR(d, law_of_cosines(cone_, p, q), 1e-13 * (1 + d));
  }
}

TEST_P(ConeGeodesics, ArriveWhereTheyWereSent) {
  for (int i = 0; i < 1000; ++i) {
    const Uv p = any(), q = any();
    const Connection c = connect(cone_, p, q);
    ASSERT_EQ(c.status, ConnectStatus::Converged);
    const TraceResult r = trace_geodesic(cone_, p, c.start_direction, c.length);
    EXPECT_LT((cone_.position(r.end.p) - cone_.position(q)).norm(), 1e-12);
    EXPECT_NEAR(norm(cone_.jet(p), c.start_direction), 1.0, 1e-12);
    const SurfaceJet j = cone_.jet(q);
    EXPECT_LT((push_forward(j, c.end_direction) - push_forward(cone_.jet(r.end.p), r.end.d)).norm(), 1e-10);
    EXPECT_DOUBLE_EQ(c.y, c.length);  // flat
  }
}

// A second method: the differential equation, on the same cone as a surface that the closed forms do not know.
TEST_P(ConeGeodesics, SolveTheGeodesicEquation) {
  class Unknown final : public Surface {
   public:
    explicit Unknown(const Cone& cone) : cone_(cone) {}
    SurfaceKind kind() const override { return SurfaceKind::Function; }
    UvBox domain() const override { return {{-100, 100}, {-100, 100}}; }
    SurfaceJet jet(Uv p) const override { return cone_.jet(p); }
    using Surface::jet;

   private:
    const Cone& cone_;
  };
  const Unknown unknown(cone_);
  for (int i = 0; i < 20; ++i) {
    const Uv p{0.3 * i, cone_.apex_v() + 1.0 + 0.1 * i};
    const UvVec d = direction_at_angle(cone_.jet(p), 0.37 * i);
    const TraceResult a = trace_geodesic(cone_, p, d, 0.8), b = trace_geodesic(unknown, p, d, 0.8);
    EXPECT_LT((cone_.position(a.end.p) - cone_.position(b.end.p)).norm(), 1e-11);
    EXPECT_NEAR(a.end.y, b.end.y, 1e-11);
  }
}

TEST_P(ConeGeodesics, StartAndEndAtTheTip) {
  const Uv tip{1.0, cone_.apex_v()}, p{4.0, cone_.apex_v() + 2.5};
  EXPECT_NEAR(distance(cone_, tip, p).shortest.length, 2.5, 1e-14);
  EXPECT_NEAR(distance(cone_, p, tip).shortest.length, 2.5, 1e-14);
  const TraceResult through = trace_geodesic(cone_, p, {0, -1}, 5.0);
  EXPECT_EQ(through.status, TraceStatus::DegenerateMetric);
  EXPECT_NEAR(through.length, 2.5, 1e-14);
}

INSTANTIATE_TEST_SUITE_P(HalfAngles, ConeGeodesics, ::testing::Values(0.1, 0.5, 1.2, -0.4));

}  // namespace
}  // namespace geovor
