// Whole Voronoi diagrams of random sites on the wave, and beside them a method on a triangle mesh of it.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <optional>

#include "benches.h"
#include "brep/face_domain.h"
#include "counting_surface.h"
#include "geodesic/connect.h"
#include "mesh_paths.h"
#include "surface/analytic_surfaces.h"
#include "table.h"
#include "voronoi/diagram_builder.h"
#include "voronoi/nearby_sites.h"
#include "voronoi/path_checks.h"

namespace geovor::bench {
namespace {

const UvBox kBox{{-3, 3}, {-3, 3}};
constexpr double kDeflection = 1e-6;

// Runs of each problem, of which the median counts.
constexpr int kRuns = 3;

// The bars: seconds, growth exponent, times faster and more exact than the mesh.
struct Case {
  int sites;
  double seconds;
};
constexpr Case kCases[] = {{50, 0.1}, {1000, 0.4}, {10000, 4.0}};
constexpr double kGrowthBar = 1.1;

// 131,072 triangles.
constexpr int kMeshCells = 256;
constexpr int kMeshSites = 50;

// Of the mesh's points those are compared whose number is a multiple of this.
constexpr int kEvery = 37;

FaceDomain whole(SurfacePtr surface) {
  CadModel model;
  model.faces.emplace_back();
  model.faces[0].surface = std::move(surface);
  model.faces[0].number = 1;
  return {model, model.faces[0], kDeflection};
}

struct Built {
  VoronoiDiagram diagram;
  double seconds = 0.0;
  long evaluations = 0;
};

VoronoiOptions plain() {
  VoronoiOptions options;
  options.measure = false;
  return options;
}

Built build(const std::vector<Uv>& sites) {
  const WaveSurface wave(kBox);
  const auto counted = std::make_shared<CountingSurface>(wave);
  const FaceDomain counting = whole(counted), domain = whole(std::make_shared<WaveSurface>(kBox));
  counted->reset();
  Built built{build_diagram(counting, sites, plain()), 0.0, counted->count()};
  std::vector<double> times;
  for (int run = 0; run < kRuns; ++run) {
    const std::clock_t start = std::clock();
    keep(build_diagram(domain, sites, plain()));
    times.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::nth_element(times.begin(), times.begin() + kRuns / 2, times.end());
  built.seconds = times[kRuns / 2];
  recompute_residuals(wave, built.diagram);
  return built;
}

// Coordinates are known to some units of their last place, however short the distances are.
constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();

/// The largest relative difference of the distances that are equal by right, less what the rounding of a point's own
/// coordinates makes of it.
double largest_residual(const VoronoiDiagram& diagram) {
  double most = 0.0;
  const auto take = [&](double residual, const Xyz& x, double radius) {
    most = std::max(most, residual - kRounding * x.norm() / radius);
  };
  for (const DiagramVertex& v : diagram.vertices) take(v.residual, v.xyz, v.radius);
  for (const DiagramEdge& e : diagram.edges) {
    const auto nearest = std::min_element(e.points.begin(), e.points.end(),
                                          [](const auto& p, const auto& q) { return p.radius < q.radius; });
    take(e.residual, nearest->xyz, nearest->radius);
  }
  return most;
}

std::string exponent(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", x);
  return text;
}

struct Errors {
  std::vector<double> relative;  ///< ascending
  double median() const { return relative[relative.size() / 2]; }
  double most() const { return relative.back(); }
};

// Of the mesh's distances against those of the surface, where the shortest way stays in the box.
Errors errors_of(const std::vector<Uv>& sites, const std::vector<Uv>& points, const MeshDistances& mesh) {
  const WaveSurface wave(kBox);
  const SiteRays rays(wave, sites);
  const NearbySites nearby(rays);
  Errors errors;
  for (size_t i = 0; i < points.size(); i += kEvery) {
    const auto nearest = nearby.nearest(points[i]);
    if (nearest.empty() || !(nearest.front().polar.s > 0.0)) continue;
    const Connection c = connect(wave, sites[nearest.front().site], points[i], nearest.front().polar);
    if (c.status != ConnectStatus::Converged || c.leaves_domain) continue;
    errors.relative.push_back(std::abs(mesh.to_nearest[i] / c.length - 1.0));
  }
  std::sort(errors.relative.begin(), errors.relative.end());
  return errors;
}

void beside_a_mesh(const std::vector<Uv>& sites, const Built& ours) {
  const WaveSurface wave(kBox);
  MeshProblem problem;
  problem.cells = kMeshCells;
  const double du = kBox.u.length() / kMeshCells, dv = kBox.v.length() / kMeshCells;
  std::vector<Uv> points;
  for (int i = 0; i <= kMeshCells; ++i) {
    for (int j = 0; j <= kMeshCells; ++j) {
      points.push_back({kBox.u.lo + i * du, kBox.v.lo + j * dv});
      const Xyz x = wave.position(points.back());
      problem.points.push_back({x.x(), x.y(), x.z()});
    }
  }
  for (const Uv p : sites) {
    const double x = (p.u - kBox.u.lo) / du, y = (p.v - kBox.v.lo) / dv;
    const int i = std::min(static_cast<int>(x), kMeshCells - 1), j = std::min(static_cast<int>(y), kMeshCells - 1);
    problem.sources.push_back({i, j, x - i, y - j});
  }
  const MeshDistances mesh = mesh_distances(problem);
  if (!mesh.done) {
    std::puts("CGAL is absent: no comparison with Surface_mesh_shortest_path\n");
    return;
  }
  const Errors errors = errors_of(sites, points, mesh);
  const double seconds = mesh.tree_seconds + mesh.distance_seconds, residual = largest_residual(ours.diagram);
  print_table("The same " + std::to_string(sites.size()) + " sites by CGAL's Surface_mesh_shortest_path on " +
                  std::to_string(mesh.triangles) +
                  " triangles (sequence tree, then distances at all points: a diagram has still to be had from them), "
                  "errors of "
                  "distances against the surface's",
              {{"", "time s", "times ours", "largest error", "median", "times our residual"},
               {"geovor, the diagram", digits(ours.seconds, 4), "1", exponent(residual), "", "1"},
               {"mesh, distances", digits(seconds, 2), digits(seconds / ours.seconds, 0), exponent(errors.most()),
                exponent(errors.median()), exponent(errors.most() / residual)}});
}

}  // namespace

void bench_diagrams() {
  std::vector<Row> rows{{"sites", "time s", "bar", "vertices", "edges", "points", "evaluations", "a site", "residual",
                         "warnings", "growth", "bar"}};
  std::optional<Built> first, last;
  for (const Case& c : kCases) {
    const Built built = build(random_points(kBox, c.sites));
    size_t points = 0;
    for (const DiagramEdge& e : built.diagram.edges) points += e.points.size();
    const double growth = last ? std::log(built.seconds / last->seconds) /
                                     std::log(1.0 * built.diagram.sites.size() / last->diagram.sites.size())
                               : 0.0;
    rows.push_back({std::to_string(c.sites), digits(built.seconds, 3), digits(c.seconds, 1),
                    std::to_string(built.diagram.vertices.size()), std::to_string(built.diagram.edges.size()),
                    std::to_string(points), std::to_string(built.evaluations),
                    digits(1.0 * built.evaluations / c.sites, 0), exponent(largest_residual(built.diagram)),
                    std::to_string(built.diagram.warnings.size()), last ? digits(growth, 2) : "",
                    last ? digits(kGrowthBar, 1) : ""});
    if (!first && c.sites == kMeshSites) first = built;
    last = built;
  }
  print_table(
      "Voronoi diagrams of random sites on z = sin u cos v, [-3, 3]^2, one thread, all vertices and edges; median of " +
          std::to_string(kRuns) + " runs; the residual comes from rays shot anew",
      rows);
  if (first) beside_a_mesh(random_points(kBox, kMeshSites), *first);
}

}  // namespace geovor::bench
