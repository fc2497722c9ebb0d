// On a plane the diagram is the Euclidean one, which brute force knows.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "diagram_laws.h"
#include "test_faces.h"
#include "voronoi/diagram_builder.h"
#include "voronoi/dual.h"

namespace geovor::testing {
namespace {

struct Circle {
  std::array<int, 3> sites;
  double x, y, r;
};

/// All circles through three sites that hold no other site inside and have their centre in the square.
std::vector<Circle> empty_circles(const std::vector<Uv>& s) {
  std::vector<Circle> out;
  const int n = static_cast<int>(s.size());
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      for (int k = j + 1; k < n; ++k) {
        const double ax = s[j].u - s[i].u, ay = s[j].v - s[i].v, bx = s[k].u - s[i].u, by = s[k].v - s[i].v;
        const double d = 2 * (ax * by - ay * bx), a2 = ax * ax + ay * ay, b2 = bx * bx + by * by;
        const double x = (by * a2 - ay * b2) / d, y = (ax * b2 - bx * a2) / d, r = std::hypot(x, y);
        const double cx = x + s[i].u, cy = y + s[i].v;
        const bool empty =
            std::none_of(s.begin(), s.end(), [&](Uv p) { return std::hypot(p.u - cx, p.v - cy) < r * (1 - 1e-12); });
        if (empty && std::abs(cx) < 1 && std::abs(cy) < 1) out.push_back({{i, j, k}, cx, cy, r});
      }
    }
  }
  return out;
}

TEST(PlaneDiagram, HasTheEmptyCircumcirclesAsVertices) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const TestFace face = plane_square();
    const FaceDomain domain = face.domain();
    const auto sites = random_sites(domain, 3 + static_cast<int>(seed % 10), seed);
    const VoronoiDiagram d = build_diagram(domain, sites);
    EXPECT_EQ(broken_topology(d), "") << "seed " << seed;
    EXPECT_EQ(unproved(face, d), "") << "seed " << seed;
    EXPECT_EQ(euler_number(face.domain(), d), 1) << "seed " << seed;
    std::set<std::array<int, 3>> found;
    const auto circles = empty_circles(sites);
    for (const DiagramVertex& v : d.vertices) {
      if (v.on_boundary) continue;
      ASSERT_EQ(v.sites.size(), 3u);
      std::array<int, 3> key = {v.sites[0], v.sites[1], v.sites[2]};
      std::sort(key.begin(), key.end());
      found.insert(key);
      const auto c = std::find_if(circles.begin(), circles.end(), [&](const Circle& x) { return x.sites == key; });
      ASSERT_NE(c, circles.end()) << "seed " << seed;
      EXPECT_NEAR(v.xyz.x(), c->x, 1e-10 * (1 + c->r));
      EXPECT_NEAR(v.xyz.y(), c->y, 1e-10 * (1 + c->r));
      EXPECT_NEAR(v.radius, c->r, 1e-10 * (1 + c->r));
    }
    EXPECT_EQ(found.size(), circles.size()) << "seed " << seed;
  }
}

TEST(PlaneDiagram, OfOneSiteIsTheFace) {
  const TestFace face = plane_square();
  const VoronoiDiagram d = build_diagram(face.domain(), {{0.3, -0.2}});
  EXPECT_TRUE(d.vertices.empty());
  EXPECT_TRUE(d.edges.empty());
  ASSERT_EQ(d.cells.size(), 1u);
  ASSERT_EQ(d.cells[0].loops.size(), 1u);
  EXPECT_NEAR(d.cells[0].area, 4.0, 1e-6);
  EXPECT_FALSE(dual_of(*face.model.faces[0].surface, d).is_triangulation);
}

TEST(PlaneDiagram, OfTwoSitesIsOneStraightEdge) {
  const TestFace face = plane_square();
  const VoronoiDiagram d = build_diagram(face.domain(), {{-0.5, 0.0}, {0.5, 0.1}});
  ASSERT_EQ(d.edges.size(), 1u);
  EXPECT_EQ(d.vertices.size(), 2u);
  // The line x + 0.1 y = 0.005 across a square of side 2.
  EXPECT_NEAR(d.edges[0].length, 2 * std::sqrt(1.01), 1e-10);
  for (const EdgePoint& p : d.edges[0].points) EXPECT_NEAR(p.xyz.x() + 0.1 * p.xyz.y(), 0.005, 1e-11);
  EXPECT_NEAR(d.cells[0].area + d.cells[1].area, 4.0, 1e-6);
}

