#include "delaunay/half_edges.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace geovor {
namespace {

HalfEdges octahedron() {
  return {6, {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

HalfEdges square() { return {4, {{0, 1, 2}, {0, 2, 3}}}; }

int euler(const HalfEdges& m) {
  std::set<int> vertices;
  std::set<std::pair<int, int>> edges;
  int triangles = 0;
  for (int t = 0; t < m.triangle_count(); ++t) {
    if (!m.alive(t)) continue;
    ++triangles;
    for (int e = 3 * t; e < 3 * t + 3; ++e) {
      vertices.insert(m.origin(e));
      edges.insert(std::minmax(m.origin(e), m.target(e)));
    }
  }
  return static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) + triangles;
}

TEST(HalfEdges, OfAClosedSurfaceHaveNoBorder) {
  const HalfEdges m = octahedron();
  EXPECT_EQ(m.first_fault(), std::nullopt);
  for (int v = 0; v < 6; ++v) {
    EXPECT_FALSE(m.on_border(v));
    EXPECT_EQ(m.star(v).size(), 4u);
  }
  EXPECT_EQ(euler(m), 2);
}

TEST(HalfEdges, StarOfABorderVertexRunsFromBorderToBorder) {
  const HalfEdges m = square();
  EXPECT_TRUE(m.on_border(0));
  const auto star = m.star(0);
  ASSERT_EQ(star.size(), 2u);
  EXPECT_EQ(m.target(star[0]), 1);
  EXPECT_EQ(m.target(star[1]), 2);
}

TEST(HalfEdges, FlipTurnsTheDiagonalAndFlippingTwiceRestoresIt) {
  HalfEdges m = square();
  const int e = m.find(0, 2);
  ASSERT_NE(e, HalfEdges::kNone);
  m.flip(e);
  EXPECT_EQ(m.first_fault(), std::nullopt);
  EXPECT_EQ(m.find(0, 2), HalfEdges::kNone);
  ASSERT_NE(m.find(1, 3), HalfEdges::kNone);
  m.flip(m.find(1, 3));
  EXPECT_NE(m.find(0, 2), HalfEdges::kNone);
  EXPECT_EQ(m.first_fault(), std::nullopt);
}

TEST(HalfEdges, FixedEdgesStayFixedThroughTheMovesAroundThem) {
  HalfEdges m = octahedron();
  m.set_fixed(m.find(0, 2));
  m.flip(m.find(2, 4));
  EXPECT_TRUE(m.fixed(m.find(0, 2)));
  m.split_edge(m.find(0, 2), m.add_vertex());
  EXPECT_TRUE(m.fixed(m.find(0, 6)));
  EXPECT_TRUE(m.fixed(m.find(6, 2)));
  EXPECT_FALSE(m.can_collapse(m.find(6, 2)));
  EXPECT_EQ(m.first_fault(), std::nullopt);
}

TEST(HalfEdges, CollapseRefusesToMakeAnEdgeDouble) {
  HalfEdges m = octahedron();
  // Cutting off a corner: the neighbours 0, 2, 4 of a new vertex are pairwise joined; only three triangles meet there.
  m.split_triangle(0, m.add_vertex());
  EXPECT_FALSE(m.can_collapse(m.find(0, 2)));
}

// Euler's number is kept by every move, in any order.
TEST(HalfEdges, RandomMovesKeepTheLawsAndEulersNumber) {
  for (const bool closed : {true, false}) {
    std::mt19937 random(20260 + closed);
    HalfEdges m = closed ? octahedron() : square();
    const int expected = euler(m);
    for (int step = 0; step < 3000; ++step) {
      const int e = static_cast<int>(random() % (3 * m.triangle_count()));
      if (!m.alive(e / 3)) continue;
      switch (random() % 4) {
        case 0:
          if (!m.fixed(e) && m.find(m.apex(e), m.apex(m.twin(e))) == HalfEdges::kNone &&
              m.find(m.apex(m.twin(e)), m.apex(e)) == HalfEdges::kNone)
            m.flip(e);
          break;
        case 1:
          if (m.vertex_count() < 300) m.split_triangle(e / 3, m.add_vertex());
          break;
        case 2:
          if (m.vertex_count() < 300) m.split_edge(e, m.add_vertex());
          break;
        default:
          if (m.can_collapse(e)) m.collapse(e);
      }
      if (step % 50 == 0) {
        ASSERT_EQ(m.first_fault(), std::nullopt) << "step " << step;
        ASSERT_EQ(euler(m), expected) << "step " << step;
      }
      if (step % 500 == 499) m.compact();
    }
    EXPECT_EQ(m.first_fault(), std::nullopt);
    EXPECT_EQ(euler(m), expected);
  }
}

}  // namespace
}  // namespace geovor
