// Diagrams with islands on high bumps, held against the numbers of two other methods.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "brep/face_area.h"
#include "cell_labels.h"
#include "diagram_laws.h"
#include "geodesic/offset.h"
#include "voronoi/bisector.h"
#include "voronoi/diagram_builder.h"

namespace geovor::testing {
namespace {

constexpr double kDigits = 1e-10;
constexpr double kHeight = 3.0, kWidth = 0.3;

TestFace bumps(const std::vector<Uv>& centres, double height = kHeight) {
  std::vector<GaussianBumps::Bump> list;
  for (const Uv c : centres) list.push_back({c, height, kWidth});
  return whole(std::make_shared<GaussianBumps>(list, UvBox{{-2, 2}, {-2, 2}}));
}

/// Cells that touch the border of the face nowhere.
std::set<int> islands(const VoronoiDiagram& d) {
  std::set<int> out;
  for (const DiagramCell& cell : d.cells) {
    const auto on_border = [](const CellPiece& piece) { return piece.edge < 0; };
    const bool touches = std::any_of(cell.loops.begin(), cell.loops.end(), [&](const auto& loop) {
      return std::any_of(loop.begin(), loop.end(), on_border);
    });
    if (!touches) out.insert(cell.site);
  }
  return out;
}

void expect_laws(const TestFace& face, const VoronoiDiagram& d) {
  const FaceDomain domain = face.domain();
  EXPECT_EQ(broken_topology(d), "");
  EXPECT_EQ(unproved(face, d), "");
  EXPECT_EQ(euler_number(domain, d), 1);
  const DistanceFinder finder(domain.surface());
  const LabelCheck labels = compare_with_brute_force(domain, d, shortest_by(finder), 1000, 1);
  EXPECT_EQ(labels.wrong, 0) << labels.first_wrong;
  EXPECT_LT(labels.undecided, 10);
}

class OneBump : public ::testing::Test {
 protected:
  const TestFace face_ = bumps({{0, 0}});
  const VoronoiDiagram diagram_ = build_diagram(face_.domain(), {{1.2, 0}, {0, 0}});
};

TEST_F(OneBump, MakesTheCellOnItsTopAnIsland) {
  expect_laws(face_, diagram_);
  EXPECT_EQ(islands(diagram_), std::set<int>{1});
}

// Behind the bump the flood from (1.2, 0) meets itself: there the island's border has a corner, where the cut locus of
// the outer site begins.
TEST_F(OneBump, HasTheCornerOfTheIslandToTenDigits) {
  const auto corner = std::find_if(diagram_.vertices.begin(), diagram_.vertices.end(),
                                   [](const DiagramVertex& v) { return v.sites.size() == 3; });
  ASSERT_NE(corner, diagram_.vertices.end());
  EXPECT_NEAR(corner->uv.u, -0.498008114704, kDigits);
  EXPECT_NEAR(corner->uv.v, 0.0, kDigits);
  EXPECT_NEAR(corner->radius, 2.318702738386, kDigits);
  std::multiset<int> sites(corner->sites.begin(), corner->sites.end());
  EXPECT_EQ(sites, (std::multiset<int>{0, 0, 1}));
  for (std::size_t i = 0; i < 3; ++i) {
    if (corner->sites[i] == 1) continue;
    EXPECT_NEAR(std::abs(std::remainder(corner->angles[i] - kPi, 2.0 * kPi)), 0.427945264687, kDigits);
  }
  EXPECT_EQ(std::count_if(diagram_.edges.begin(), diagram_.edges.end(),
                          [](const DiagramEdge& e) { return e.kind == EdgeKind::CutLocus; }),
            1);
}

// Half way on the straight path over the bump's side.
TEST_F(OneBump, HasTheNearestPointOfTheBorderToTenDigits) {
  const Surface& surface = *face_.model.faces[0].surface;
  EXPECT_NEAR(connect(surface, {1.2, 0}, {0, 0}).length, 3.482605402282, kDigits);
  const DiagramEdge* border = nullptr;
  for (const DiagramEdge& e : diagram_.edges)
    if (e.kind == EdgeKind::Bisector) border = &e;
  ASSERT_NE(border, nullptr);
  const auto nearest = std::min_element(border->points.begin(), border->points.end(),
                                        [](const EdgePoint& a, const EdgePoint& b) { return a.radius < b.radius; });
  const std::vector<Uv> sites = {{1.2, 0}, {0, 0}};
  const SiteRays rays(surface, sites);
  const auto m = correct_bisector(rays, border->left, border->right,
                                  {nearest->radius, nearest->left_angle, nearest->right_angle}, {Xyz::UnitY(), 0.0});
  ASSERT_TRUE(m);
  EXPECT_NEAR(m->position().x(), 0.384006670378, kDigits);
  EXPECT_NEAR(m->radius(), 1.741302701141, kDigits);
}

TEST(Islands, ThereIsNoneOnALowBump) {
  const TestFace face = bumps({{0, 0}}, 1.0);
  const VoronoiDiagram d = build_diagram(face.domain(), {{1.2, 0}, {0, 0}});
  EXPECT_EQ(unproved(face, d), "");
  EXPECT_EQ(islands(d), std::set<int>{});
}

// The paper's figure 6, its own mirror image in u = 0.
TEST(Islands, OnTwoBumpsThereAreTwo) {
  const TestFace face = bumps({{-1, 0.2}, {1, 0.2}});
  const VoronoiDiagram d = build_diagram(face.domain(), {{0, -1}, {-1, 0.2}, {1, 0.2}});
  expect_laws(face, d);
  EXPECT_EQ(islands(d), (std::set<int>{1, 2}));
  EXPECT_NEAR(d.cells[1].area, d.cells[2].area, 1e-7);
}

// Geodesics come together behind the farther bump: along the cells' borders y falls to 1e-4 and below zero and on
// again, where the border of the face cuts off a cut locus beside its free end.
TEST(Islands, OnTopsOfTwoBumpsOneSiteAndTwoAreProved) {
  const TestFace face = bumps({{1, 0.2}, {-1, 0.2}});
  const std::vector<Uv> tops = {{1.0106925727, 0.2074138048}, {-1.0130466417, 0.1999205465}};
  for (const std::vector<Uv>& sites : {std::vector<Uv>{tops[0]}, tops}) {
    const VoronoiDiagram d = build_diagram(face.domain(), sites);
    EXPECT_EQ(unproved(face, d), "") << sites.size() << " sites";
    EXPECT_EQ(d.warnings.size(), 0u) << d.warnings.front().text;
    if (sites.size() == 1) {
      EXPECT_EQ(d.edges.size(), 2u);
    }
  }
}

TEST(Islands, OfThreeSitesWithoutSymmetryTheOneOnTheBumpIsOne) {
  const TestFace face = bumps({{0, 0}});
  const VoronoiDiagram d = build_diagram(face.domain(), {{0.9, 0.25}, {-1.8, -1.6}, {0.1, 0.05}});
  expect_laws(face, d);
  EXPECT_EQ(islands(d), std::set<int>{2});
}

// On the outer equator a site's geodesics run together at pi sqrt(r (R + r)) = 39.2, before the middle between two
// opposite sites at 40.8: there a cut locus begins that runs on to the middle.
TEST(Islands, TwoOppositeSitesOnATorusHaveCutLociBetweenThem) {
  const TestFace face = whole(std::make_shared<Torus>(Frame{}, 20.0, 6.0));
  for (const std::vector<Uv>& sites :
       {std::vector<Uv>{{0, 0}, {kPi, 0}}, {{1, 0}, {1 + kPi, 0}}, {{0, 0}, {3.14159, 1e-9}}}) {
    const VoronoiDiagram d = build_diagram(face.domain(), sites);
    EXPECT_EQ(unproved(face, d), "");
    EXPECT_TRUE(d.warnings.empty()) << d.warnings.front().text;
    EXPECT_EQ(std::count_if(d.vertices.begin(), d.vertices.end(),
                            [](const DiagramVertex& v) {
                              return v.sites.size() == 1 && std::abs(v.radius - kPi * std::sqrt(6.0 * 26.0)) < 1e-9;
                            }),
              4);
  }
}

}  // namespace
}  // namespace geovor::testing
