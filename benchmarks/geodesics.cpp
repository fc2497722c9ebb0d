// One initial-value geodesic with its Jacobi field.
#include <numbers>

#include "benches.h"
#include "geodesic/trace.h"
#include "surface/analytic_surfaces.h"
#include "table.h"

namespace geovor::bench {
namespace {

constexpr int kStarts = 1024;
constexpr double kTolerance = 1e-13;
constexpr double kKnotStep = 0.5;
const Interval kPeriod{-std::numbers::pi, std::numbers::pi};
const UvBox kStartBox{kPeriod, kPeriod};

struct Case {
  double length;
  int bar;  // evaluations on the smooth surface
};
constexpr Case kCases[] = {{0.1, 20}, {0.5, 90}, {2.0, 340}};
constexpr double kSplineBar = 2.2;

struct Start {
  Uv p;
  UvVec d;
};

std::vector<Start> starts() {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> angle(0.0, 2.0 * std::numbers::pi);
  std::vector<Start> all;
  for (const Uv p : random_points(kStartBox, kStarts)) {
    const double a = angle(random);
    all.push_back({p, {std::cos(a), std::sin(a)}});
  }
  return all;
}

struct Count {
  double mean = 0.0;
  int most = 0;
  int failed = 0;
};

TraceResult trace(const Surface& surface, const Start& start, double length) {
  TraceOptions options;
  options.tolerance = kTolerance;
  return trace_geodesic(surface, start.p, start.d, length, options);
}

Count evaluations(const Surface& surface, double length) {
  Count count;
  for (const Start& start : starts()) {
    const TraceResult r = trace(surface, start, length);
    count.mean += static_cast<double>(r.evaluations) / kStarts;
    count.most = std::max(count.most, r.evaluations);
    count.failed += r.status != TraceStatus::Converged;
  }
  return count;
}

Contender traces(const Surface& surface, double length) {
  return {[&surface, length, all = starts()] {
            for (const Start& start : all) keep(trace(surface, start, length));
          },
          kStarts};
}

}  // namespace

void bench_geodesics() {
  const UvBox box{{-6, 6}, {-6, 6}};
  const WaveSurface wave(box);
  const BSplineSurface spline = cubic_wave(box.u.hi, kKnotStep).surface();
  std::vector<Row> rows{{"length", "evaluations", "bar", "most", "time µs", "spline evaluations", "most", "time µs",
                         "ratio of evaluations", "bar", "failed"}};
  for (const Case& c : kCases) {
    const Count smooth = evaluations(wave, c.length), knotted = evaluations(spline, c.length);
    const std::vector<double> t = race({traces(wave, c.length), traces(spline, c.length)});
    rows.push_back({digits(c.length, 1), digits(smooth.mean, 1), std::to_string(c.bar), std::to_string(smooth.most),
                    digits(t[0] * 1e-3, 2), digits(knotted.mean, 1), std::to_string(knotted.most),
                    digits(t[1] * 1e-3, 2), digits(knotted.mean / smooth.mean, 2), digits(kSplineBar, 1),
                    std::to_string(smooth.failed + knotted.failed)});
  }
  print_table(
      "One geodesic to 1e-13 on z = sin u cos v, and on a bicubic C2 spline of it with knots 0.5 apart; mean of " +
          std::to_string(kStarts) + " random starts",
      rows);
}

}  // namespace geovor::bench
