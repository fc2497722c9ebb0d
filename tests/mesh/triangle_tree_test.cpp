#include "mesh/triangle_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace geovor {
namespace {

Xyz random_point(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> in(-size, size);
  const double x = in(random), y = in(random);
  return {x, y, in(random)};
}

// Second method: the smallest distance over a fine grid of barycentric coordinates, which is above the true one by at
// most the distance between neighbours of the grid.
double distance_on_grid(const Xyz& a, const Xyz& b, const Xyz& c, const Xyz& x, int n) {
  double least = 1e300;
  for (int i = 0; i <= n; ++i) {
    for (int k = 0; i + k <= n; ++k) {
      const double p = double(i) / n, q = double(k) / n;
      least = std::min(least, (a + p * (b - a) + q * (c - a) - x).norm());
    }
  }
  return least;
}

TEST(NearestOnTriangle, IsAsNearAsTheBestOfAFineGrid) {
  std::mt19937 random(1);
  constexpr int kGrid = 60;
  for (int i = 0; i < 300; ++i) {
    const Xyz a = random_point(random, 1), b = random_point(random, 1), c = random_point(random, 1);
    const Xyz x = random_point(random, 3);
    const double ours = (nearest_on_triangle(a, b, c, x) - x).norm(), grid = distance_on_grid(a, b, c, x, kGrid);
    EXPECT_LE(ours, grid + 1e-12);
    EXPECT_GE(ours, grid - ((b - a).norm() + (c - a).norm()) / kGrid);
  }
}

TEST(NearestOnTriangle, HoldsForSegmentsAndPoints) {
  EXPECT_EQ(nearest_on_triangle({0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1.5, 1, 0}), Xyz(1.5, 0, 0));
  EXPECT_EQ(nearest_on_triangle({1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {9, 9, 9}), Xyz(1, 2, 3));
}

TEST(TriangleTree, FindsWhatLookingAtEveryTriangleFinds) {
  std::mt19937 random(2);
  TriangleMesh mesh;
  for (int t = 0; t < 400; ++t) {
    const Xyz at = random_point(random, 10);
    for (int k = 0; k < 3; ++k) mesh.points.push_back(at + random_point(random, 1));
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const TriangleTree tree(mesh);
  for (int i = 0; i < 400; ++i) {
    const Xyz x = random_point(random, 15);
    double least = 1e300;
    for (const auto& [a, b, c] : mesh.triangles) {
      least = std::min(least, (nearest_on_triangle(mesh.points[a], mesh.points[b], mesh.points[c], x) - x).norm());
    }
    EXPECT_EQ(tree.nearest(x).distance, least);
  }
}

TEST(TriangleTree, WithoutTrianglesFindsNone) {
  const TriangleMesh mesh;
  EXPECT_EQ(TriangleTree(mesh).nearest({0, 0, 0}).triangle, -1);
}

}  // namespace
}  // namespace geovor
