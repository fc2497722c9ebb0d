// What diagrams are made of: rays of sites, points of bisectors, vertices.
#include <cmath>
#include <functional>
#include <numbers>

#include "benches.h"
#include "counting_surface.h"
#include "surface/analytic_surfaces.h"
#include "surface/forms.h"
#include "table.h"
#include "voronoi/bisector.h"
#include "voronoi/vertex_solver.h"

namespace geovor::bench {
namespace {

const UvBox kBox{{-3, 3}, {-3, 3}};
constexpr int kTriples = 256;
constexpr int kRays = 256;

double cross2(Uv a, Uv b, Uv c) { return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u); }

Uv circumcentre(Uv a, Uv b, Uv c) {
  const double bu = b.u - a.u, bv = b.v - a.v, cu = c.u - a.u, cv = c.v - a.v;
  const double b2 = bu * bu + bv * bv, c2 = cu * cu + cv * cv, d = 2.0 * (bu * cv - bv * cu);
  return {a.u + (cv * b2 - bv * c2) / d, a.v + (bu * c2 - cu * b2) / d};
}

double distance2(Uv a, Uv b) { return (a.u - b.u) * (a.u - b.u) + (a.v - b.v) * (a.v - b.v); }

struct Triple {
  std::array<int, 3> site;
  Uv centre;
};

// Triangles of the sites' Delaunay triangulation in the parameter plane, each from a site and its nearest neighbour,
// whose circumcentre lies in the box: what a vertex of the diagram is guessed from.
std::vector<Triple> triples(const std::vector<Uv>& sites) {
  std::vector<Triple> found;
  const int n = static_cast<int>(sites.size());
  for (int a = 0; a < n && static_cast<int>(found.size()) < kTriples; ++a) {
    int b = a == 0 ? 1 : 0, c = -1;
    for (int i = 0; i < n; ++i)
      if (i != a && distance2(sites[a], sites[i]) < distance2(sites[a], sites[b])) b = i;
    const auto inside = [&](int i) {
      return distance2(circumcentre(sites[a], sites[b], sites[c]), sites[i]) <
             distance2(circumcentre(sites[a], sites[b], sites[c]), sites[a]);
    };
    for (int i = 0; i < n; ++i)
      if (i != a && i != b && cross2(sites[a], sites[b], sites[i]) > 0.0 && (c < 0 || inside(i))) c = i;
    if (c < 0) continue;
    const Uv m = circumcentre(sites[a], sites[b], sites[c]);
    const bool in_box = std::abs(m.u) < kBox.u.hi && std::abs(m.v) < kBox.v.hi;
    if (in_box) found.push_back({{a, b, c}, m});
  }
  return found;
}

struct VertexGuess {
  std::array<PolarGuess, 3> aims;
  double radius = 0.0;
};

// Straight lines of the parameter plane, measured at their starts.
VertexGuess guess_of(const Surface& surface, const std::vector<Uv>& sites, const Triple& triple) {
  VertexGuess guess;
  for (int i = 0; i < 3; ++i) {
    const SurfaceJet j = surface.jet(sites[triple.site[i]]);
    const UvVec way = triple.centre - sites[triple.site[i]];
    guess.aims[i] = {triple.site[i], angle_of_direction(j, way)};
    guess.radius += norm(j, way) / 3.0;
  }
  return guess;
}

/// Time and evaluations of a call, the mean over `calls` of them.
struct Cost {
  double us, evaluations;
};

Cost cost(const CountingSurface& counted, int calls, const std::function<void(const Surface&)>& pass_counted,
          const std::function<void()>& pass) {
  const long before = counted.count();
  pass_counted(counted);
  return {race({{pass, calls}})[0] * 1e-3, static_cast<double>(counted.count() - before) / calls};
}

void bench_vertices(const WaveSurface& wave) {
  struct Case {
    int sites, evaluations;
    double us;
  };
  std::vector<Row> rows{{"sites", "vertices", "evaluations", "bar", "time µs", "bar", "failed"}};
  for (const Case& c : {Case{100, 546, 31.0}, Case{1000, 247, 15.0}, Case{10000, 143, 7.4}}) {
    const std::vector<Uv> sites = random_points(kBox, c.sites);
    const CountingSurface counted(wave);
    const SiteRays rays(wave, sites), counting(counted, sites);
    std::vector<VertexGuess> guesses;
    for (const Triple& t : triples(sites)) guesses.push_back(guess_of(wave, sites, t));
    int failed = 0;
    const auto solve = [&](const SiteRays& with, bool count) {
      for (const VertexGuess& g : guesses) {
        const auto v = solve_vertex(with, g.aims, g.radius);
        keep(v);
        failed += count && !v;
      }
    };
    const Cost spent = cost(
        counted, static_cast<int>(guesses.size()), [&](const Surface&) { solve(counting, true); },
        [&] { solve(rays, false); });
    rows.push_back({std::to_string(c.sites), std::to_string(guesses.size()), digits(spent.evaluations, 0),
                    std::to_string(c.evaluations), digits(spent.us, 1), digits(c.us, 1), std::to_string(failed)});
  }
  print_table(
      "A Voronoi vertex of random sites on z = sin u cos v from a rough guess (the circumcentre in the parameter "
      "plane)",
      rows);
}

// The step along an edge between stored points, in radii, and how far off a predictor leaves it.
constexpr double kMisses[] = {1e-2, 1e-4, 1e-6};

void bench_edge_points(const WaveSurface& wave) {
  std::vector<Row> rows{{"sites", "predicted to", "evaluations", "time µs", "failed"}};
  for (const int n : {100, 1000, 10000}) {
    const std::vector<Uv> sites = random_points(kBox, n);
    const CountingSurface counted(wave);
    const SiteRays rays(wave, sites), counting(counted, sites);
    std::vector<BisectorPoint> points;
    for (const Triple& t : triples(sites)) {
      const VertexGuess g = guess_of(wave, sites, t);
      if (const auto v = solve_vertex(rays, g.aims, g.radius)) points.push_back({(*v)[0], (*v)[1]});
    }
    for (const double miss : kMisses) {
      int failed = 0;
      const auto solve = [&](const SiteRays& with, bool count) {
        for (const BisectorPoint& m : points) {
          const Xyz t = m.tangent();
          BisectorCoordinates guess = coordinates(m);
          guess.radius *= 1.0 + miss;
          const auto found = correct_bisector(with, m.left.site, m.right.site, guess, {t, t.dot(m.position())}, miss);
          keep(found);
          failed += count && !found;
        }
      };
      const Cost spent = cost(
          counted, static_cast<int>(points.size()), [&](const Surface&) { solve(counting, true); },
          [&] { solve(rays, false); });
      char off[16];
      std::snprintf(off, sizeof off, "%.0e", miss);
      rows.push_back(
          {std::to_string(n), off, digits(spent.evaluations, 0), digits(spent.us, 1), std::to_string(failed)});
    }
  }
  print_table("A point of an edge, both distances to 1e-12, from a predictor that is off by so much of the radius",
              rows);
}

void bench_rays(const WaveSurface& wave) {
  const std::vector<Uv> sites = random_points(kBox, kRays);
  const CountingSurface counted(wave);
  const SiteRays rays(wave, sites), counting(counted, sites);
  std::vector<Row> rows{{"length", "at: evaluations", "time µs", "to: evaluations", "time µs", "failed"}};
  for (const double s : {0.02, 0.05, 0.1, 0.5, 1.0}) {
    std::vector<SiteRay> ends;
    for (int i = 0; i < kRays; ++i)
      if (const auto ray = rays.at(i, {s, 2.0 * std::numbers::pi * i / kRays})) ends.push_back(*ray);
    int failed = kRays - static_cast<int>(ends.size());
    const auto at = [&](const SiteRays& with) {
      for (const SiteRay& e : ends) keep(with.at(e.site, e.polar));
    };
    // From a guess that is as far off as one carried over a tenth of the length.
    const auto to = [&](const SiteRays& with, bool count) {
      for (const SiteRay& e : ends) {
        const auto found = with.to(e.site, e.uv, Polar{1.01 * e.polar.s, e.polar.t + 0.01});
        keep(found);
        failed += count && !found;
      }
    };
    const int calls = static_cast<int>(ends.size());
    const Cost a = cost(
        counted, calls, [&](const Surface&) { at(counting); }, [&] { at(rays); });
    const Cost b = cost(
        counted, calls, [&](const Surface&) { to(counting, true); }, [&] { to(rays, false); });
    rows.push_back({digits(s, 2), digits(a.evaluations, 0), digits(a.us, 2), digits(b.evaluations, 0), digits(b.us, 2),
                    std::to_string(failed)});
  }
  print_table("Rays of a site on z = sin u cos v: O(s,t), and the ray to a point from a guess that is off by 1 %",
              rows);
}

}  // namespace

void bench_bisectors() {
  const WaveSurface wave({{-10, 10}, {-10, 10}});
  bench_rays(wave);
  bench_edge_points(wave);
  bench_vertices(wave);
}

}  // namespace geovor::bench
