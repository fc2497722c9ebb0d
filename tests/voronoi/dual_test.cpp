// The dual against triangulations known otherwise: empty circles, the convex hull, an unrolled cylinder.
#include "voronoi/dual.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <set>

#include "geodesic/trace.h"
#include "surface/forms.h"
#include "test_faces.h"
#include "voronoi/diagram_builder.h"

namespace geovor::testing {
namespace {

using Triangle = std::array<int, 3>;

struct DualCase {
  VoronoiDiagram diagram;
  DualGraph dual;
};

DualCase dual_on(const TestFace& face, const std::vector<Uv>& sites) {
  DualCase made{build_diagram(face.domain(), sites), {}};
  made.dual = dual_of(*face.model.faces[0].surface, made.diagram);
  return made;
}

TestFace tube(double radius, double height) {
  return TestFace(std::make_shared<Cylinder>(Frame{}, radius)).ring({{0, 2 * kPi}, {0, height}});
}

std::set<Triangle> sorted(const std::vector<Triangle>& triangles) {
  std::set<Triangle> out;
  for (Triangle t : triangles) {
    std::sort(t.begin(), t.end());
    out.insert(t);
  }
  return out;
}

std::vector<double> lengths(const DualGraph& dual) {
  std::vector<double> out;
  for (const DualEdge& e : dual.edges) out.push_back(e.length);
  std::sort(out.begin(), out.end());
  return out;
}

bool names(const DualGraph& dual, const std::string& words) { return dual.why_not.find(words) != std::string::npos; }

/// Whether the circle through three points of the plane has its centre in the square and no other point inside.
bool empty_circle_in_square(const std::vector<Uv>& s, const Triangle& t) {
  const UvVec a = s[t[1]] - s[t[0]], b = s[t[2]] - s[t[0]];
  const double d = 2 * (a.u * b.v - a.v * b.u), a2 = a.u * a.u + a.v * a.v, b2 = b.u * b.u + b.v * b.v;
  const double x = (b.v * a2 - a.v * b2) / d, y = (a.u * b2 - b.u * a2) / d, r = std::hypot(x, y);
  const double u = s[t[0]].u + x, v = s[t[0]].v + y;
  return std::abs(u) < 1 && std::abs(v) < 1 &&
         std::none_of(s.begin(), s.end(), [&](Uv p) { return std::hypot(p.u - u, p.v - v) < r * (1 - 1e-12); });
}

/// Whether all points lie on one side of the plane through three of them.
bool on_hull(const std::vector<Xyz>& x, const Triangle& t) {
  const Xyz n = (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]);
  int above = 0, below = 0;
  for (int i = 0; i < static_cast<int>(x.size()); ++i) {
    if (i == t[0] || i == t[1] || i == t[2]) continue;
    (n.dot(x[i] - x[t[0]]) > 0 ? above : below)++;
  }
  return above == 0 || below == 0;
}

template <class Holds>
std::set<Triangle> all_triangles(int n, const Holds& holds) {
  std::set<Triangle> out;
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      for (int k = j + 1; k < n; ++k) {
        if (holds(Triangle{i, j, k})) out.insert({i, j, k});
      }
    }
  }
  return out;
}

TEST(Dual, OnAPlaneHasTheTrianglesWithEmptyCircles) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const TestFace face = plane_square();
    const auto sites = random_sites(face.domain(), 18, seed);
    const DualCase c = dual_on(face, sites);
    EXPECT_EQ(sorted(c.dual.triangles),
              all_triangles(18, [&](const Triangle& t) { return empty_circle_in_square(sites, t); }))
        << "seed " << seed;
    for (const DualEdge& e : c.dual.edges) {
      EXPECT_TRUE(e.through);
      EXPECT_NEAR(e.length, std::hypot(sites[e.b].u - sites[e.a].u, sites[e.b].v - sites[e.a].v), 1e-12);
      EXPECT_NEAR((e.path.back() - c.diagram.sites[e.b].xyz).norm(), 0.0, 10 * kDrawnPath * e.length);
    }
    for (const Triangle& t : c.dual.triangles) {
      EXPECT_GT(cross(sites[t[1]] - sites[t[0]], sites[t[2]] - sites[t[0]]), 0.0);
    }
  }
}

TEST(Dual, OnASphereIsTheConvexHull) {
  const auto sphere = std::make_shared<Sphere>(Frame{}, 2.0);
  const TestFace face = whole(sphere);
  Uniform random(7);
  std::vector<Uv> sites;
  std::vector<Xyz> x;
  for (int i = 0; i < 24; ++i) {
    sites.push_back({2 * kPi * random(), std::asin(2 * random() - 1)});
    x.push_back(sphere->position(sites.back()));
  }
  const DualCase c = dual_on(face, sites);
  EXPECT_EQ(sorted(c.dual.triangles), all_triangles(24, [&](const Triangle& t) { return on_hull(x, t); }));
  EXPECT_EQ(c.dual.triangles.size(), 2u * 24 - 4);
  EXPECT_EQ(c.dual.edges.size(), 3u * 24 - 6);
  for (const DualEdge& e : c.dual.edges) {
    EXPECT_NEAR(e.length, 2.0 * std::atan2(x[e.a].cross(x[e.b]).norm(), x[e.a].dot(x[e.b])), 1e-11);
  }
  EXPECT_TRUE(c.dual.is_triangulation) << c.dual.why_not;
}

