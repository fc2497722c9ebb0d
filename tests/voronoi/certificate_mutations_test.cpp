// A certificate says no to every diagram that is not what it was: finished ones, each spoiled in one place.
#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "brep/face_area.h"
#include "cell_labels.h"
#include "geodesic/distance.h"
#include "test_faces.h"
#include "voronoi/certificate.h"
#include "voronoi/diagram_builder.h"

namespace geovor::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Larger by far than the errors of a diagram (1e-12), smaller than its polylines' tolerance.
constexpr double kOff = 1e-6;

Area area_of(const TestFace& face) { return face_area(face.model, face.model.faces[0]); }

std::vector<std::string> broken_claims(const Certificate& certificate) {
  std::vector<std::string> names;
  for (const CertificateClaim& c : certificate.claims)
    if (!c.holds) names.push_back(c.name);
  return names;
}

/// A bowl with two holes: a small one within a cell, and a long one that paths must go around.
TestFace bowl_with_holes() {
  TestFace face(std::make_shared<Paraboloid>(UvBox{{-2, 2}, {-2, 2}}));
  face.rectangle(kSquare);
  face.polygon({{0.55, 0.55}, {0.55, 0.6}, {0.6, 0.6}, {0.6, 0.55}});
  face.polygon({{-0.5, -0.6}, {-0.5, 0.1}, {-0.4, 0.1}, {-0.4, -0.6}});
  return face;
}

const std::vector<Uv> kSites = {{0.7, 0.7},  {-0.7, -0.2}, {0.1, -0.3}, {-0.2, 0.6},
                                {0.6, -0.7}, {-0.7, 0.8},  {0.3, 0.2}};

struct Bowl {
  TestFace face = bowl_with_holes();
  FaceDomain domain = face.domain();
  VoronoiDiagram diagram = build_diagram(domain, kSites);
  Area area = area_of(face);
};

const Bowl& bowl() {
  static const Bowl made;
  return made;
}

// What a mutation takes: the first of its kind.
DiagramVertex& inner_vertex(VoronoiDiagram& d) {
  return *std::find_if(d.vertices.begin(), d.vertices.end(), [](const auto& v) { return !v.on_boundary; });
}
DiagramVertex& border_vertex(VoronoiDiagram& d) {
  return *std::find_if(d.vertices.begin(), d.vertices.end(), [](const auto& v) { return v.on_boundary; });
}
DiagramEdge& edge(VoronoiDiagram& d) {
  return *std::max_element(d.edges.begin(), d.edges.end(),
                           [](const auto& a, const auto& b) { return a.length < b.length; });
}
EdgePoint& inner_point(VoronoiDiagram& d) { return edge(d).points[edge(d).points.size() / 2]; }

/// The loop that is a whole cycle, and its cell.
std::pair<DiagramCell*, std::size_t> hole(VoronoiDiagram& d) {
  for (DiagramCell& cell : d.cells)
    for (std::size_t i = 0; i < cell.loops.size(); ++i)
      if (cell.loops[i].front().edge < 0 && cell.loops[i].front().from_vertex < 0) return {&cell, i};
  throw std::logic_error("no cell holds a whole hole");
}
CellPiece& stretch(VoronoiDiagram& d) {
  for (DiagramCell& cell : d.cells)
    for (auto& loop : cell.loops)
      for (CellPiece& piece : loop)
        if (piece.edge < 0 && piece.from_vertex >= 0 && piece.border_uv.size() > 4) return piece;
  throw std::logic_error("no stretch of border");
}

void remove_from_loops(VoronoiDiagram& d, int gone) {
  for (DiagramCell& cell : d.cells)
    for (auto& loop : cell.loops) std::erase_if(loop, [gone](const CellPiece& p) { return p.edge == gone; });
}

struct Mutation {
  const char* name;
  std::function<void(VoronoiDiagram&)> spoil;
};

