// Places where a surface's map has no tangent plane: a path ends before them with their place, or goes on right.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "geodesic/integrator.h"
#include "geodesic/path.h"
#include "support/differences.h"
#include "support/geodesic_oracles.h"
#include "surface/analytic_surfaces.h"
#include "surface/bspline_surface.h"
#include "surface/forms.h"

namespace geovor {
namespace {

using namespace testing;
const UvBox kSquare{{-4.0, 4.0}, {-4.0, 4.0}};
constexpr int kManyEvaluations = 1000;

// The wave with x = u^3: Su = 0 on the border u = 0.
class CubedWave final : public Surface {
 public:
  SurfaceKind kind() const override { return SurfaceKind::Function; }
  UvBox domain() const override { return {{0.0, 1.5}, {-4.0, 4.0}}; }
  SurfaceJet jet(Uv p) const override {
    const double x1 = 3.0 * p.u * p.u, x2 = 6.0 * p.u;
    const SurfaceJet w = WaveSurface(kSquare).jet({p.u * p.u * p.u, p.v});
    return {w.S, x1 * w.Su, w.Sv, x1 * x1 * w.Suu + x2 * w.Su, x1 * w.Suv, w.Svv};
  }
  using Surface::jet;
};

// The wave with x = u^2: the map folds along u = 0, the normal turns about.
class FoldedWave final : public Surface {
 public:
  SurfaceKind kind() const override { return SurfaceKind::Function; }
  UvBox domain() const override { return {{-1.5, 1.5}, {-4.0, 4.0}}; }
  SurfaceJet jet(Uv p) const override {
    const double x1 = 2.0 * p.u;
    const SurfaceJet w = WaveSurface(kSquare).jet({p.u * p.u, p.v});
    return {w.S, x1 * w.Su, w.Sv, x1 * x1 * w.Suu + 2.0 * w.Su, x1 * w.Suv, w.Svv};
  }
  using Surface::jet;
};

// A cone that does not know that it is one: its tip is the side v = 0.
class UnknownCone final : public Surface {
 public:
  SurfaceKind kind() const override { return SurfaceKind::Function; }
  UvBox domain() const override { return {{-8.0, 8.0}, {0.0, 4.0}}; }
  SurfaceJet jet(Uv p) const override {
    const Xyz out{std::cos(p.u), std::sin(p.u), 1.0}, along{-std::sin(p.u), std::cos(p.u), 0.0};
    return {p.v * out, p.v * along, out, p.v * (Xyz::UnitZ() - out), along, Xyz::Zero()};
  }
  using Surface::jet;
};

// A polynomial cone over a parabola; its tip is the side v = 0.
BSplineSurface spike() {
  std::vector<Xyz> poles;
  for (const Xyz& out : {Xyz(1.0, 0.0, 1.0), Xyz(1.0, 1.0, 1.5), Xyz(0.0, 1.0, 1.0)}) {
    poles.push_back(Xyz::Zero());
    poles.push_back(out);
  }
  return {KnotVector({0.0, 1.0}, {3, 3}, 2), KnotVector({0.0, 1.0}, {2, 2}, 1), poles};
}

void expect_no_nonsense(const TraceResult& r) {
  EXPECT_TRUE(is_finite(r.end.p));
  EXPECT_TRUE(std::isfinite(r.end.y) && std::isfinite(r.end.dy) && std::isfinite(r.length));
  EXPECT_LT(r.evaluations, kManyEvaluations);
}

// Where the path is told, it is that of the wave in its own parameters; where it is not, it is told where it ends.
template <class Bad>
void expect_wave(const Bad& bad, double (*x_of_u)(double), double u, double angle, bool bounded) {
  const WaveSurface wave(kSquare);
  const Uv p{u, 0.3}, q{x_of_u(u), 0.3};
  const Xyz T = push_forward(wave.jet(q), heading(wave, q, angle));
  TraceOptions options;
  options.stop_at_domain = bounded;
  GeodesicIntegrator path(bad, p, T, 0.8, options);
  path.advance(0.8);
  const TraceResult r{path.status(), path.state(), path.covered(), path.steps(), path.evaluations()};
  SCOPED_TRACE(::testing::Message() << u << ' ' << angle << ' ' << int(r.status));
  expect_no_nonsense(r);
  if (r.length == 0.0) return;
  const TraceResult plain = trace_geodesic(wave, q, heading(wave, q, angle), r.length);
  EXPECT_LT((bad.position(r.end.p) - wave.position(plain.end.p)).norm(), 1e-9);
  if (r.status != TraceStatus::Converged) {
    EXPECT_LT(std::abs(plain.end.p.u), 1e-9);
  }
}

TEST(DegenerateMetric, BorderWithoutSpeedIsReachedAndNamed) {
  const CubedWave bad;
  for (const bool bounded : {true, false})
    for (const double u : {1.0, 0.3, 1e-2, 1e-3})
      for (const double angle : {0.0, 0.5, 1.5, std::numbers::pi / 2.0, 2.0, 3.0, std::numbers::pi, -2.0})
        expect_wave(
            bad, +[](double x) { return x * x * x; }, u, angle, bounded);
}

TEST(DegenerateMetric, FoldIsReachedAndNamed) {
  const FoldedWave bad;
  for (const double u : {1.0, 0.3, 1e-2, 1e-4})
    for (const double angle : {0.0, 0.5, 1.5, std::numbers::pi / 2.0, 2.0, 3.0, std::numbers::pi, -2.0})
      expect_wave(
          bad, +[](double x) { return x * x; }, u, angle, true);
}

// Starts on the bad line, and as near to it as numbers go, in all directions.
TEST(DegenerateMetric, StartsOnAndBesideTheBadLineEndInAStatus) {
  const CubedWave cubed;
  const FoldedWave folded;
  const BSplineSurface tip = spike();
  for (const Surface* bad : std::initializer_list<const Surface*>{&cubed, &folded, &tip})
    for (const double offset : {0.0, 1e-300, 1e-100, 1e-20, 1e-12, 1e-8, 1e-5})
      for (int i = 0; i < 8; ++i) {
        const Uv p = bad == &tip ? Uv{0.4, offset} : Uv{offset, 0.3};
        const UvVec d{std::cos(0.8 * i), std::sin(0.8 * i)};
        const TraceResult r = trace_geodesic(*bad, p, d, 0.7);
        SCOPED_TRACE(::testing::Message() << offset << ' ' << i << ' ' << int(r.status));
        expect_no_nonsense(r);
        EXPECT_NE(r.status, TraceStatus::StepLimit);
        if (offset == 0.0) {
          EXPECT_THAT(r.status, ::testing::AnyOf(TraceStatus::DegenerateMetric, TraceStatus::LeftDomain));
          EXPECT_EQ(r.end.p, p);
          EXPECT_EQ(r.length, 0.0);
        }
      }
}

// All along, into a fold, along it and past it, the path and its Jacobi field are those of the wave.
TEST(DegenerateMetric, PathsBesideAFoldAreRightAtEveryPoint) {
  const FoldedWave bad;
  const WaveSurface wave(kSquare);
  for (const double u : {0.5, 1e-1, 1e-2, 1e-3})
    for (const double angle : {0.3, 1.5, std::numbers::pi / 2.0, 1.6, 1.65, 2.5, std::numbers::pi}) {
      const Uv p{u, 0.3}, q{u * u, 0.3};
      const GeodesicPath path(bad, p, push_forward(wave.jet(q), heading(wave, q, angle)), 0.8);
      const GeodesicPath plain(wave, q, heading(wave, q, angle), 0.8);
      SCOPED_TRACE(::testing::Message() << u << ' ' << angle << ' ' << int(path.result().status));
      EXPECT_LT(path.result().evaluations, kManyEvaluations);
      if (path.result().status != TraceStatus::Converged) {
        EXPECT_LT(std::abs(plain.state(path.length()).p.u), 1e-9);
      }
      for (int i = 1; i < 200; ++i) {
        const double s = path.length() * (1.0 - std::pow(0.87, i));
        EXPECT_LT((path.at(s).S - plain.at(s).S).norm(), 1e-11) << s;
        EXPECT_NEAR(path.state(s).y, plain.state(s).y, 1e-11) << s;
      }
    }
}

// Unrolled the path is a straight line that passes the tip at the distance `miss`, turning about it by half a turn.
TEST(DegenerateMetric, PathsThatPassATipAreFollowed) {
  const UnknownCone cone;
  const double start = std::numbers::sqrt2, length = 2.0;
  for (const double miss : {0.3, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    const double sine = miss / start, cosine = std::sqrt(1.0 - sine * sine);
    const TraceResult r = trace_geodesic(cone, {0.0, 1.0}, {sine, -cosine / std::numbers::sqrt2}, length);
    SCOPED_TRACE(miss);
    ASSERT_EQ(r.status, TraceStatus::Converged);
    const double before = start * cosine, behind = length - before;
    EXPECT_NEAR(r.end.p.v * std::numbers::sqrt2, std::hypot(miss, behind), 1e-11);
    const double turn = std::atan2(before, miss) + std::atan2(behind, miss);
    EXPECT_NEAR(r.end.p.u, turn * std::numbers::sqrt2, 1e-11 / miss);
    EXPECT_NEAR(r.end.y, length, 1e-10);
    EXPECT_LT(r.evaluations, 4 * kManyEvaluations);
  }
}

// A line on the cone to its tip: the length is the distance.
TEST(DegenerateMetric, TipOfASpikeEndsThePath) {
  const BSplineSurface tip = spike();
  for (const double u : {0.2, 0.5, 0.9}) {
    const Uv p{u, 0.7};
    TraceOptions options;
    options.stop_at_domain = false;
    const TraceResult r = trace_geodesic(tip, p, {0.0, -1.0}, 5.0, options);
    expect_no_nonsense(r);
    EXPECT_EQ(r.status, TraceStatus::DegenerateMetric);
    EXPECT_NEAR(r.length, tip.position(p).norm(), 1e-6 * 5.0);  // the jets near the tip are exact to 1e-16
    EXPECT_NEAR(r.end.p.v, 0.0, 1e-6 * 5.0);
  }
}

TEST(DegenerateMetric, DirectionsWithoutLengthEndAtTheStart) {
  const WaveSurface wave(kSquare);
  for (const UvVec d : {UvVec{0.0, 0.0}, UvVec{std::nan(""), 1.0}}) {
    const TraceResult r = trace_geodesic(wave, {0.1, 0.2}, d, 1.0);
    EXPECT_EQ(r.status, TraceStatus::DegenerateMetric);
    EXPECT_EQ(r.length, 0.0);
  }
}

}  // namespace
}  // namespace geovor
