// Geometry does not know its parameters: the same surface refined, raised, swapped, reversed and warped has the same
// distances (to 1e-12 of them) and the same paths in space (to 1e-11).
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <random>

#include "geodesic/distance.h"
#include "geodesic/trace.h"
#include "support/differences.h"
#include "support/geodesic_oracles.h"
#include "support/splines.h"
#include "surface/analytic_surfaces.h"
#include "surface/reparameterize.h"

namespace geovor {
namespace {

using namespace testing;
constexpr double kLengthBar = 1e-12;
constexpr double kPathBar = 1e-11;

DistanceOptions fine_distance() {
  DistanceOptions options;
  options.connect.tolerance = 1e-13;
  return options;
}

/// The points of space at equal parts of a path.
std::vector<Xyz> path_points(const Surface& surface, Uv p, const Connection& c) {
  TraceOptions options;
  options.tolerance = 1e-14;
  options.stop_at_domain = false;
  std::vector<Xyz> points;
  for (const GeodesicState& s : sample_geodesic(surface, p, c.start_direction, c.length, 8, options))
    points.push_back(surface.position(s.p));
  return points;
}

/// `rounding`: how far the two surfaces' points lie apart, in space.
void expect_same(const DistanceFinder& a, Uv pa, Uv qa, const DistanceFinder& b, Uv pb, Uv qb, double rounding = 0.0) {
  const Connection here = a.distance(pa, qa).shortest, there = b.distance(pb, qb).shortest;
  ASSERT_EQ(here.status, ConnectStatus::Converged);
  if (here.leaves_domain) return;  // where a warp folds
  ASSERT_EQ(there.status, ConnectStatus::Converged);
  EXPECT_NEAR(here.length, there.length, kLengthBar * here.length + 2.0 * rounding);
  const std::vector<Xyz> path = path_points(a.surface(), pa, here), other = path_points(b.surface(), pb, there);
  ASSERT_EQ(path.size(), other.size());
  for (std::size_t i = 0; i < path.size(); ++i)
    EXPECT_LT((path[i] - other[i]).norm(), kPathBar * here.length + 10.0 * rounding) << i;
}

/// x = lo + (hi - lo) t^3: the derivative is zero at t = 0.
class CubedMap final : public ParameterMap {
 public:
  explicit CubedMap(Interval range) : range_(range) {}
  Jet jet(double t) const override {
    const double w = range_.length();
    return {range_.lo + w * t * t * t, 3.0 * w * t * t, 6.0 * w * t, 6.0 * w};
  }
  double inverse(double x) const override { return std::cbrt((x - range_.lo) / range_.length()); }

 private:
  Interval range_;
};

/// x = lo + (hi - lo) (3 t^2 - 2 t^3): the derivative is zero at both ends.
class SmoothstepMap final : public ParameterMap {
 public:
  explicit SmoothstepMap(Interval range) : range_(range) {}
  Jet jet(double t) const override {
    const double w = range_.length();
    return {range_.lo + w * t * t * (3.0 - 2.0 * t), 6.0 * w * t * (1.0 - t), w * (6.0 - 12.0 * t), -12.0 * w};
  }
  double inverse(double x) const override {
    if (!std::isfinite(x)) return x;
    return 0.5 - std::sin(std::asin(1.0 - 2.0 * (x - range_.lo) / range_.length()) / 3.0);
  }

