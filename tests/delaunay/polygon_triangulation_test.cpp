#include "delaunay/polygon_triangulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace geovor {
namespace {

using Loops = std::vector<std::vector<Uv>>;

std::vector<Uv> flat(const Loops& loops) {
  std::vector<Uv> all;
  for (const auto& loop : loops) all.insert(all.end(), loop.begin(), loop.end());
  return all;
}

double shoelace(const std::vector<Uv>& loop) {
  double twice = 0;
  for (size_t i = 0; i < loop.size(); ++i) {
    const Uv a = loop[i], b = loop[(i + 1) % loop.size()];
    twice += a.u * b.v - b.u * a.v;
  }
  return twice / 2;
}

// Every triangle is positive and the areas add up to the polygon's.
void expect_covers(const Loops& loops, const PolygonTriangulation& r) {
  ASSERT_TRUE(r.ok) << r.why;
  EXPECT_EQ(r.triangles.first_fault(), std::nullopt);
  const auto points = flat(loops);
  double sum = 0, area = 0;
  for (const auto& loop : loops) area += shoelace(loop);
  for (int t = 0; t < r.triangles.triangle_count(); ++t) {
    const auto [a, b, c] = r.triangles.corners(t);
    const double twice = cross(points[b] - points[a], points[c] - points[a]);
    EXPECT_GT(twice, 0);
    sum += twice / 2;
  }
  EXPECT_NEAR(sum, area, 1e-7 * area);
}

std::vector<Uv> circle(Uv c, double r, int n, bool clockwise) {
  std::vector<Uv> loop;
  for (int i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi * i / n * (clockwise ? -1 : 1);
    loop.push_back({c.u + r * std::cos(t), c.v + r * std::sin(t)});
  }
  return loop;
}

TEST(PolygonTriangulation, KeepsCollinearPointsOfASquaresSides) {
  std::vector<Uv> loop;
  for (int i = 0; i < 8; ++i) loop.push_back({i / 8.0, 0});
  for (int i = 0; i < 8; ++i) loop.push_back({1, i / 8.0});
  for (int i = 0; i < 8; ++i) loop.push_back({1 - i / 8.0, 1});
  for (int i = 0; i < 8; ++i) loop.push_back({0, 1 - i / 8.0});
  const auto r = triangulate_polygon({loop}, {}, 1.0);
  expect_covers({loop}, r);
  EXPECT_EQ(r.triangles.triangle_count(), 30);  // n - 2
}

TEST(PolygonTriangulation, LeavesHolesOpen) {
  const Loops loops = {circle({0, 0}, 1, 60, false), circle({0.4, 0}, 0.3, 25, true),
                       circle({-0.5, 0.1}, 0.2, 7, true)};
  const auto r = triangulate_polygon(loops, {}, 1.0);
  expect_covers(loops, r);
  EXPECT_EQ(r.triangles.triangle_count(), 60 + 25 + 7 - 2 + 2 * 2);  // n - 2 + 2 holes
}

TEST(PolygonTriangulation, TakesInnerPointsAndLeavesOutThoseOutsideOrOnTheBorder) {
  const Loops loops = {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{1, 1}, {1, 2}, {2, 2}, {2, 1}}};
  const std::vector<Uv> inner = {{3, 3}, {1.5, 1.5}, {3, 0}, {3, 3}, {0.5, 0.5}};
  const auto r = triangulate_polygon(loops, inner, 1.0);
  ASSERT_TRUE(r.ok) << r.why;
  std::vector<bool> used;
  for (int v = 8; v < 13; ++v) used.push_back(r.triangles.outgoing(v) != HalfEdges::kNone);
  EXPECT_EQ(used, (std::vector<bool>{true, false, false, false, true}));
  EXPECT_EQ(r.triangles.triangle_count(), 8 - 2 + 2 + 2 * 2);  // n - 2 + 2 holes, and two more for each inner point
}

TEST(PolygonTriangulation, HandlesACombWithThinTeeth) {
  std::vector<Uv> loop = {{0, 0}, {40, 0}};
  for (int i = 40; i > 0; --i) {
    loop.push_back({i - 0.499, 1e-6});
    loop.push_back({i - 0.501, 1});
    loop.push_back({i - 1.0 + 1e-3, 0.5});
  }
  const auto r = triangulate_polygon({loop}, {}, 40.0);
  expect_covers({loop}, r);
}

TEST(PolygonTriangulation, SaysWhereTheBorderCrossesItself) {
  const auto r = triangulate_polygon({{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}, {}, 1.0);
  EXPECT_FALSE(r.ok);
  EXPECT_FALSE(r.why.empty());
  EXPECT_EQ(r.bad_points.size(), 4u);
}

TEST(PolygonTriangulation, SaysThatPointsCoincide) {
  const auto r = triangulate_polygon({{{0, 0}, {1, 0}, {1, 0}, {0, 1}}}, {}, 1.0);
  EXPECT_FALSE(r.ok);
  EXPECT_EQ(r.why, "two points of its border coincide");
}

}  // namespace
}  // namespace geovor