const Mutation kMutations[] = {
    {"NaNInAVertexRadius", [](auto& d) { inner_vertex(d).radius = kNaN; }},
    {"NaNInAVertexAngle", [](auto& d) { inner_vertex(d).angles[1] = kNaN; }},
    {"NaNInAVertexPlace", [](auto& d) { inner_vertex(d).xyz.y() = kNaN; }},
    {"NaNInAVertexParameter", [](auto& d) { inner_vertex(d).uv.v = kNaN; }},
    {"NaNInAVertexResidual", [](auto& d) { inner_vertex(d).residual = kNaN; }},
    {"NaNInABorderParameter", [](auto& d) { border_vertex(d).border_parameter = kNaN; }},
    {"NaNInAnEdgeRadius", [](auto& d) { inner_point(d).radius = kNaN; }},
    {"NaNInAnEdgeLeftAngle", [](auto& d) { inner_point(d).left_angle = kNaN; }},
    {"NaNInAnEdgeRightAngle", [](auto& d) { inner_point(d).right_angle = kNaN; }},
    {"NaNInAnEdgePlace", [](auto& d) { inner_point(d).xyz.x() = kNaN; }},
    {"NaNInAnEdgeParameter", [](auto& d) { inner_point(d).uv.u = kNaN; }},
    {"NaNInAnEdgeSlope", [](auto& d) { inner_point(d).radius_slope = kNaN; }},
    {"NaNInAnEdgeLength", [](auto& d) { edge(d).length = kNaN; }},
    {"NaNInAnEdgeResidual", [](auto& d) { edge(d).residual = kNaN; }},
    {"NaNInASiteParameter", [](auto& d) { d.sites[2].uv.u = kNaN; }},
    {"NaNInASitePlace", [](auto& d) { d.sites[2].xyz.z() = kNaN; }},
    {"NaNInAnArea", [](auto& d) { d.cells[2].area = kNaN; }},
    {"NaNInAStretch", [](auto& d) { stretch(d).border_uv[2].u = kNaN; }},
    {"NaNInAStretchInSpace", [](auto& d) { stretch(d).border_xyz[2].x() = kNaN; }},
    {"NaNInTheTolerance", [](auto& d) { d.tolerance = kNaN; }},
    {"AnInfiniteRadius", [](auto& d) { inner_point(d).radius = kInfinite; }},
    {"ANegativeRadius", [](auto& d) { inner_point(d).radius *= -1.0; }},
    {"AnEdgeRemoved", [](auto& d) { d.edges.pop_back(); }},
    {"AnEdgeRemovedFromLoops", [](auto& d) { remove_from_loops(d, 3); }},
    {"AnEdgeWithoutItsLastPoint", [](auto& d) { edge(d).points.pop_back(); }},
    {"AnEdgeTurnedRound", [](auto& d) { std::reverse(edge(d).points.begin(), edge(d).points.end()); }},
    {"SitesSwapped", [](auto& d) { std::swap(d.sites[1], d.sites[2]); }},
    {"ASiteMoved",
     [](auto& d) {
       d.sites[2].uv.u += kOff;
       d.sites[2].xyz = bowl().domain.surface().position(d.sites[2].uv);
     }},
    {"ASiteMovedInSpace", [](auto& d) { d.sites[2].xyz.x() += kOff; }},
    {"TheHolesLoopDropped",
     [](auto& d) {
       const auto [cell, loop] = hole(d);
       cell->loops.erase(cell->loops.begin() + static_cast<std::ptrdiff_t>(loop));
     }},
    {"TheHolesLoopTwice",
     [](auto& d) {
       const auto [cell, loop] = hole(d);
       cell->loops.push_back(std::vector(cell->loops[loop]));
     }},
    {"TheHolesLoopInAnotherCell",
     [](auto& d) {
       const auto [cell, loop] = hole(d);
       DiagramCell& other = d.cells[(static_cast<std::size_t>(cell->site) + 1) % d.cells.size()];
       other.loops.push_back(cell->loops[loop]);
       cell->loops.erase(cell->loops.begin() + static_cast<std::ptrdiff_t>(loop));
     }},
    {"AVertexMovedInSpace", [](auto& d) { inner_vertex(d).xyz.x() += kOff; }},
    {"AVertexMovedInItsParameters", [](auto& d) { inner_vertex(d).uv.u += kOff; }},
    {"AVertexMoved",
     [](auto& d) {
       inner_vertex(d).uv.u += kOff;
       inner_vertex(d).xyz = bowl().domain.surface().position(inner_vertex(d).uv);
     }},
    {"AVertexFartherFromItsSites", [](auto& d) { inner_vertex(d).radius += kOff; }},
    {"AVertexSeenAtAnotherAngle", [](auto& d) { inner_vertex(d).angles[0] += kOff; }},
    {"AVertexMovedAlongTheBorder", [](auto& d) { border_vertex(d).border_parameter += 1e-4; }},
    {"AVertexOffTheBorder", [](auto& d) { border_vertex(d).border_cycle += 1; }},
    {"AnInnerPointMovedInSpace", [](auto& d) { inner_point(d).xyz.x() += kOff; }},
    {"AnInnerPointMovedInItsParameters", [](auto& d) { inner_point(d).uv.u += kOff; }},
    {"AnInnerPointMoved",
     [](auto& d) {
       inner_point(d).uv.u += kOff;
       inner_point(d).xyz = bowl().domain.surface().position(inner_point(d).uv);
     }},
    {"AnInnerPointFartherFromItsSites", [](auto& d) { inner_point(d).radius += kOff; }},
    {"AnInnerPointSeenAtAnotherAngle", [](auto& d) { inner_point(d).right_angle += kOff; }},
    {"AStretchBesideTheBorder", [](auto& d) { stretch(d).border_uv[2].u += 1e-4, stretch(d).border_uv[2].v += 1e-4; }},
    {"AStretchBesideTheBorderInSpace", [](auto& d) { stretch(d).border_xyz[2].z() += 1e-4; }},
    {"AStretchWithoutAPoint",
     [](auto& d) {
       stretch(d).border_uv.erase(stretch(d).border_uv.begin() + 1);
       stretch(d).border_xyz.erase(stretch(d).border_xyz.begin() + 1);
     }},
    {"AStretchOfAnotherCycle", [](auto& d) { stretch(d).border_cycle += 1; }},
    {"AWarningDeleted", [](auto& d) { d.warnings.clear(); }},
    {"AnAreaOff", [](auto& d) { d.cells[1].area *= 1.0 + 1e-4; }},
    {"ALengthOff", [](auto& d) { edge(d).length *= 1.0 + 1e-4; }},
};