 private:
  Interval range_;
};

SplineData swapped(const SplineData& d) {
  SplineData s;
  s.u_degree = d.v_degree, s.v_degree = d.u_degree;
  s.u_knots = d.v_knots, s.v_knots = d.u_knots;
  for (int j = 0; j < d.v_count(); ++j) {
    for (int i = 0; i < d.u_count(); ++i) {
      s.poles.push_back(d.poles[i * d.v_count() + j]);
      if (!d.weights.empty()) s.weights.push_back(d.weights[i * d.v_count() + j]);
    }
  }
  return s;
}

/// Bézier elevation in u of a spline of one span: the same surface, one degree higher.
SplineData raised(const SplineData& d) {
  SplineData r = d;
  const int n = d.u_degree + 1, m = d.v_count();
  r.u_degree = n;
  r.u_knots.insert(r.u_knots.begin(), d.u_knots.front());
  r.u_knots.push_back(d.u_knots.back());
  r.poles.clear();
  for (int i = 0; i <= n; ++i) {
    const double a = static_cast<double>(i) / n;
    for (int j = 0; j < m; ++j)
      r.poles.push_back(a * d.poles[std::max(i - 1, 0) * m + j] + (1.0 - a) * d.poles[std::min(i, n - 1) * m + j]);
  }
  return r;
}

class SplineParameters : public ::testing::TestWithParam<bool> {
 protected:
  SplineData data_ = random_spline(3, 3, 4, GetParam(), 31);
  BSplineSurface spline_ = data_.surface();
  void expect_same_under(const Surface& other, const std::function<Uv(Uv)>& map, int count = 15) {
    std::mt19937 random(1);
    const DistanceFinder here(spline_, fine_distance()), there(other, fine_distance());
    for (int i = 0; i < count; ++i) {
      const Uv p = random_point(random, {{0.8, 3.2}, {0.8, 3.2}}), q = random_point(random, {{0.8, 3.2}, {0.8, 3.2}});
      expect_same(here, p, q, there, map(p), map(q));
    }
  }
};
INSTANTIATE_TEST_SUITE_P(Kinds, SplineParameters, ::testing::Bool(),
                         [](const auto& instance) { return instance.param ? "rational" : "polynomial"; });

TEST_P(SplineParameters, DoNotMatterAfterKnotInsertion) {
  SplineData more = data_;
  for (const double x : {0.37, 1.5, 1.5, 2.2, 2.9}) more = insert_u_knot(more, x);
  expect_same_under(more.surface(), [](Uv p) { return p; });
}

TEST_P(SplineParameters, DoNotMatterAfterSwapOfTheAxes) {
  expect_same_under(swapped(data_).surface(), [](Uv p) { return Uv{p.v, p.u}; });
}

TEST(BezierParameters, DoNotMatterAfterDegreeElevation) {
  const SplineData data = random_spline(3, 3, 1, false, 32);
  const BSplineSurface plain = data.surface(), more = raised(raised(data)).surface();
  const DistanceFinder here(plain, fine_distance()), there(more, fine_distance());
  std::mt19937 random(2);
  for (int i = 0; i < 30; ++i) {
    const Uv p = random_point(random, {{0.1, 0.9}, {0.1, 0.9}}), q = random_point(random, {{0.1, 0.9}, {0.1, 0.9}});
    expect_same(here, p, q, there, p, q);
  }
}

struct Warp {
  const char* name;
  std::function<ParameterMapPtr(Interval)> u, v;
  bool swap;
};
void PrintTo(const Warp& w, std::ostream* out) { *out << w.name; }

std::function<ParameterMapPtr(Interval)> moebius(double A) {
  return [A](Interval range) { return moebius_map(range, A); };
}
ParameterMapPtr cubed(Interval range) { return std::make_shared<CubedMap>(range); }
ParameterMapPtr smoothstep(Interval range) { return std::make_shared<SmoothstepMap>(range); }
ParameterMapPtr reversed(Interval range) { return affine_map(-1.0, range.lo + range.hi); }
ParameterMapPtr stretched(Interval) { return affine_map(1e-3, 0.0); }
ParameterMapPtr as_it_was(Interval) { return nullptr; }

class Warped : public ::testing::TestWithParam<Warp> {};
INSTANTIATE_TEST_SUITE_P(Warps, Warped,
                         ::testing::Values(Warp{"moebius_4", moebius(4), moebius(0.25), false},
                                           Warp{"moebius_16", moebius(16), moebius(16), false},
                                           Warp{"moebius_64", moebius(64), moebius(64), true},
                                           Warp{"cubed_u", cubed, as_it_was, false}, Warp{"cubed", cubed, cubed, false},
                                           Warp{"smoothstep", smoothstep, smoothstep, false},
                                           Warp{"reversed", reversed, as_it_was, false},
                                           Warp{"swapped", reversed, reversed, true},
                                           Warp{"stretched", stretched, as_it_was, false}),
                         [](const auto& instance) { return std::string(instance.param.name); });

// The points are the same to a rounding of the warped parameters, which costs their speed there.
void expect_same_when_warped(const SurfacePtr& base, const UvBox& points, const Warp& warp) {
  const Reparameterized other(base, warp.u(base->domain().u), warp.v(base->domain().v), warp.swap);
  const DistanceFinder here(base, fine_distance()), there(other, fine_distance());
  std::mt19937 random(3);
  for (int i = 0; i < 15; ++i) {
    const Uv a = other.from_base(random_point(random, points)), b = other.from_base(random_point(random, points));
    const Uv p = other.to_base(a), q = other.to_base(b);
    const double rounding =
        (base->position(p) - other.position(a)).norm() + (base->position(q) - other.position(b)).norm();
    expect_same(here, p, q, there, a, b, rounding);
  }
}

TEST_P(Warped, WaveHasTheSameDistancesAndPaths) {
  const UvBox square{{-2.0, 2.0}, {-2.0, 2.0}};
  expect_same_when_warped(std::make_shared<WaveSurface>(square), {{-1.6, 1.6}, {-1.6, 1.6}}, GetParam());
}

TEST_P(Warped, BicubicHasTheSameDistancesAndPaths) {
  expect_same_when_warped(std::make_shared<BSplineSurface>(random_spline(3, 3, 4, false, 33).surface()),
                          {{0.8, 3.2}, {0.8, 3.2}}, GetParam());
}

// Laws that hold whatever the shape, on splines; the cut locus is no exception.
TEST(SplineDistances, AreSymmetricAndKeepTheTriangleInequality) {
  const BSplineSurface spline = random_spline(3, 3, 6, true, 34).surface();
  const DistanceFinder finder(spline, fine_distance());
  std::mt19937 random(4);
  const UvBox box{{1.0, 5.0}, {1.0, 5.0}};
  for (int i = 0; i < 60; ++i) {
    const Uv p = random_point(random, box), q = random_point(random, box), r = random_point(random, box);
    const double pq = finder.distance(p, q).shortest.length, qp = finder.distance(q, p).shortest.length;
    EXPECT_NEAR(pq, qp, kLengthBar * pq);
    const double qr = finder.distance(q, r).shortest.length, pr = finder.distance(p, r).shortest.length;
    EXPECT_LE(pr, pq + qr + kLengthBar * pr);
    EXPECT_LE(pq, pr + qr + kLengthBar * pq);
    EXPECT_LE(qr, pq + pr + kLengthBar * qr);
  }
}

}  // namespace
}  // namespace geovor
