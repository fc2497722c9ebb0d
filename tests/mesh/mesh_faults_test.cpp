#include "mesh/mesh_faults.h"

#include <gtest/gtest.h>

#include <cmath>

namespace geovor {
namespace {

/// A regular tetrahedron with sides of sqrt 8, its corners numbered from `first`.
void add_tetrahedron(TriangleMesh& mesh, std::array<int, 4> corners) {
  const auto& [a, b, c, d] = corners;
  for (const std::array<int, 3>& t : {std::array{a, b, c}, {a, d, b}, {b, d, c}, {c, d, a}}) {
    mesh.triangles.push_back(t);
    mesh.face_of.push_back(1);
  }
}

TriangleMesh tetrahedron() {
  TriangleMesh mesh;
  mesh.points = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
  add_tetrahedron(mesh, {0, 1, 2, 3});
  return mesh;
}

TEST(MeshFaults, ATetrahedronHasNone) {
  const MeshFaults f = mesh_faults(tetrahedron());
  EXPECT_TRUE(f.open.empty() && f.disagreeing.empty() && f.without_area.empty() && f.manifold());
}

TEST(MeshFaults, AMissingTriangleLeavesItsThreeEdgesOpen) {
  TriangleMesh mesh = tetrahedron();
  mesh.triangles.pop_back();
  const MeshFaults f = mesh_faults(mesh);
  ASSERT_EQ(f.open.size(), 3u);
  EXPECT_EQ(f.open[0].from, 0);
  EXPECT_EQ(f.open[0].to, 2);
  EXPECT_TRUE(f.manifold());
}

TEST(MeshFaults, AFlippedTriangleDisagreesWithItsThreeNeighbours) {
  TriangleMesh mesh = tetrahedron();
  std::swap(mesh.triangles[1][0], mesh.triangles[1][1]);
  const MeshFaults f = mesh_faults(mesh);
  ASSERT_EQ(f.disagreeing.size(), 3u);
  for (const MeshEdge& e : f.disagreeing) EXPECT_TRUE(e.triangles[0] == 1 || e.triangles[1] == 1);
  EXPECT_TRUE(f.open.empty() && f.manifold());
}

TEST(MeshFaults, AFinOnAnEdgeCrowdsIt) {
  TriangleMesh mesh = tetrahedron();
  mesh.points.push_back({0, 0, 5});
  mesh.triangles.push_back({0, 1, 4});
  mesh.face_of.push_back(1);
  const MeshFaults f = mesh_faults(mesh);
  ASSERT_EQ(f.crowded.size(), 1u);
  EXPECT_EQ(f.crowded[0].triangles, (std::vector{0, 1, 4}));
  EXPECT_EQ(f.open.size(), 2u);
  EXPECT_FALSE(f.manifold());
}

TEST(MeshFaults, TwoSolidsThatTouchInAPointPinchIt) {
  TriangleMesh mesh = tetrahedron();
  for (const Xyz& p : {Xyz(3, 3, 1), Xyz(3, 1, 3), Xyz(1, 3, 3)}) mesh.points.push_back(p);
  add_tetrahedron(mesh, {0, 4, 5, 6});
  const MeshFaults f = mesh_faults(mesh);
  EXPECT_EQ(f.pinched, std::vector{0});
  EXPECT_TRUE(f.open.empty() && f.crowded.empty());
  EXPECT_FALSE(f.manifold());
}

TEST(MeshFaults, TrianglesWithoutAreaAreListed) {
  TriangleMesh mesh = tetrahedron();
  mesh.points.push_back(0.5 * (mesh.points[0] + mesh.points[1]));
  mesh.triangles.push_back({0, 1, 4});  // three points of a line
  mesh.triangles.push_back({2, 2, 3});  // a corner twice
  mesh.face_of = {1, 1, 1, 1, 1, 1};
  EXPECT_EQ(mesh_faults(mesh).without_area, (std::vector{4, 5}));
}

TEST(CornerAngles, AreThoseOfARightTriangle) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {std::sqrt(3.0), 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  const auto angles = corner_angles(mesh, 0);
  EXPECT_NEAR(angles[0], 90.0, 1e-12);
  EXPECT_NEAR(angles[1], 30.0, 1e-12);
  EXPECT_NEAR(angles[2], 60.0, 1e-12);
}

TEST(EdgeLengths, CountEachEdgeOnce) {
  const EdgeLengths lengths = edge_lengths(tetrahedron());
  ASSERT_EQ(lengths.sorted.size(), 6u);
  for (const double share : {0.0, 0.05, 0.5, 1.0}) EXPECT_DOUBLE_EQ(lengths.at(share), std::sqrt(8.0));
  EXPECT_NEAR(lengths.mean(), std::sqrt(8.0), 1e-15);
}

TEST(EdgeLengths, SharesAreThoseOfTheSortedLengths) {
  EdgeLengths lengths;
  for (int i = 0; i <= 100; ++i) lengths.sorted.push_back(i);
  EXPECT_EQ(lengths.at(0.05), 5.0);
  EXPECT_EQ(lengths.at(0.95), 95.0);
  EXPECT_EQ(EdgeLengths{}.at(0.5), 0.0);
}

}  // namespace
}  // namespace geovor