class SpoiledDiagram : public ::testing::TestWithParam<Mutation> {};

TEST_P(SpoiledDiagram, IsNotProved) {
  VoronoiDiagram d = bowl().diagram;
  GetParam().spoil(d);
  const Certificate c = certify(bowl().domain, d, bowl().area);
  EXPECT_FALSE(c.holds());
  EXPECT_THAT(c.result, ::testing::StartsWith("not proved"));
}

INSTANTIATE_TEST_SUITE_P(By, SpoiledDiagram, ::testing::ValuesIn(kMutations),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(UnspoiledDiagram, IsProvedAndNamesTheSitesWhosePathsGoAroundAHole) {
  const Certificate c = certify(bowl().domain, bowl().diagram, bowl().area);
  EXPECT_TRUE(c.holds()) << c.result;
  EXPECT_THAT(c.not_covered, Contains(1));
}

// Without measuring there are no warnings: the certificate looks for itself.
TEST(UnmeasuredDiagram, HasTheSameSitesNotCovered) {
  VoronoiOptions options;
  options.measure = false;
  const VoronoiDiagram d = build_diagram(bowl().domain, kSites, options);
  ASSERT_TRUE(d.warnings.empty());
  const Certificate c = certify(bowl().domain, d, bowl().area);
  EXPECT_TRUE(c.holds()) << c.result;
  EXPECT_EQ(c.not_covered, certify(bowl().domain, bowl().diagram, bowl().area).not_covered);
  EXPECT_THAT(c.result, HasSubstr("leave the face"));
}

// Brute force sees it too where a cell lacks a loop.
TEST(BruteForceLabels, SeeALoopThatIsMissing) {
  TestFace face = plane_square();
  face.polygon({{0.2, 0.2}, {0.2, 0.7}, {0.7, 0.7}, {0.7, 0.2}});
  const FaceDomain domain = face.domain();
  const VoronoiDiagram d = build_diagram(domain, {{0.45, 0.1}, {-0.9, -0.6}, {0.8, -0.95}, {-0.8, 0.7}});
  const DistanceFinder finder(domain.surface());
  const auto wrong = [&](const VoronoiDiagram& of) {
    return compare_with_brute_force(domain, of, shortest_by(finder), 1000, 1).wrong;
  };
  EXPECT_EQ(wrong(d), 0);
  int loops = 0;
  for (std::size_t c = 0; c < d.cells.size(); ++c) {
    for (std::size_t i = 0; i < d.cells[c].loops.size(); ++i, ++loops) {
      VoronoiDiagram without = d;
      without.cells[c].loops.erase(without.cells[c].loops.begin() + static_cast<std::ptrdiff_t>(i));
      EXPECT_GT(wrong(without), 0) << "cell " << c << ", loop " << i;
    }
  }
  EXPECT_EQ(loops, 5);
}

// Every cell and its area are right, each hole is some cell's loop, but an edge runs through one.
TEST(AHoleAcrossAnEdge, IsSeenByTheEdgesPoints) {
  const TestFace without = plane_square();
  TestFace with = plane_square();
  with.polygon({{-0.01, 0.3}, {-0.01, 0.301}, {0.01, 0.301}, {0.01, 0.3}});
  VoronoiDiagram d = build_diagram(without.domain(), {{-0.5, 0.0}, {0.5, 0.0}});
  const VoronoiDiagram other = build_diagram(with.domain(), {{-0.5, 0.9}});
  d.cells[0].loops.push_back(other.cells[0].loops.back());
  for (DiagramCell& cell : d.cells) cell.area = 0.0;
  EXPECT_THAT(broken_claims(certify(with.domain(), d, area_of(with))), Contains("in the face"));
}

TEST(FacesArea, MustBeKnown) {
  for (const Area area : {Area{0.0, 0.0}, Area{-1.0, 0.0}, Area{kNaN, 0.0}, Area{bowl().area.value, kNaN},
                          Area{bowl().area.value, 1e-3 * bowl().area.value}, Area{kInfinite, 0.0}}) {
    EXPECT_EQ(broken_claims(certify(bowl().domain, bowl().diagram, area)), std::vector<std::string>{"areas"})
        << area.value << " " << area.error;
  }
}

// A site alone on a sphere with a hole: its cell is all of it, the hole's loop goes around the hole and not the site.
// A hole about the antipode is gone around by the cell itself.
TEST(ASphereWithAHole, IsProvedForOneSite) {
  const double opposite = 0.3 + kPi;
  for (const double u : {0.6, 1.0, 2.0 * kPi - 1.0, opposite - 0.5, opposite}) {
    TestFace face(std::make_shared<Sphere>(Frame{}, 1.0));
    face.ring({{0.0, 2.0 * kPi}, {-0.5 * kPi, 0.5 * kPi}});
    const double w = 0.1, v = -0.4;
    face.polygon({{u - w, v - w}, {u - w, v + w}, {u + w, v + w}, {u + w, v - w}});
    const VoronoiDiagram d = build_diagram(face.domain(), {{0.3, 0.4}});
    EXPECT_NEAR(d.cells[0].area, 4.0 * kPi - 2.0 * w * (std::sin(v + w) - std::sin(v - w)), 1e-6) << u;
    EXPECT_EQ(d.vertices.size(), u == opposite ? 0U : 1U) << u;
    const Certificate c = certify(face.domain(), d, area_of(face));
    EXPECT_TRUE(c.holds()) << u << ": " << c.result;
    VoronoiDiagram without = d;
    without.vertices.clear();
    EXPECT_EQ(certify(face.domain(), without, area_of(face)).holds(), u == opposite) << u;
  }
}

// Its ray is right, but nothing ends there.
TEST(AVertexWithoutEdges, IsNoVertexOfAPlane) {
  const TestFace face = plane_square();
  VoronoiDiagram d = build_diagram(face.domain(), {{0.1, 0.2}});
  DiagramVertex v;
  v.uv = {0.1, 0.7}, v.xyz = {0.1, 0.7, 0.0}, v.radius = 0.5, v.sites = {0}, v.angles = {0.5 * kPi};
  EXPECT_TRUE(certify(face.domain(), d, area_of(face)).holds());
  d.vertices.push_back(v);
  EXPECT_EQ(broken_claims(certify(face.domain(), d, area_of(face))), std::vector<std::string>{"corners"});
}

}  // namespace
}  // namespace geovor::testing
