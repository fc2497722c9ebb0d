#include "mesh_paths.h"

#ifdef GEOVOR_BENCH_CGAL
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <ctime>
#endif

namespace geovor::bench {

#ifndef GEOVOR_BENCH_CGAL

MeshDistances mesh_distances(const MeshProblem&) { return {}; }

#else
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Paths = CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh> >;

double seconds_since(std::clock_t start) { return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC; }

int index(const MeshProblem& p, int i, int j) { return i * (p.cells + 1) + j; }

Mesh mesh_of(const MeshProblem& p) {
  Mesh mesh;
  for (const auto& x : p.points) mesh.add_vertex({x[0], x[1], x[2]});
  const auto vertex = [&](int i, int j) { return Mesh::Vertex_index(index(p, i, j)); };
  // The triangles 2 (i cells + j) below and 2 (i cells + j) + 1 above the diagonal of cell (i, j).
  for (int i = 0; i < p.cells; ++i) {
    for (int j = 0; j < p.cells; ++j) {
      mesh.add_face(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
      mesh.add_face(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  }
  return mesh;
}

// Barycentric coordinates belong to the corners from the source of the face's halfedge on.
Paths::Face_location location(const Mesh& mesh, const MeshProblem& p, const MeshProblem::Source& s) {
  const bool below = s.x >= s.y;
  const Mesh::Face_index face(2 * (s.i * p.cells + s.j) + (below ? 0 : 1));
  const auto weight = [&](int corner) {
    if (corner == index(p, s.i, s.j)) return 1.0 - std::max(s.x, s.y);
    if (corner == index(p, s.i + 1, s.j + 1)) return std::min(s.x, s.y);
    return std::abs(s.x - s.y);
  };
  const auto h = mesh.halfedge(face);
  return {face,
          {weight(static_cast<int>(mesh.source(h))), weight(static_cast<int>(mesh.target(h))),
           weight(static_cast<int>(mesh.target(mesh.next(h))))}};
}

}  // namespace

MeshDistances mesh_distances(const MeshProblem& problem) {
  const Mesh mesh = mesh_of(problem);
  MeshDistances result;
  result.triangles = static_cast<int>(mesh.number_of_faces());
  Paths paths(mesh);
  for (const auto& s : problem.sources) {
    const auto place = location(mesh, problem, s);
    paths.add_source_point(place.first, place.second);
  }
  std::clock_t start = std::clock();
  paths.build_sequence_tree();
  result.tree_seconds = seconds_since(start);
  start = std::clock();
  for (const auto v : mesh.vertices()) result.to_nearest.push_back(paths.shortest_distance_to_source_points(v).first);
  result.distance_seconds = seconds_since(start);
  result.done = true;
  return result;
}

#endif

}  // namespace geovor::bench
