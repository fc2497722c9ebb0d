// The offset function: its derivatives, and conjugate points.
#include "geodesic/offset.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "support/differences.h"
#include "support/geodesic_oracles.h"
#include "surface/analytic_surfaces.h"
#include "surface/elementary_surfaces.h"
#include "surface/forms.h"
#include "surface/pole_chart.h"
#include "surface/tangent_frame.h"

namespace geovor {
namespace {

using namespace testing;
constexpr double kPi = std::numbers::pi;
const UvBox kSquare{{-4.0, 4.0}, {-4.0, 4.0}};

TraceOptions fine() {
  TraceOptions options;
  options.tolerance = 1e-14;
  options.stop_at_domain = false;
  return options;
}

// The wave in parameters whose lines meet at an angle of about 1e-4: x = u + v, y = 1e-4 v.
class ShearedWave final : public Surface {
 public:
  static constexpr double kShear = 1e-4;
  SurfaceKind kind() const override { return SurfaceKind::Function; }
  UvBox domain() const override { return {{-1e6, 1e6}, {-1e6, 1e6}}; }
  SurfaceJet jet(Uv p) const override {
    const double k = kShear;
    const SurfaceJet w = WaveSurface(kSquare).jet({p.u + p.v, k * p.v});
    return {w.S, w.Su, w.Su + k * w.Sv, w.Suu, w.Suu + k * w.Suv, w.Suu + 2.0 * k * w.Suv + k * k * w.Svv};
  }
  using Surface::jet;
};

TEST(OffsetFunction, DerivativesInSpaceAreThoseOfDifferences) {
  const WaveSurface wave(kSquare);
  const Torus torus({}, 3.0, 1.0);
  const Ellipsoid ellipsoid(1.0, 0.9, 0.7);
  const Sphere sphere({}, 2.0);
  const Cylinder cylinder({}, 1.5);
  std::mt19937 random(1);
  for (const Surface* surface : std::initializer_list<const Surface*>{&wave, &torus, &ellipsoid, &sphere, &cylinder}) {
    for (int i = 0; i < 10; ++i) {
      const Uv p{uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)};
      const double s = uniform(random, 0.2, 2.0), t = uniform(random, 0.0, 6.0);
      const OffsetJet o = offset(*surface, p, s, t, fine());
      const auto at = [&](double s1, double t1) { return offset(*surface, p, s1, t1, fine()).at.S; };
      const Xyz ds = central_difference([&](double x) { return at(x, t); }, s, 1e-3);
      const Xyz dt = central_difference([&](double x) { return at(s, x); }, t, 1e-3);
      const SurfaceJet j = surface->jet(o.uv);
      EXPECT_LT((ds - o.at.tangent).norm(), 1e-9);
      EXPECT_LT((dt - o.y * o.at.normal.cross(o.at.tangent)).norm(), 1e-9);
      EXPECT_LT((push_forward(j, o.ds) - o.at.tangent).norm(), 1e-11);
      EXPECT_LT((push_forward(j, o.dt) - o.y * o.at.normal.cross(o.at.tangent)).norm(), 1e-11);
    }
  }
}

TEST(OffsetFunction, KeepsItsDigitsWhereParameterLinesAreSheared) {
  const WaveSurface wave(kSquare);
  const ShearedWave sheared;
  const double k = ShearedWave::kShear;
  for (int i = 0; i < 12; ++i) {
    const double t = 0.5 * i, s = 1.2;
    const OffsetJet plain = offset(wave, {0.3, -0.2}, s, t, fine());
    const OffsetJet other = offset(sheared, {0.3 + 0.2 / k, -0.2 / k}, s, t, fine());  // e1 is along x on both
    // u and v are 1e4 times what they add up to, and their squares enter the equation: 1e-8 of double is left. The
    // derivative adds nothing to that, where EG - F^2 would have lost 1e-8 by itself.
    EXPECT_LT((plain.at.S - other.at.S).norm(), 1e-8);
    EXPECT_LT(
        (push_forward(sheared.jet(other.uv), other.dt) - other.y * other.at.normal.cross(other.at.tangent)).norm(),
        1e-11);
  }
}

TEST(OffsetFunction, StartsFromAPoleInTheFrameThere) {
  const Ellipsoid sphere(1.0, 1.0, 1.0);
  for (const auto& chart : sphere.poles())
    for (int i = 0; i < 12; ++i) {
      const Uv pole = chart->side().point(0.4 * i, 0.0);
      const Xyz T = tangent_frame(sphere, pole).at_angle(1.0);
      const OffsetJet o = offset(sphere, pole, 0.8, 1.0);
      EXPECT_LT((o.at.S - std::cos(0.8) * chart->pole() - std::sin(0.8) * T).norm(), 5e-12);
      EXPECT_NEAR(o.y, std::sin(0.8), 5e-12);
    }
}

TEST(FirstConjugatePoint, IsWhereItIsKnown) {
  const Torus torus({}, 3.0, 1.0);  // along the outer equator K = 1 / (r (R + r)); the inner one has K < 0
  const auto outer = first_conjugate_point(torus, {0.3, 0.0}, 0.0, 10.0);
  ASSERT_TRUE(outer);
  EXPECT_NEAR(outer->s, 2.0 * kPi, 2e-11);
  EXPECT_NEAR(outer->uv.u, 0.3 + 2.0 * kPi / 4.0, 2e-11);
  EXPECT_FALSE(first_conjugate_point(torus, {0.3, kPi}, 0.0, 10.0));
  for (int i = 0; i < 12; ++i)
    EXPECT_NEAR(first_conjugate_point(Sphere({}, 2.0), {0.3, 0.4}, 0.5 * i, 7.0)->s, 2.0 * kPi, 1e-14);
  EXPECT_FALSE(first_conjugate_point(Sphere({}, 2.0), {0.3, 0.4}, 1.0, 6.0));
  EXPECT_FALSE(first_conjugate_point(Cylinder({}, 2.0), {0.3, 0.4}, 1.0, 100.0));
}

}  // namespace
}  // namespace geovor
