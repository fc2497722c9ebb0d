// The distance between two points.
#include <cmath>
#include <numbers>

#include "benches.h"
#include "geodesic/distance.h"
#include "geodesic/trace.h"
#include "surface/analytic_surfaces.h"
#include "table.h"

namespace geovor::bench {
namespace {

constexpr int kPairs = 64;
const UvBox kStartBox{{-3, 3}, {-3, 3}};

struct Case {
  double d;
  const char* bar;  // µs
};
constexpr Case kCases[] = {{0.01, ""}, {0.1, "3"}, {0.3, ""}, {1.0, "25"}, {2.0, ""}};

struct Pair {
  Uv from, to;
};

// Ends of geodesics of length d: where it is the shortest, d is the distance.
std::vector<Pair> pairs_at(const Surface& surface, double d) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> angle(0.0, 2.0 * std::numbers::pi);
  std::vector<Pair> pairs;
  for (const Uv p : random_points(kStartBox, kPairs)) {
    const double a = angle(random);
    pairs.push_back({p, trace_geodesic(surface, p, {std::cos(a), std::sin(a)}, d).end.p});
  }
  return pairs;
}

struct Found {
  bool converged;
  int evaluations;
};

struct Way {
  const char* name;
  Found (*find)(const DistanceFinder&, const Pair&);
};

Found found(const DistanceResult& r) { return {r.shortest.status == ConnectStatus::Converged, r.evaluations}; }

const Way kWays[] = {
    {"connect",
     [](const DistanceFinder& f, const Pair& p) -> Found {
       const Connection c = connect(f.surface(), p.from, p.to);
       return {c.status == ConnectStatus::Converged, c.evaluations};
     }},
    {"DistanceFinder", [](const DistanceFinder& f, const Pair& p) { return found(f.distance(p.from, p.to)); }},
    {"distance", [](const DistanceFinder& f, const Pair& p) { return found(distance(f.surface(), p.from, p.to)); }},
};

Row row_of(const DistanceFinder& finder, const Case& c, const Way& way, double jet) {
  const std::vector<Pair> pairs = pairs_at(finder.surface(), c.d);
  double evaluations = 0.0;
  int failed = 0;
  for (const Pair& p : pairs) {
    const Found result = way.find(finder, p);
    evaluations += static_cast<double>(result.evaluations) / kPairs;
    failed += !result.converged;
  }
  const Contender contender{[&] {
                              for (const Pair& p : pairs) keep(way.find(finder, p));
                            },
                            kPairs};
  const double ns = race({contender})[0];
  return {digits(c.d, 2),        way.name, digits(ns * 1e-3, 2), c.bar, digits(evaluations, 0), digits(ns / jet, 0),
          std::to_string(failed)};
}

}  // namespace

void bench_distances() {
  const WaveSurface wave({{-10, 10}, {-10, 10}});
  const auto points = random_points(wave.domain(), 1000);
  const double jet = race({{[&] {
                              for (const Uv p : points) keep(wave.jet(p));
                            },
                            static_cast<int>(points.size())}})[0];
  const DistanceFinder finder(wave);
  std::vector<Row> rows{{"distance", "by", "time µs", "bar", "evaluations", "in jets", "failed"}};
  for (const Way& way : kWays)
    for (const Case& c : kCases) rows.push_back(row_of(finder, c, way, jet));
  print_table(
      "Two points to 1e-12 on z = sin u cos v, cold: nothing known of the pair (a DistanceFinder knows the surface); "
      "mean of " +
          std::to_string(kPairs) + " random pairs; one jet takes " + digits(jet, 1) + " ns",
      rows);
}

}  // namespace geovor::bench