TEST(PlaneDiagram, OfASquareLatticeHasVerticesOfFourSites) {
  const TestFace face = plane_square();
  std::vector<Uv> sites;
  for (double v : {-0.75, -0.25, 0.25, 0.75}) {
    for (double u : {-0.75, -0.25, 0.25, 0.75}) sites.push_back({u, v});
  }
  const VoronoiDiagram d = build_diagram(face.domain(), sites);
  EXPECT_EQ(broken_topology(d), "");
  EXPECT_EQ(unproved(face, d), "");
  int inside = 0;
  for (const DiagramVertex& v : d.vertices) {
    if (v.on_boundary) continue;
    ++inside;
    EXPECT_EQ(v.sites.size(), 4u);
  }
  EXPECT_EQ(inside, 9);
  EXPECT_EQ(d.vertices.size(), 9u + 12u);
  EXPECT_EQ(d.edges.size(), 24u);
  for (const DiagramCell& cell : d.cells) EXPECT_NEAR(cell.area, 0.25, 1e-6);
  const DualGraph dual = dual_of(*face.model.faces[0].surface, d);
  EXPECT_EQ(dual.triangles.size(), 18u);
  for (const DualEdge& e : dual.edges) EXPECT_NEAR(e.length, 0.5, 1e-12);
  EXPECT_TRUE(dual.is_triangulation) << dual.why_not;
}

TEST(PlaneDiagram, EdgeThroughTheCornersOfTheFace) {
  const TestFace face = plane_square();
  const VoronoiDiagram d = build_diagram(face.domain(), {{-0.5, 0.5}, {0.5, -0.5}});
  EXPECT_EQ(broken_topology(d), "");
  EXPECT_EQ(unproved(face, d), "");
  ASSERT_EQ(d.edges.size(), 1u);
  EXPECT_NEAR(d.edges[0].length, 2 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(d.cells[0].area, 2.0, 1e-6);
}

TEST(PlaneDiagram, FindsTheCellsOfAClusterWithinOneLatticeCell) {
  const TestFace face = plane_square();
  std::vector<Uv> sites = {{-0.7, -0.6}, {0.8, 0.7}};
  for (int i = 0; i < 6; ++i) sites.push_back({0.1 + 1e-3 * std::cos(i * 1.1), 0.2 + 1e-3 * std::sin(i * 1.1)});
  const VoronoiDiagram d = build_diagram(face.domain(), sites);
  EXPECT_EQ(broken_topology(d), "");
  EXPECT_EQ(unproved(face, d), "");
  EXPECT_EQ(euler_number(face.domain(), d), 1);
  for (const DiagramCell& cell : d.cells) EXPECT_EQ(cell.loops.size(), 1u);
}

TEST(PlaneDiagram, PointsOutOfPlaceWhereAHoleCutsThePaths) {
  TestFace face = plane_square();
  face.polygon({{-0.1, -0.6}, {-0.1, 0.6}, {0.1, 0.6}, {0.1, -0.6}});  // a hole: clockwise
  const VoronoiDiagram d = build_diagram(face.domain(), {{-0.6, 0.0}, {0.2, 0.05}});
  EXPECT_TRUE(std::any_of(d.warnings.begin(), d.warnings.end(),
                          [](const DiagramWarning& w) { return w.kind == "path_leaves_face"; }));
}

TEST(PlaneDiagram, TellsOfEachCellAndStopsWhenToldTo) {
  const TestFace face = plane_square();
  const FaceDomain domain = face.domain();
  const auto sites = random_sites(domain, 30, 5);
  std::vector<int> told;
  VoronoiOptions options;
  options.progress = [&](int done, int total) {
    EXPECT_EQ(total, 30);
    told.push_back(done);
    return done < 12;
  };
  const VoronoiDiagram stopped = build_diagram(domain, sites, options);
  ASSERT_EQ(told.size(), 12u);
  for (int i = 0; i < 12; ++i) EXPECT_EQ(told[i], i + 1);
  const auto said = [](const DiagramWarning& w) { return w.kind == "unresolved" && w.text == "the work was stopped"; };
  EXPECT_EQ(std::count_if(stopped.warnings.begin(), stopped.warnings.end(), said), 1);
  EXPECT_LT(stopped.edges.size(), build_diagram(domain, sites).edges.size());
}

}  // namespace
}  // namespace geovor::testing
