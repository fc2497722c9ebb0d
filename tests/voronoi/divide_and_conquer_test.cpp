// Section 3.2 of the paper held against the direct way: the same cells, whatever the order in which they are found.
#include "voronoi/divide_and_conquer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "test_faces.h"

namespace geovor::testing {
namespace {

struct Place {
  std::vector<int> sites;
  Xyz x;
};

/// Vertices by sites, then by place.
std::vector<Place> vertices_of(const VoronoiDiagram& d) {
  std::vector<Place> places;
  for (const DiagramVertex& v : d.vertices) {
    places.push_back({v.sites, v.xyz});
    std::sort(places.back().sites.begin(), places.back().sites.end());
  }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    if (a.sites != b.sites) return a.sites < b.sites;
    for (int k = 0; k < 2; ++k) {
      if (std::abs(a.x[k] - b.x[k]) > 1e-6) return a.x[k] < b.x[k];
    }
    return a.x[2] < b.x[2];
  });
  return places;
}

std::vector<std::pair<int, int>> pairs_of(const VoronoiDiagram& d) {
  std::vector<std::pair<int, int>> pairs;
  for (const DiagramEdge& e : d.edges) pairs.emplace_back(std::min(e.left, e.right), std::max(e.left, e.right));
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

void expect_the_same(const TestFace& face, const std::vector<Uv>& sites) {
  const FaceDomain domain = face.domain();
  const VoronoiDiagram direct = build_diagram(domain, sites), merged = divide_and_conquer(domain, sites);
  EXPECT_TRUE(merged.warnings.empty() || !direct.warnings.empty());
  EXPECT_EQ(pairs_of(direct), pairs_of(merged));
  const auto a = vertices_of(direct), b = vertices_of(merged);
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].sites, b[i].sites);
    EXPECT_LT((a[i].x - b[i].x).norm(), 1e-10);
  }
  for (size_t i = 0; i < sites.size(); ++i) {
    EXPECT_NEAR(direct.cells[i].area, merged.cells[i].area, 1e-6 * direct.cells[i].area);
  }
}

TEST(DivideAndConquer, SewsTheWaveTogether) {
  const TestFace face = whole(std::make_shared<WaveSurface>(UvBox{{-2, 2}, {-2, 2}}));
  expect_the_same(face, random_sites(face.domain(), 24, 3));
}

TEST(DivideAndConquer, SewsAClosedSphereTogether) {
  const TestFace face = whole(std::make_shared<Sphere>(Frame{}, 1.0));
  Uniform random(7);
  std::vector<Uv> sites;
  for (int i = 0; i < 20; ++i) {
    const double u = 2.0 * kPi * random();
    sites.push_back({u, std::asin(2.0 * random() - 1.0)});
  }
  expect_the_same(face, sites);
}

TEST(DivideAndConquer, SewsATubeTogether) {
  TestFace face(std::make_shared<Cylinder>(Frame{}, 1.0));
  face.ring({{0, 2 * kPi}, {0, 3}});
  expect_the_same(face, random_sites(face.domain(), 9, 5));
}

TEST(DivideAndConquer, SewsATorusTogetherWhoseFirstDiagramsAreCutLociAlone) {
  const TestFace face = whole(std::make_shared<Torus>(Frame{}, 2.0, 0.7));
  expect_the_same(face, random_sites(face.domain(), 6, 2));
}

// On a plane the last of four sites stands in the middle: three vertices vanish, three edges are trimmed, a closed
// chain of new ones is all that is sewn.
TEST(DivideAndConquer, TrimsWhatALaterSiteCovers) {
  const TestFace face = plane_square();
  const FaceDomain domain = face.domain();
  const std::vector<Uv> sites = {{-0.8, -0.6}, {0.8, -0.6}, {0.05, 0.9}, {0.0, -0.1}};
  PartDiagram corners, middle;
  corners.which = {0, 1, 2}, middle.which = {3};
  corners.diagram = build_diagram(domain, {sites[0], sites[1], sites[2]});
  middle.diagram = build_diagram(domain, {sites[3]});
  const VoronoiDiagram merged = merge_diagrams(domain, sites, {corners, middle});
  const auto a = vertices_of(build_diagram(domain, sites)), b = vertices_of(merged);
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) EXPECT_LT((a[i].x - b[i].x).norm(), 1e-13);
}

}  // namespace
}  // namespace geovor::testing
