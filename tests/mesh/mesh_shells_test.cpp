#include "mesh/mesh_shells.h"

#include <gtest/gtest.h>

#include <set>

namespace geovor {
namespace {

constexpr std::array<std::array<int, 3>, 4> kCorners = {{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};

/// Tetrahedra of volume 1 side by side.
TriangleMesh tetrahedra(int count) {
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const int first = static_cast<int>(mesh.points.size());
    for (const Xyz& p : {Xyz(0, 0, 0), Xyz(1, 0, 0), Xyz(0, 2, 0), Xyz(0, 0, 3)}) {
      mesh.points.push_back(p + Xyz(1e6 + 10 * i, 0, 0));
    }
    for (const auto& [a, b, c] : kCorners) {
      mesh.triangles.push_back({first + a, first + b, first + c});
    }
  }
  mesh.face_of.assign(mesh.triangles.size(), 1);
  return mesh;
}

TEST(MeshShells, EveryEdgeIsThereOnceAndEachUseRunsAsItsTriangleDoes) {
  const TriangleMesh mesh = tetrahedra(3);
  const SharedEdges edges = shared_edges(mesh);
  EXPECT_EQ(edges.ends.size(), 18u);
  std::set<std::set<int>> different;
  for (const auto& [a, b] : edges.ends) different.insert({a, b});
  EXPECT_EQ(different.size(), edges.ends.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const EdgeUse& use = edges.uses[t][k];
      EXPECT_EQ(edges.ends[use.edge][use.reversed ? 1 : 0], mesh.triangles[t][k]);
      EXPECT_EQ(edges.ends[use.edge][use.reversed ? 0 : 1], mesh.triangles[t][(k + 1) % 3]);
    }
  }
}

TEST(MeshShells, ClosedOpenAndTurnedShellsAreTold) {
  TriangleMesh mesh = tetrahedra(3);
  for (std::size_t t = 4; t < 8; ++t) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  mesh.triangles.pop_back();
  mesh.face_of.pop_back();
  const std::vector<MeshShell> shells = shells_of(mesh, shared_edges(mesh));
  ASSERT_EQ(shells.size(), 3u);
  EXPECT_EQ(shells[1].triangles, (std::vector<int>{4, 5, 6, 7}));
  EXPECT_TRUE(shells[0].closed && shells[1].closed);
  EXPECT_FALSE(shells[2].closed);
  EXPECT_NEAR(shells[0].volume, 1.0, 1e-9);  // a million away from the origin
  EXPECT_NEAR(shells[1].volume, -1.0, 1e-9);
}

TEST(MeshShells, ATriangleThatLooksTheOtherWayOpensItsShell) {
  TriangleMesh mesh = tetrahedra(1);
  std::swap(mesh.triangles[2][0], mesh.triangles[2][1]);
  EXPECT_FALSE(shells_of(mesh, shared_edges(mesh)).front().closed);
}

TEST(MeshShells, NeedlesHaveAPlaneAndLinesHaveNone) {
  const TriangleMesh needle{{{0, 0, 0}, {1, 0, 0}, {0.5, 1e-9, 0}}, {{0, 1, 2}}, {1}};
  EXPECT_FALSE(is_flat(needle, 0));
  const TriangleMesh line{{{0, 0, 0}, {0.1, 0.1, 0.1}, {0.3, 0.3, 0.3}}, {{0, 1, 2}}, {1}};
  EXPECT_TRUE(is_flat(line, 0));
}

}  // namespace
}  // namespace geovor
