// Where shortest paths leave the face. Expected values are closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "surface/elementary_curves.h"
#include "test_faces.h"
#include "voronoi/diagram_builder.h"

namespace geovor::testing {
namespace {

void add_circle(TestFace& face, Uv c, double r, bool hole) {
  auto circle = std::make_shared<Circle<2>>(ConicFrame<2>{{c.u, c.v}, {1, 0}, {0, 1}}, r);
  face.model.faces[0].loops.push_back({{{face.edge(), circle, {0.0, 2.0 * kPi}, hole}}});
}

std::vector<DiagramWarning> leaving(const TestFace& face, const std::vector<Uv>& sites) {
  std::vector<DiagramWarning> out;
  for (const DiagramWarning& w : build_diagram(face.domain(), sites).warnings) {
    EXPECT_NE(w.kind, "unresolved") << w.text;
    if (w.kind == "path_leaves_face") out.push_back(w);
  }
  return out;
}

/// The place that the text names.
Uv back_of(const DiagramWarning& w) {
  Uv back;
  const auto at = w.text.find("= (");
  EXPECT_EQ(std::sscanf(w.text.c_str() + at, "= (%lf, %lf)", &back.u, &back.v), 2) << w.text;
  return back;
}

TEST(PathLeavesFace, AHoleInOneCellIsNamedOnceWithBothPlaces) {
  const Uv site = {-0.6, 0.1}, centre = {0.1, -0.05};
  constexpr double kRadius = 0.2;
  TestFace face = plane_square();
  add_circle(face, centre, kRadius, true);
  const auto w = leaving(face, {site});
  ASSERT_EQ(w.size(), 1u);
  EXPECT_EQ(w[0].sites, std::vector<int>{0});
  const Uv out = w[0].uv, back = back_of(w[0]);
  EXPECT_NEAR(std::hypot(out.u - centre.u, out.v - centre.v), kRadius, 1e-5);
  EXPECT_NEAR(std::hypot(back.u - centre.u, back.v - centre.v), kRadius, 1e-5);
  // On one line with the site, the place of leaving nearer by.
  EXPECT_NEAR(cross(out - site, back - site), 0.0, 1e-5);
  const double to_out = std::hypot(out.u - site.u, out.v - site.v),
               to_back = std::hypot(back.u - site.u, back.v - site.v);
  EXPECT_LT(to_out, to_back);
  // Nearly a diameter: the longest excursion there is.
  EXPECT_GT(to_back - to_out, 1.9 * kRadius);
}

TEST(PathLeavesFace, EveryHoleInTheWayIsNamedAndNoOther) {
  // Two holes in the left cell; one that the bisector x = 0 cuts. Of that each site sees the circle up to its tangents,
  // which touch it at a distance of 0.21 / 0.5 = 0.42 in x: behind them, above and below, lie two backs for each.
  TestFace face = plane_square();
  add_circle(face, {-0.3, 0.5}, 0.1, true);
  add_circle(face, {-0.7, -0.5}, 0.1, true);
  add_circle(face, {0.0, 0.0}, 0.2, true);
  std::map<int, int> times;
  for (const auto& w : leaving(face, {{-0.5, 0.0}, {0.5, 0.0}})) ++times[w.sites.at(0)];
  EXPECT_EQ(times, (std::map<int, int>{{0, 4}, {1, 2}}));
}

// A border that bulges into the face hides what lies along it from a site beside it.
TEST(PathLeavesFace, ASiteBesideAHollowRimSeesRoundNoCorner) {
  TestFace ring(std::make_shared<Plane>(Frame{}));
  add_circle(ring, {0, 0}, 1.0, false);
  add_circle(ring, {0, 0}, 0.5, true);
  EXPECT_EQ(leaving(ring, {{0.51, 0.0}}).size(), 1u);
  // Each of six sites has 30 degrees of the rim on both sides, and sees 11 (cos 11.4 = 0.5 / 0.51): two backs for each.
  std::vector<Uv> six;
  for (int i = 0; i < 6; ++i) six.push_back({0.51 * std::cos(i * kPi / 3), 0.51 * std::sin(i * kPi / 3)});
  EXPECT_EQ(leaving(ring, six).size(), 12u);
}

TEST(PathLeavesFace, SitesOnStraightAndBulgingBordersSeeAll) {
  TestFace disk(std::make_shared<Plane>(Frame{}));
  add_circle(disk, {0, 0}, 1.0, false);
  EXPECT_TRUE(leaving(disk, {{1.0, 0.0}, {0.0, 1.0}, {-0.3, -0.2}}).empty());
  EXPECT_TRUE(leaving(plane_square(), {{0.3, -1.0}, {-0.5, 1.0}, {1.0, 1.0}}).empty());
}

// A cylinder unrolls: the same holes, one across the seam.
TEST(PathLeavesFace, AHoleAcrossASeamIsNamedOnce) {
  TestFace face = TestFace(std::make_shared<Cylinder>(Frame{}, 1.0)).ring({{0.0, 2.0 * kPi}, {0.0, 3.0}});
  // Two half circles at the seam u = 0, the hole's border is open in the parameter plane at both sides.
  auto& loops = face.model.faces[0].loops;
  loops.clear();
  loops.emplace_back();
  const int bottom = face.edge(), low = face.edge(), high = face.edge(), top = face.edge(), right = face.edge(),
            left = face.edge();
  const double u1 = 2.0 * kPi;
  const auto arc = [](Uv c) { return std::make_shared<Circle<2>>(ConicFrame<2>{{c.u, c.v}, {1, 0}, {0, 1}}, 0.3); };
  face.side(bottom, {0, 0}, {u1, 0});
  face.side(low, {u1, 0}, {u1, 1.2});
  loops[0].coedges.push_back({left, arc({u1, 1.5}), {0.5 * kPi, 1.5 * kPi}, true});
  face.side(high, {u1, 1.8}, {u1, 3});
  face.side(top, {u1, 3}, {0, 3});
  face.side(high, {0, 1.8}, {0, 3}, true);
  loops[0].coedges.push_back({right, arc({0, 1.5}), {-0.5 * kPi, 0.5 * kPi}, true});
  face.side(low, {0, 0}, {0, 1.2}, true);
  const auto w = leaving(face, {{5.5, 1.5}, {2.5, 1.5}, {1.0, 0.2}, {1.0, 2.8}});
  ASSERT_EQ(w.size(), 1u);
  EXPECT_EQ(w[0].sites, std::vector<int>{0});
  EXPECT_NEAR(std::hypot(w[0].uv.u - u1, w[0].uv.v - 1.5), 0.3, 1e-4);
}

}  // namespace
}  // namespace geovor::testing
