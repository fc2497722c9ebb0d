// Across a crease the geodesic is the path that is shortest among the neighbouring ones: held against a minimization
// over the place where the crease is crossed, with each patch a smooth surface of its own, and against the second
// method in 113 bits.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geodesic/connect.h"
#include "geodesic/distance.h"
#include "geodesic/trace.h"
#include "support/geodesic_oracles.h"
#include "support/quad_geodesic.h"
#include "support/splines.h"

namespace geovor {
namespace {

using namespace testing;
constexpr double kBar = 1e-12;

/// Two bicubic patches that share the row of poles at u = 1 and nothing else. `fold`: how steeply they rise from it.
class FoldedSheet {
 public:
  FoldedSheet(double fold, double waves, unsigned seed) {
    std::mt19937 random(seed);
    data_.u_knots = {0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2};
    data_.v_knots = {0, 0, 0, 0, 2, 2, 2, 2};
    for (int i = 0; i < 7; ++i)
      for (int j = 0; j < 4; ++j)
        data_.poles.push_back({i / 3.0 + waves * uniform(random, -0.1, 0.1), 2.0 * j / 3.0,
                               -fold * std::abs(i / 3.0 - 1.0) + waves * uniform(random, -0.2, 0.2)});
  }
  const SplineData& whole() const { return data_; }
  SplineData patch(int k) const {
    SplineData d = data_;
    const double lo = k, hi = k + 1.0;
    d.u_knots = {lo, lo, lo, lo, hi, hi, hi, hi};
    d.poles.assign(data_.poles.begin() + 12 * k, data_.poles.begin() + 12 * k + 16);
    return d;
  }

 private:
  SplineData data_;
};

double length_by(const Surface& a, const Surface& b, Uv p, Uv q, double v) {
  ConnectOptions options;
  options.tolerance = 1e-14;
  return connect(a, p, {1.0, v}, std::nullopt, options).length + connect(b, {1.0, v}, q, std::nullopt, options).length;
}

/// The least length over the crossing's v, by Newton's method on differences of the length.
double least_length(const Surface& a, const Surface& b, Uv p, Uv q, double v) {
  const double h = 1e-3;
  for (int i = 0; i < 8; ++i) {
    const double l3 = length_by(a, b, p, q, v + 3 * h) - length_by(a, b, p, q, v - 3 * h);
    const double l2 = length_by(a, b, p, q, v + 2 * h) - length_by(a, b, p, q, v - 2 * h);
    const double up = length_by(a, b, p, q, v + h), down = length_by(a, b, p, q, v - h);
    const double slope = (45.0 * (up - down) - 9.0 * l2 + l3) / (60.0 * h);
    v -= slope / ((up + down - 2.0 * length_by(a, b, p, q, v)) / (h * h));
  }
  return length_by(a, b, p, q, v);
}

struct Fold {
  double fold, waves;
};
void PrintTo(const Fold& f, std::ostream* out) { *out << "fold " << f.fold << ", waves " << f.waves; }

class Crease : public ::testing::TestWithParam<Fold> {
 protected:
  FoldedSheet sheet_{GetParam().fold, GetParam().waves, 5};
  BSplineSurface whole_ = sheet_.whole().surface(), left_ = sheet_.patch(0).surface(),
                 right_ = sheet_.patch(1).surface();
  QuadSpline quad_{sheet_.whole()};
  std::mt19937 random_{6};
  Uv left() { return random_point(random_, {{0.5, 0.9}, {0.6, 1.4}}); }
};
INSTANTIATE_TEST_SUITE_P(Folds, Crease,
                         ::testing::Values(Fold{0.3, 0.0}, Fold{1.0, 1.0}, Fold{-0.5, 1.0}, Fold{0.0, 1.0}));

TEST_P(Crease, TracesAreShortestAmongTheirNeighbours) {
  TraceOptions options;
  options.tolerance = 1e-14;
  int crossings = 0;
  for (int i = 0; i < 30; ++i) {
    const Uv p = left();
    const UvVec d = heading(whole_, p, uniform(random_, -0.9, 0.9));
    const TraceResult path = trace_geodesic(whole_, p, d, 0.8, options);
    if (path.status != TraceStatus::Converged || !(path.end.p.u > 1.02) || path.end.p.u > 1.95) continue;
    ++crossings;
    const double v = lerp(p, path.end.p, (1.0 - p.u) / (path.end.p.u - p.u)).v;
    EXPECT_NEAR(least_length(left_, right_, p, path.end.p, v), path.length, kBar * path.length);
  }
  EXPECT_GT(crossings, 10);
}

TEST_P(Crease, TracesAgreeWithTheSecondMethodAndSpreadAsItsNeighbours) {
  TraceOptions options;
  options.tolerance = 1e-14;
  for (int i = 0; i < 10; ++i) {
    const Uv p = left();
    const UvVec d = heading(whole_, p, uniform(random_, -0.9, 0.9));
    const TraceResult path = trace_geodesic(whole_, p, d, 0.8, options);
    if (path.status != TraceStatus::Converged) continue;
    QuadEnd truth = quad_geodesic(quad_, p, d, Float128(0.8));
    truth.y = neighbours_spread(quad_, p, d, Float128(0.8));
    const TraceErrors e = errors_of(quad_, truth, path.end);
    EXPECT_LT(e.place, kBar);
    EXPECT_LT(e.direction, kBar);
    EXPECT_LT(e.y, kBar);
  }
}

TEST_P(Crease, DistancesAreTheLeastLengths) {
  for (int i = 0; i < 10; ++i) {
    const Uv p = left(), q = random_point(random_, {{1.1, 1.5}, {0.6, 1.4}});
    const Connection c = distance(whole_, p, q).shortest;
    ASSERT_EQ(c.status, ConnectStatus::Converged);
    const double v = lerp(p, q, (1.0 - p.u) / (q.u - p.u)).v;
    EXPECT_NEAR(c.length, least_length(left_, right_, p, q, v), kBar * c.length);
  }
}

}  // namespace
}  // namespace geovor
