#include "mesh/mesh_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace geovor {
namespace {

using ::testing::HasSubstr;

TriangleMesh with_faces(TriangleMesh mesh) {
  mesh.face_of.assign(mesh.triangles.size(), 1);
  return mesh;
}

/// Corners of a cube: regular, edge 2 sqrt 2.
TriangleMesh tetrahedron() {
  return with_faces(
      {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}, {}});
}

/// Edge 2, centre at the origin.
TriangleMesh icosahedron() {
  const double g = std::numbers::phi;
  return with_faces({{{0, 1, g},
                      {0, -1, g},
                      {0, 1, -g},
                      {0, -1, -g},
                      {1, g, 0},
                      {-1, g, 0},
                      {1, -g, 0},
                      {-1, -g, 0},
                      {g, 0, 1},
                      {g, 0, -1},
                      {-g, 0, 1},
                      {-g, 0, -1}},
                     {{0, 1, 8}, {0, 8, 4},  {0, 4, 5},   {0, 5, 10},  {0, 10, 1}, {3, 2, 9}, {3, 9, 6},
                      {3, 6, 7}, {3, 7, 11}, {3, 11, 2},  {8, 1, 6},   {8, 6, 9},  {8, 9, 4}, {4, 9, 2},
                      {4, 2, 5}, {5, 2, 11}, {5, 11, 10}, {10, 11, 7}, {10, 7, 1}, {1, 7, 6}},
                     {}});
}

/// The unit square in two triangles.
TriangleMesh square() { return with_faces({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}, {}}); }

TEST(MeshTopology, OfClosedSolidsObeysEuler) {
  for (const TriangleMesh& mesh : {tetrahedron(), icosahedron()}) {
    const MeshTopology t = topology(mesh);
    EXPECT_EQ(t.euler(), 2);
    EXPECT_EQ(2 * t.edges, 3 * t.triangles);
    EXPECT_EQ(t.components, 1);
    EXPECT_TRUE(t.closed());
    EXPECT_EQ(first_fault(mesh), std::nullopt);
  }
}

TEST(MeshTopology, SeesTheRimOfAnOpenMesh) {
  const MeshTopology t = topology(square());
  EXPECT_EQ(t.vertices, 4);
  EXPECT_EQ(t.edges, 5);
  EXPECT_EQ(t.border_edges, 4);
  EXPECT_EQ(t.bad_edges, 0);
  EXPECT_EQ(t.euler(), 1);
  EXPECT_FALSE(t.closed());
}

TEST(MeshTopology, SeesATurnedTriangle) {
  TriangleMesh mesh = tetrahedron();
  std::swap(mesh.triangles[2][0], mesh.triangles[2][1]);
  const MeshTopology t = topology(mesh);
  EXPECT_EQ(t.bad_edges, 3);
  EXPECT_EQ(t.border_edges, 0);
  EXPECT_FALSE(t.closed());
  ASSERT_TRUE(first_fault(mesh));
  EXPECT_THAT(*first_fault(mesh), HasSubstr("both run through the edge"));
}

TEST(MeshTopology, SeesAnEdgeOfThreeTriangles) {
  TriangleMesh mesh = square();
  mesh.points.push_back({0, 0, 1});
  mesh.triangles.push_back({2, 0, 4});
  EXPECT_EQ(topology(mesh).bad_edges, 1);
}

TEST(MeshTopology, CountsPartsAndLeavesUnusedPointsOut) {
  TriangleMesh mesh = tetrahedron();
  const int n = static_cast<int>(mesh.points.size());
  mesh.points.push_back({9, 9, 9});
  for (const Xyz& p : tetrahedron().points) mesh.points.push_back(p + Xyz(10, 0, 0));
  for (const auto& t : tetrahedron().triangles) mesh.triangles.push_back({t[0] + n + 1, t[1] + n + 1, t[2] + n + 1});
  const MeshTopology t = topology(mesh);
  EXPECT_EQ(t.components, 2);
  EXPECT_EQ(t.vertices, 2 * n);
  EXPECT_EQ(t.euler(), 4);
}

TEST(MeshQuality, OfAnIcosahedronIsTheTextbooks) {
  const double a = 2.0;
  const MeshQuality q = quality(icosahedron());
  EXPECT_NEAR(q.area, 5 * std::sqrt(3.0) * a * a, 1e-12);
  EXPECT_NEAR(q.volume, 5.0 / 12.0 * (3 + std::sqrt(5.0)) * a * a * a, 1e-12);
  EXPECT_NEAR(q.smallest_angle, 60.0, 1e-12);
  EXPECT_NEAR(q.largest_angle, 60.0, 1e-12);
  EXPECT_NEAR(q.mean_smallest_angle, 60.0, 1e-12);
  EXPECT_NEAR(q.shortest_edge, a, 1e-14);
  EXPECT_NEAR(q.median_edge, a, 1e-14);
  EXPECT_NEAR(q.longest_edge, a, 1e-14);
  EXPECT_EQ(q.below_20 + q.below_30 + q.zero_area, 0);
}

TEST(MeshQuality, MeasuresVolumeWhereverTheSolidStands) {
  TriangleMesh mesh = tetrahedron();
  EXPECT_NEAR(quality(mesh).volume, 8.0 / 3.0, 1e-14);
  for (Xyz& p : mesh.points) p += Xyz(1e6, -2e6, 3e6);
  EXPECT_NEAR(quality(mesh).volume, 8.0 / 3.0, 1e-12);
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  EXPECT_NEAR(quality(mesh).volume, -8.0 / 3.0, 1e-12);
}

TEST(MeshQuality, KeepsTheDigitsOfTinyAngles) {
  for (const double h : {1e-3, 1e-7, 1e-10}) {
    const TriangleMesh needle = with_faces({{{0, 0, 0}, {1, 0, 0}, {1, h, 0}}, {{0, 1, 2}}, {}});
    const MeshQuality q = quality(needle);
    EXPECT_NEAR(q.smallest_angle / (std::atan(h) * 180 / std::numbers::pi), 1.0, 1e-14);
    EXPECT_EQ(q.below_20, 1);
    EXPECT_EQ(q.below_30, 1);
    EXPECT_EQ(q.zero_area, 0);
  }
}

TEST(MeshQuality, CountsTrianglesOnALineAsZeroArea) {
  const TriangleMesh flat =
      with_faces({{{0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, {0.7, 0.7, 0.7}, {0.1, 0.1, 0.1}}, {{0, 1, 2}, {0, 3, 1}}, {}});
  EXPECT_EQ(quality(flat).zero_area, 2);
}

TEST(MeshQuality, OfNothingIsZero) {
  EXPECT_EQ(quality({}).area, 0.0);
  EXPECT_FALSE(topology({}).closed());
  EXPECT_EQ(first_fault({}), std::nullopt);
}

TEST(FirstFault, NamesTheLawThatIsBroken) {
  TriangleMesh mesh = square();
  mesh.triangles[1][2] = 7;
  EXPECT_EQ(first_fault(mesh), "triangle 1 names point 7 of 4");
  mesh = square();
  mesh.triangles[0] = {0, 1, 1};
  EXPECT_EQ(first_fault(mesh), "triangle 0 has a corner twice");
  mesh = square();
  mesh.points[3][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(first_fault(mesh), "point 3 is not finite");
  mesh = square();
  mesh.face_of.pop_back();
  EXPECT_EQ(first_fault(mesh), "face_of has 1 entries for 2 triangles");
}

}  // namespace
}  // namespace geovor
