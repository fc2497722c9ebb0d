// Distances over a triangle mesh by CGAL's Surface_mesh_shortest_path, for comparison.
#pragma once

#include <array>
#include <vector>

namespace geovor::bench {

/// The graph of a height over a square of cells cut in two, with sources on it.
struct MeshProblem {
  int cells = 0;                              ///< along a side
  std::vector<std::array<double, 3>> points;  ///< (cells + 1)^2, v runs first
  struct Source {
    int i, j;     ///< its cell
    double x, y;  ///< its place in the cell, 0 to 1
  };
  std::vector<Source> sources;
};

struct MeshDistances {
  bool done = false;  ///< false in a build without CGAL
  int triangles = 0;
  double tree_seconds = 0.0;       ///< to build the sequence tree of all sources
  double distance_seconds = 0.0;   ///< for the distances of all points
  std::vector<double> to_nearest;  ///< of each point
};

MeshDistances mesh_distances(const MeshProblem& problem);

}  // namespace geovor::bench
