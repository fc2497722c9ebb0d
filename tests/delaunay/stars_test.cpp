#include "delaunay/stars.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <set>

#include "delaunay/close_gaps.h"

namespace geovor {
namespace {

MeshVertex flat_vertex(double x, double y, double h) {
  return {{x, y, 0}, Xyz::UnitZ(), h, -1, {{x, y}}, false, false};
}

/// Points of the unit sphere, not nearer than `apart`, by throwing darts.
std::vector<MeshVertex> darts_on_sphere(double apart, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<MeshVertex> points;
  for (int miss = 0; miss < 3000;) {
    const Xyz x = Xyz(normal(random), normal(random), normal(random)).normalized();
    bool is_free = true;
    for (const MeshVertex& p : points) is_free = is_free && (p.x - x).norm() > apart;
    miss = is_free ? 0 : miss + 1;
    if (is_free) points.push_back({x, x, apart, -1, {{0, 0}}, false, false});
  }
  return points;
}

// On a sphere the Delaunay triangulation is the convex hull.
TEST(TriangulateByStars, OnASphereIsTheConvexHull) {
  const auto points = darts_on_sphere(0.15, 5);
  const auto mesh = triangulate_by_stars(points, {}, 0.15);
  ASSERT_TRUE(mesh.has_value());
  EXPECT_EQ(mesh->triangle_count(), 2 * static_cast<int>(points.size()) - 4);
  for (int t = 0; t < mesh->triangle_count(); ++t) {
    const auto [a, b, c] = mesh->corners(t);
    const Xyz n = (points[b].x - points[a].x).cross(points[c].x - points[a].x).normalized();
    for (const MeshVertex& p : points) EXPECT_LT(n.dot(p.x - points[a].x), 1e-4);
  }
}

MeshBorder square_border(std::vector<MeshVertex>& points, int n, double h) {
  MeshBorder border;
  const double side = n * h;
  for (int i = 0; i < n; ++i) points.push_back(flat_vertex(i * h, 0, h));
  for (int i = 0; i < n; ++i) points.push_back(flat_vertex(side, i * h, h));
  for (int i = 0; i < n; ++i) points.push_back(flat_vertex(side - i * h, side, h));
  for (int i = 0; i < n; ++i) points.push_back(flat_vertex(0, side - i * h, h));
  const int m = static_cast<int>(points.size());
  border.points = points;
  for (int i = 0; i < m; ++i) {
    border.points[i].border = i;
    border.next.push_back((i + 1) % m);
    border.before.push_back((i + m - 1) % m);
  }
  border.is_tip.assign(m, 0);
  border.is_one_of_many.assign(m, 0);
  return border;
}

// Four points of each square are on one circle: the stars have to agree on one of the diagonals.
TEST(TriangulateByStars, AgreesOnALatticeOfSquares) {
  const int n = 12;
  std::vector<MeshVertex> points;
  const MeshBorder border = square_border(points, n, 0.5);
  for (int i = 1; i < n; ++i) {
    for (int k = 1; k < n; ++k) points.push_back(flat_vertex(0.5 * i, 0.5 * k, 0.5));
  }
  const auto mesh = triangulate_by_stars(points, border, 0.5);
  ASSERT_TRUE(mesh.has_value());
  EXPECT_EQ(mesh->triangle_count(), 2 * n * n);
}

// Darts whose size is a tenth at one corner: circles there reach much farther than the smallest sizes.
TEST(TriangulateByStars, HasEmptyCirclesWhereSizesDiffer) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.02, 5.98);
  std::vector<MeshVertex> points;
  const MeshBorder border = square_border(points, 12, 0.5);
  for (int miss = 0; miss < 4000;) {
    const double x = uniform(random), y = uniform(random), h = 0.05 + 0.15 * std::hypot(x, y);
    bool is_free = std::min({x, y, 6.0 - x, 6.0 - y}) > 0.2;
    for (const MeshVertex& p : points) is_free = is_free && std::hypot(p.x[0] - x, p.x[1] - y) > h;
    miss = is_free ? 0 : miss + 1;
    if (is_free) points.push_back(flat_vertex(x, y, h));
  }
  const auto mesh = triangulate_by_stars(points, border, 0.5);
  ASSERT_TRUE(mesh.has_value());
  for (int t = 0; t < mesh->triangle_count(); ++t) {
    const auto [a, b, c] = mesh->corners(t);
    const Xyz p = points[b].x - points[a].x, q = points[c].x - points[a].x, n = p.cross(q);
    EXPECT_GT(n[2], 0.0);
    const Xyz m = (p.squaredNorm() * q.cross(n) + q.squaredNorm() * n.cross(p)) / (2.0 * n.squaredNorm());
    for (const MeshVertex& v : points) EXPECT_GT((v.x - points[a].x - m).norm(), m.norm() - 1e-9);
  }
}

// A fan of six triangles about the origin; two of them are not known.
TEST(CloseGaps, CutsEarsFromAGap) {
  std::vector<MeshVertex> points = {};
  MeshBorder border;
  for (int i = 0; i < 6; ++i) {
    points.push_back(flat_vertex(std::cos(i * 1.0471975512), std::sin(i * 1.0471975512), 1.0));
    border.next.push_back((i + 1) % 6);
    border.before.push_back((i + 5) % 6);
  }
  border.points = points;
  border.is_tip.assign(6, 0);
  border.is_one_of_many.assign(6, 0);
  points.push_back(flat_vertex(0, 0, 1.0));
  const std::vector<std::array<int, 3>> certain = {{6, 0, 1}, {6, 2, 3}, {6, 3, 4}, {6, 4, 5}};
  const auto mesh = close_gaps(points, border, certain, {});
  ASSERT_TRUE(mesh.has_value());
  std::set<std::array<int, 3>> found;
  for (int t = 0; t < mesh->triangle_count(); ++t) {
    auto corners = mesh->corners(t);
    std::sort(corners.begin(), corners.end());
    found.insert(corners);
  }
  const std::set<std::array<int, 3>> whole = {{0, 1, 6}, {1, 2, 6}, {2, 3, 6}, {3, 4, 6}, {4, 5, 6}, {0, 5, 6}};
  EXPECT_EQ(found, whole);
}

TEST(CloseGaps, TellsThatASurfaceIsNotWhole) {
  const auto points = darts_on_sphere(0.5, 1);
  const auto mesh = triangulate_by_stars(points, {}, 0.5);
  ASSERT_TRUE(mesh.has_value());
  std::vector<std::array<int, 3>> twice;
  for (int t = 0; t < mesh->triangle_count(); ++t) twice.push_back(mesh->corners(t));
  // The same sphere once more beside the first: two surfaces.
  auto both = points;
  for (MeshVertex p : points) {
    p.x += Xyz(5, 0, 0);
    both.push_back(p);
  }
  const int n = static_cast<int>(points.size());
  for (int t = 0; t < mesh->triangle_count(); ++t) {
    const auto [a, b, c] = mesh->corners(t);
    twice.push_back({a + n, b + n, c + n});
  }
  EXPECT_FALSE(close_gaps(both, {}, twice, {}).has_value());
}

}  // namespace
}  // namespace geovor
