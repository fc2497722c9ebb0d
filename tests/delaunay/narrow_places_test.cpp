#include "delaunay/narrow_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "delaunay/border.h"
#include "delaunay/face_mesh.h"
#include "delaunay/meshing_faces.h"
#include "mesh/mesh_checks.h"

namespace geovor {
namespace {

using namespace testing;

CadModel polygon(const std::vector<Uv>& corners) {
  std::vector<Corner> numbered;
  for (const Uv& c : corners) numbered.push_back({c, static_cast<int>(numbered.size())});
  return one_face(std::make_shared<Plane>(origin_frame()), numbered);
}

BorderPoints border_of(const CadModel& model, const SizeRule& rule) {
  return sample_border(model, rule, std::vector<double>(model.edges.size(), 1.0));
}

TriangleMesh mesh_of(const CadModel& model, const SizeRule& rule) {
  const BorderPoints border = border_of(model, rule);
  const FaceMesh face = mesh_face(model.faces[0], border, rule);
  EXPECT_TRUE(face.ok) << face.why;
  TriangleMesh mesh;
  mesh.points = border.points;
  mesh.points.insert(mesh.points.end(), face.inner.begin(), face.inner.end());
  for (auto t : face.triangles) {
    for (int& c : t) c = c < 0 ? static_cast<int>(border.points.size()) - 1 - c : c;
    mesh.triangles.push_back(t);
    mesh.face_of.push_back(1);
  }
  return mesh;
}

std::vector<double> steps(const BorderPoints& border, int edge) {
  const std::vector<int>& p = border.edges[edge].points;
  std::vector<double> lengths;
  for (size_t i = 0; i + 1 < p.size(); ++i) lengths.push_back((border.points[p[i + 1]] - border.points[p[i]]).norm());
  return lengths;
}

// The longest segment of the edge that comes within `reach` of x.
double longest_near(const BorderPoints& border, int edge, const Xyz& x, double reach) {
  const std::vector<int>& p = border.edges[edge].points;
  double longest = 0.0;
  for (size_t i = 0; i + 1 < p.size(); ++i) {
    const Xyz a = border.points[p[i]], d = border.points[p[i + 1]] - a;
    const double part = std::clamp((x - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
    if ((a + part * d - x).norm() < reach) longest = std::max(longest, d.norm());
  }
  return longest;
}

TEST(NarrowPlaces, LeaveAWideFaceAlone) {
  const BorderPoints border = border_of(polygon({{0, 0}, {10, 0}, {10, 10}, {0, 10}}), SizeRule{1.0, 0.05});
  for (int e = 0; e < 4; ++e) EXPECT_EQ(steps(border, e).size(), 10u);
}

// Equal steps no longer than 1.5 times the width; triangles across it have angles of 30 degrees and more.
TEST(NarrowPlaces, GiveAStripStepsOfItsWidth) {
  for (double width : {0.2, 0.31, 0.5}) {
    const CadModel model = polygon({{0, 0}, {10, 0}, {10, width}, {0, width}});
    const SizeRule rule{1.0, 0.05};
    const BorderPoints border = border_of(model, rule);
    for (int e : {0, 2}) {
      const std::vector<double> lengths = steps(border, e);
      EXPECT_LE(*std::max_element(lengths.begin(), lengths.end()), 1.02 * kLengthPerGap * width);
      EXPECT_GE(lengths[lengths.size() / 2], 0.95 * kLengthPerGap * width);
    }
    EXPECT_GE(quality(mesh_of(model, rule)).smallest_angle, 30.0) << width;
  }
}

// Two plates of 6 x 6 with a bridge of the width 0.2 and the length 2 between them.
TEST(NarrowPlaces, MakeABridgeFineAndThePlatesBesideItCoarse) {
  const CadModel model = polygon(
      {{0, 0}, {6, 0}, {6, 2.9}, {8, 2.9}, {8, 0}, {14, 0}, {14, 6}, {8, 6}, {8, 3.1}, {6, 3.1}, {6, 6}, {0, 6}});
  const SizeRule rule{1.0, 0.05};
  const BorderPoints border = border_of(model, rule);
  for (int e : {2, 8}) {
    const std::vector<double> lengths = steps(border, e);
    EXPECT_LE(*std::max_element(lengths.begin(), lengths.end()), 1.02 * kLengthPerGap * 0.2);
  }
  EXPECT_EQ(steps(border, 11).size(), 6u);
  EXPECT_GE(quality(mesh_of(model, rule)).smallest_angle, 28.0);
}

// A square hole stands on its corner, 0.1 above the lower side: the corner has the whole plate before it, and what the
// side sees of it lies right above.
TEST(NarrowPlaces, SeeTheCornerOfAHoleNearTheEdge) {
  CadModel model = polygon({{0, 0}, {10, 0}, {10, 10}, {0, 10}});
  add_polygon(model, {{{5, 0.1}, 4}, {{4, 1.1}, 5}, {{5, 2.1}, 6}, {{6, 1.1}, 7}});
  const SizeRule rule{1.0, 0.05};
  const BorderPoints border = border_of(model, rule);
  EXPECT_LE(longest_near(border, 0, {5, 0, 0}, 0.01), 1.3 * kLengthPerGap * 0.1);
  // Steps grow by the gradation, exp(0.5) - 1 in 0.5 for the first, and 3.5 of them make 3.
  EXPECT_LE(steps(border, 4).front(), 1.6 * kLengthPerGap * 0.1);
  EXPECT_GT(steps(border, 5).back(), 0.5);  // on the far side it is as coarse as its edges' lengths allow
  EXPECT_EQ(steps(border, 2).size(), 10u);
  EXPECT_GE(quality(mesh_of(model, rule)).smallest_angle, 25.0);
}

// A hole of 0.1 x 0.1 lies 0.4 above the lower side, which is to be 0.1 + 0.5 * 0.4 there; 0.4 alone asks for 0.6.
TEST(NarrowPlaces, GradeSizesAcrossTheFace) {
  CadModel model = polygon({{0, 0}, {10, 0}, {10, 10}, {0, 10}});
  add_polygon(model, {{{5, 0.4}, 4}, {{5, 0.5}, 5}, {{5.1, 0.5}, 6}, {{5.1, 0.4}, 7}});
  SizeRule rule{1.0, 0.05};
  rule.gradation = 0.5;
  const double longest = longest_near(border_of(model, rule), 0, {5.05, 0, 0}, 0.01);
  EXPECT_LE(longest, 1.3 * 0.3);
  EXPECT_GE(longest, 0.9 * 0.3);
}

// The two sides of a thin notch are near each other with nothing of the face between them.
TEST(NarrowPlaces, AreNotSeenAcrossTheOutside) {
  const BorderPoints border =
      border_of(polygon({{0, 0}, {10, 0}, {10, 8}, {5.05, 8}, {5, 4}, {4.95, 8}, {0, 8}}), SizeRule{1.0, 0.05});
  EXPECT_EQ(steps(border, 3).size(), 4u);
  EXPECT_EQ(steps(border, 4).size(), 4u);
}

// The one triangle in the corner is isosceles and has its angle; all others do better than the corner does.
TEST(NarrowPlaces, GiveASharpCornerOneTriangle) {
  for (double degrees : {8.0, 15.0, 22.0, 28.0}) {
    const double angle = degrees * kPi / 180.0;
    const CadModel model = polygon({{0, 0}, {8, 0}, {8 * std::cos(angle), 8 * std::sin(angle)}});
    const SizeRule rule{1.0, 0.05};
    const BorderPoints border = border_of(model, rule);
    EXPECT_NEAR(steps(border, 0).front(), steps(border, 2).back(), 1e-9);
    const TriangleMesh mesh = mesh_of(model, rule);
    std::vector<double> angles;
    for (const auto& t : mesh.triangles) {
      TriangleMesh one;
      one.points = mesh.points;
      one.triangles = {t};
      one.face_of = {1};
      angles.push_back(quality(one).smallest_angle);
    }
    std::sort(angles.begin(), angles.end());
    EXPECT_NEAR(angles[0], degrees, 1e-6);
    EXPECT_GE(angles[1], 24.0) << degrees;
  }
}

TEST(NarrowPlaces, ListSharpCornersWithTheirAngles) {
  const double angle = 20.0 * kPi / 180.0;
  const CadModel model = polygon({{0, 0}, {8, 0}, {8 * std::cos(angle), 8 * std::sin(angle)}});
  const auto one_by_one = [](int n, const std::function<void(int)>& body) {
    for (int i = 0; i < n; ++i) body(i);
  };
  const BorderSampler sampler(model, {SizeRule{1.0, 0.05}}, one_by_one);
  ASSERT_EQ(sampler.sharp_corners().size(), 1u);
  EXPECT_NEAR(sampler.sharp_corners()[0].angle, angle, 1e-9);
  EXPECT_EQ(sampler.sharp_corners()[0].vertex, 0);
}

// Below the smallest size nothing helps, and nothing is made finer.
TEST(NarrowPlaces, NeverAskForLessThanTheSmallestSize) {
  const BorderPoints fine = border_of(polygon({{0, 0}, {10, 0}, {10, 0.2}, {0, 0.2}}), SizeRule{1.0, 0.4});
  EXPECT_NEAR(static_cast<double>(steps(fine, 0).size()), 25.0, 1.0);
  const BorderPoints hopeless = border_of(polygon({{0, 0}, {10, 0}, {10, 0.05}, {0, 0.05}}), SizeRule{1.0, 0.4});
  EXPECT_GT(steps(hopeless, 0)[7], 0.5);
}

}  // namespace
}  // namespace geovor
