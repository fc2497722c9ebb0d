// The certificate: diagrams that hold, and diagrams that were broken on purpose, each by the claim that must see it.
#include "voronoi/certificate.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "brep/face_area.h"
#include "test_faces.h"
#include "voronoi/cell_areas.h"
#include "voronoi/diagram_builder.h"

namespace geovor::testing {
namespace {

Certificate certificate(const TestFace& face, const VoronoiDiagram& d) {
  return certify(face.domain(), d, face_area(face.model, face.model.faces[0]));
}

class BrokenDiagram : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(certificate(face_, diagram_).holds()) << certificate(face_, diagram_).result; }
  /// The names of the claims that do not hold.
  std::vector<std::string> broken() const {
    std::vector<std::string> names;
    for (const CertificateClaim& c : certificate(face_, diagram_).claims)
      if (!c.holds) names.push_back(c.name);
    return names;
  }
  DiagramEdge& longest_edge() {
    return *std::max_element(diagram_.edges.begin(), diagram_.edges.end(),
                             [](const auto& a, const auto& b) { return a.length < b.length; });
  }

  const TestFace face_ = whole(std::make_shared<Paraboloid>(kSquare));
  VoronoiDiagram diagram_ = build_diagram(face_.domain(), random_sites(face_.domain(), 9, 4));
};

using ::testing::Contains;
using ::testing::ElementsAre;

TEST_F(BrokenDiagram, IsSeenByTopologyWhereALoopIsLost) {
  diagram_.cells[3].loops.clear();
  EXPECT_THAT(broken(), ElementsAre("topology"));
}

TEST_F(BrokenDiagram, IsSeenByTopologyWhereAnEdgeNamesAnotherSite) {
  longest_edge().left = (longest_edge().left + 1) % 9;
  EXPECT_THAT(broken(), ElementsAre("topology"));
}

TEST_F(BrokenDiagram, IsSeenByRadialLengthsWhereAPointIsOffByTenRoundings) {
  DiagramEdge& e = longest_edge();
  EdgePoint& p = e.points[e.points.size() / 2];
  // Along the ray from the left site: the right one's length changes by another amount.
  p.xyz += 2e-11 * (p.xyz - diagram_.sites[e.left].xyz).normalized();
  EXPECT_THAT(broken(), ElementsAre("radial lengths"));
}

TEST_F(BrokenDiagram, IsSeenByPlacesWhereAnAngleIsOff) {
  DiagramEdge& e = longest_edge();
  e.points[e.points.size() / 2].left_angle += 1e-7;
  EXPECT_THAT(broken(), Contains("places"));
}

TEST_F(BrokenDiagram, IsSeenByRadialLengthsWhereAVertexIsOff) {
  diagram_.vertices[0].radius *= 1.0 + 1e-10;
  const Certificate c = certificate(face_, diagram_);
  const CertificateClaim claim =
      *std::find_if(c.claims.begin(), c.claims.end(), [](const auto& one) { return one.name == "radial lengths"; });
  EXPECT_FALSE(claim.holds);
  EXPECT_EQ(claim.offender, CertificateClaim::Offender::Vertex);
  EXPECT_EQ(claim.id, 0);
}

TEST_F(BrokenDiagram, IsSeenBySectorsWhereGeneratorsStandInAnotherOrder) {
  for (DiagramVertex& v : diagram_.vertices) {
    if (v.on_boundary) continue;
    std::swap(v.angles[0], v.angles[1]);
    break;
  }
  EXPECT_THAT(broken(), Contains("sectors"));
}

TEST_F(BrokenDiagram, IsSeenByStarsWhereAnEdgeRunsTheOtherWay) {
  for (DiagramEdge& e : diagram_.edges) {
    std::reverse(e.points.begin(), e.points.end());
    std::swap(e.from, e.to);
    std::swap(e.left, e.right);
    for (EdgePoint& p : e.points) std::swap(p.left_angle, p.right_angle);
    for (DiagramVertex& v : diagram_.vertices)
      for (Spoke& s : v.spokes)
        if (&diagram_.edges[s.edge] == &e) s.at_end = !s.at_end;
    for (DiagramCell& cell : diagram_.cells)
      for (auto& loop : cell.loops)
        for (CellPiece& piece : loop)
          if (piece.edge >= 0 && &diagram_.edges[piece.edge] == &e) piece.reversed = !piece.reversed;
  }
  EXPECT_TRUE(certificate(face_, diagram_).holds()) << "a whole edge turned round is the same edge";
  for (DiagramEdge& e : diagram_.edges) {
    std::swap(e.left, e.right);
    for (EdgePoint& p : e.points) std::swap(p.left_angle, p.right_angle);
  }
  EXPECT_FALSE(certificate(face_, diagram_).holds());
}

