// Sites of grids that are moved by next to nothing: vertices of four cells come apart into two that are as near.
#include <gtest/gtest.h>

#include <algorithm>

#include "diagram_laws.h"
#include "test_faces.h"
#include "voronoi/diagram_builder.h"

namespace geovor::testing {
namespace {

struct Grid {
  const char* name;
  TestFace face;
  std::vector<Uv> sites;
};

std::vector<Uv> grid(UvBox box, int columns, int rows) {
  std::vector<Uv> sites;
  for (int i = 0; i < columns; ++i) {
    for (int k = 0; k < rows; ++k) {
      sites.push_back({box.u.lo + box.u.length() * i / columns, box.v.lo + box.v.length() * k / rows});
    }
  }
  return sites;
}

std::vector<Grid> grids() {
  const double all_round = 2.0 * kPi;
  const UvBox square{{-2.0, 2.0}, {-2.0, 2.0}};
  std::vector<Grid> out;
  out.push_back({"plane", plane_square(), grid({{-0.8, 1.12}, {-0.8, 1.12}}, 6, 6)});
  TestFace tube(std::make_shared<Cylinder>(Frame{}, 1.0));
  tube.ring({{0.0, all_round}, {0.0, 3.0}});
  out.push_back({"tube", tube, grid({{0.0, all_round}, {0.5, 3.0}}, 8, 5)});
  out.push_back({"sphere", whole(std::make_shared<Sphere>(Frame{}, 1.0)), grid({{0.0, all_round}, {-1.0, 1.5}}, 8, 5)});
  out.push_back(
      {"torus", whole(std::make_shared<Torus>(Frame{}, 3.0, 1.0)), grid({{0.0, all_round}, {0.0, all_round}}, 8, 6)});
  out.push_back({"wave", whole(std::make_shared<WaveSurface>(square)), grid({{-1.6, 2.24}, {-1.6, 2.24}}, 6, 6)});
  return out;
}

double worst_residual(const VoronoiDiagram& d) {
  double worst = 0.0;
  for (const DiagramVertex& v : d.vertices) worst = std::max(worst, v.residual);
  for (const DiagramEdge& e : d.edges) worst = std::max(worst, e.residual);
  return worst;
}

class NearTies : public ::testing::TestWithParam<double> {};

TEST_P(NearTies, AreResolved) {
  const double noise = GetParam();
  for (Grid& g : grids()) {
    Uniform random(5);
    for (Uv& p : g.sites) p = {p.u + noise * (random() - 0.5), p.v + noise * (random() - 0.5)};
    const VoronoiDiagram d = build_diagram(g.face.domain(), g.sites);
    EXPECT_TRUE(d.warnings.empty()) << g.name << ": " << d.warnings.front().text;
    EXPECT_EQ(broken_topology(d), "") << g.name;
    EXPECT_EQ(unproved(g.face, d), "") << g.name;
    EXPECT_LE(worst_residual(d), 1e-12) << g.name;
  }
}

/// Sites on an arc about a point of the border of the square [-1, 1]^2: their cells meet there, or almost.
std::vector<Uv> sites_about(Uv centre, double first, double last, int count, double noise, Uniform& random) {
  std::vector<Uv> sites;
  for (int k = 0; k < count; ++k) {
    const double t = first + (last - first) * k / (count - 1);
    sites.push_back({centre.u + 0.5 * std::cos(t) + noise * (random() - 0.5),
                     centre.v + 0.5 * std::sin(t) + noise * (random() - 0.5)});
  }
  return sites;
}

TEST_P(NearTies, AreResolvedOnTheBorderAndInACorner) {
  struct Arc {
    Uv centre;
    double first, last;
  };
  const Arc arcs[] = {{{0.1, 1.0}, kPi + 0.3, 2.0 * kPi - 0.4},
                      {{1.0, 1.0}, kPi + 0.1, 1.5 * kPi - 0.2},
                      {{-1.0, 0.2}, -0.5 * kPi + 0.3, 0.5 * kPi - 0.2}};
  const TestFace face = plane_square();
  for (const Arc& arc : arcs) {
    for (int count : {2, 3, 4, 6}) {
      Uniform random(static_cast<unsigned>(count));
      const VoronoiDiagram d =
          build_diagram(face.domain(), sites_about(arc.centre, arc.first, arc.last, count, GetParam(), random));
      EXPECT_TRUE(d.warnings.empty()) << count << " sites: " << d.warnings.front().text;
      EXPECT_EQ(broken_topology(d), "");
      EXPECT_EQ(unproved(face, d), "");
      EXPECT_LE(worst_residual(d), 1e-12);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Noise, NearTies, ::testing::Values(0.0, 1e-14, 3e-13, 1e-12, 3e-12, 1e-11, 1e-10, 1e-9, 1e-7));

// The bisector of two of the sites touches a corner of the hole: it ends there from both sides.
TEST(NearTies, AnEdgeThatTouchesACornerEndsThereTwice) {
  TestFace face = plane_square();
  face.polygon({{-0.3, -0.2}, {-0.3, 0.3}, {0.2, 0.3}, {0.2, -0.2}});
  std::vector<Uv> sites;
  for (int k = 5; k < 18; ++k) {
    const Uv p{0.4 + 0.4 * std::cos(kPi * k / 6.0), 0.4 * std::sin(kPi * k / 6.0)};
    if (face.domain().contains(p)) sites.push_back(p);
  }
  const VoronoiDiagram d = build_diagram(face.domain(), sites);
  EXPECT_EQ(broken_topology(d), "");
  EXPECT_EQ(unproved(face, d), "");
  const Uv corner{0.2, -0.2};
  EXPECT_EQ(
      std::count_if(d.vertices.begin(), d.vertices.end(),
                    [&](const DiagramVertex& v) { return std::hypot(v.uv.u - corner.u, v.uv.v - corner.v) < 1e-12; }),
      2);
}

}  // namespace
}  // namespace geovor::testing