TEST(Dual, OnASphereOfFewSitesSaysWhyItIsNone) {
  const TestFace face = whole(std::make_shared<Sphere>(Frame{}, 1.0));
  EXPECT_TRUE(names(dual_on(face, {{0, 0}, {2, 0.3}}).dual, "fewer than three"));
  // Three cells that meet in two vertices: two triangles with the same corners.
  const DualCase three = dual_on(face, {{0, 0}, {2, 0.1}, {4, -0.1}});
  EXPECT_EQ(three.dual.triangles.size(), 2u);
  EXPECT_TRUE(names(three.dual, "more than one vertex")) << three.dual.why_not;
}

TEST(Dual, OnACylinderJoinsTwoSitesBothWaysRound) {
  const DualCase c = dual_on(tube(1.5, 4.0), {{0.2, 1.8}, {2.2, 2.1}, {1.2, 3.9}});
  std::vector<double> expected;  // unrolled: the way round has the circumference 3 pi
  for (const double across : {3.0, 3 * kPi - 3.0}) expected.push_back(std::hypot(across, 0.3));
  std::vector<double> found;
  for (const DualEdge& e : c.dual.edges) {
    EXPECT_TRUE(e.through);
    if (std::max(e.a, e.b) == 1) found.push_back(e.length);
  }
  std::sort(found.begin(), found.end());
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0], expected[0], 1e-11);
  EXPECT_NEAR(found[1], expected[1], 1e-11);
  EXPECT_FALSE(c.dual.is_triangulation);
}

TEST(Dual, OnACylinderSaysWhyFewSitesAreNoTriangulation) {
  const DualCase two = dual_on(tube(1.0, 2.0), {{0, 1}, {kPi, 1}});
  ASSERT_EQ(two.dual.edges.size(), 2u);
  for (double length : lengths(two.dual)) EXPECT_NEAR(length, kPi, 1e-11);
  const double turn = two.dual.edges[0].angle - two.dual.edges[1].angle;
  EXPECT_NEAR(std::cos(turn), two.dual.edges[0].a == two.dual.edges[1].a ? -1.0 : 1.0, 1e-9);
  const DualCase three = dual_on(tube(1.0, 2.0), {{0, 1}, {2, 1}, {4, 1}});
  const std::vector<double> around = lengths(three.dual);
  ASSERT_EQ(around.size(), 3u);
  EXPECT_NEAR(around[0], 2.0, 1e-11);
  EXPECT_NEAR(around[2], 2 * kPi - 4.0, 1e-11);
  EXPECT_TRUE(names(three.dual, "pieces of the border")) << three.dual.why_not;
}

TEST(Dual, NamesTheCellThatPartsTheFace) {
  // Three long cells across a strip: the outer two never meet, and no three cells do.
  TestFace strip = TestFace(std::make_shared<Plane>(Frame{})).rectangle({{-3, 3}, {-0.2, 0.2}});
  const DualCase row = dual_on(strip, {{-2, 0}, {0, 0}, {2, 0}});
  EXPECT_EQ(row.dual.edges.size(), 2u);
  EXPECT_TRUE(names(row.dual, "site 1 has 2 pieces of the border")) << row.dual.why_not;
  // A hole between two sites parts their common border in two.
  TestFace holed = plane_square();
  holed.polygon({{-0.05, -0.05}, {-0.05, 0.05}, {0.05, 0.05}, {0.05, -0.05}});
  const DualCase pair = dual_on(holed, {{-0.3, 0}, {0.3, 0.01}, {0.1, 0.9}});
  EXPECT_FALSE(pair.dual.is_triangulation);
  for (const DualEdge& e : pair.dual.edges) {
    const Xyz way = pair.diagram.sites[e.b].xyz - pair.diagram.sites[e.a].xyz;
    EXPECT_NEAR(e.length, way.norm(), 1e-12);
  }
}

TEST(Dual, CrossesEveryEdgeByTheGeodesicThatPassesThere) {
  const auto wave = std::make_shared<WaveSurface>(UvBox{{-2, 2}, {-2, 2}});
  const TestFace face = whole(wave);
  const DualCase c = dual_on(face, random_sites(face.domain(), 25, 3));
  for (const DualEdge& e : c.dual.edges) {
    const DiagramEdge& edge = c.diagram.edges[e.edge];
    double nearest = 1e9;
    for (const EdgePoint& p : edge.points) nearest = std::min(nearest, p.radius);
    EXPECT_LE(e.length, 2 * nearest * (1 + 1e-12));
    TraceOptions options;
    options.stop_at_domain = false;
    const Uv from = c.diagram.sites[e.a].uv;
    const auto end = trace_geodesic(*wave, from, direction_at_angle(wave->jet(from), e.angle), e.length, options);
    EXPECT_NEAR((wave->position(end.end.p) - c.diagram.sites[e.b].xyz).norm(), 0.0, 1e-10 * e.length);
  }
}

TEST(Dual, DrawsPathsOnlyWhenAsked) {
  const TestFace face = plane_square();
  const VoronoiDiagram d = build_diagram(face.domain(), {{-0.5, 0}, {0.5, 0}, {0, 0.6}});
  for (const DualEdge& e : dual_of(*face.model.faces[0].surface, d, DualPaths::None).edges) {
    EXPECT_TRUE(e.path.empty() && e.path_uv.empty());
    EXPECT_GT(e.length, 0.0);
  }
}

}  // namespace
}  // namespace geovor::testing