// The face is said to be larger than the cells are.
TEST_F(BrokenDiagram, IsSeenByAreasWhereAPieceOfTheFaceHasNoCell) {
  const Certificate c =
      certify(face_.domain(), diagram_, {1.001 * face_area(face_.model, face_.model.faces[0]).value, 0.0});
  EXPECT_FALSE(c.holds());
  EXPECT_FALSE(c.claims.back().holds);
  EXPECT_EQ(c.claims.back().name, "areas");
  EXPECT_THAT(c.result, ::testing::StartsWith("not proved: areas"));
}

// The island of a bump left out: what remains is a diagram of one site without fault but for its area.
TEST(Certificate, MissesAnIslandThatIsLeftOut) {
  const GaussianBumps::Bump bump{{0, 0}, 3.0, 0.3};
  const TestFace face =
      whole(std::make_shared<GaussianBumps>(std::vector<GaussianBumps::Bump>{bump}, UvBox{{-2, 2}, {-2, 2}}));
  const VoronoiDiagram both = build_diagram(face.domain(), {{1.2, 0}, {0, 0}});
  EXPECT_TRUE(certificate(face, both).holds()) << certificate(face, both).result;
  VoronoiDiagram without = both;
  without.cells[0].loops.resize(1);
  without.edges.clear();
  without.vertices.clear();
  without.cells.pop_back();
  without.sites.pop_back();
  const Certificate c = certificate(face, without);
  EXPECT_FALSE(c.holds());
}

TEST(Certificate, NamesTheSitesWhosePathsLeaveTheFace) {
  TestFace face = plane_square();
  face.polygon({{-0.1, -0.6}, {-0.1, 0.6}, {0.1, 0.6}, {0.1, -0.6}});
  const Certificate c = certificate(face, build_diagram(face.domain(), {{-0.6, 0.0}, {0.2, 0.05}}));
  EXPECT_TRUE(c.holds()) << c.result;
  EXPECT_FALSE(c.not_covered.empty());
  EXPECT_THAT(c.result, ::testing::HasSubstr("leave the face"));
}

// A cell's area on the sphere: with two sites each has half of it, with one all.
TEST(CellAreas, OnASphereAreThoseOfGreatCircles) {
  const TestFace face = whole(std::make_shared<Sphere>(Frame{}, 2.0));
  for (const DiagramCell& cell : build_diagram(face.domain(), {{0.3, 0.4}, {2.0, -0.5}}).cells)
    EXPECT_NEAR(cell.area, 8.0 * kPi, 1e-6);
  EXPECT_NEAR(build_diagram(face.domain(), {{0.3, 0.4}}).cells[0].area, 16.0 * kPi, 1e-6);
}

// Six sites on the axes: by symmetry each has a sixth.
TEST(CellAreas, OfSixSitesOnASphereAreASixthEach) {
  const TestFace face = whole(std::make_shared<Sphere>(Frame{}, 1.0));
  const double half = 0.5 * kPi;
  const auto d = build_diagram(face.domain(), {{0, 0}, {half, 0}, {kPi, 0}, {3 * half, 0}, {0.3, half}, {0.3, -half}});
  for (const DiagramCell& cell : d.cells) EXPECT_NEAR(cell.area, 4.0 * kPi / 6.0, 1e-7);
}

// The line u = 0 halves the square.
TEST(CellAreas, OfHalvesOfASquareAreExact) {
  const TestFace face = plane_square();
  const auto d = build_diagram(face.domain(), {{-0.5, 0.3}, {0.5, 0.3}});
  for (const DiagramCell& cell : d.cells) EXPECT_NEAR(cell.area, 2.0, 1e-9);
}

}  // namespace
}  // namespace geovor::testing
