#include "delaunay/border.h"

#include <gtest/gtest.h>

#include <cmath>

#include "delaunay/meshing_faces.h"

namespace geovor {
namespace {

using namespace testing;

TEST(SizeRule, FollowsTheSmallestOfItsParts) {
  SizeRule rule{2.0, 0.1};
  rule.angle = 0.3;
  rule.deflection = 0.01;
  EXPECT_DOUBLE_EQ(rule.at(0.0), 2.0);
  EXPECT_DOUBLE_EQ(rule.at(0.75), 0.2);  // sqrt(3 * 0.01 / 0.75) < 0.3 / 0.75
  rule.angle = 0.12;
  EXPECT_DOUBLE_EQ(rule.at(1.0), 0.12);    // 0.12 / 1 < sqrt(3 * 0.01 / 1)
  EXPECT_DOUBLE_EQ(rule.at(1000.0), 0.1);  // never below the smallest size
}

// The parallel at latitude 1 of a sphere of radius 2 is a circle of radius 2 cos 1.
TEST(SampleBorder, DividesACircleIntoEqualArcsOfTheSize) {
  const double radius = 2.0, r = radius * std::cos(1.0);
  const CadModel model = one_face(std::make_shared<Sphere>(origin_frame(), radius),
                                  {{{0, 1}, 0}, {{2 * kPi, 1}, 0}, {{2 * kPi, kPi / 2}, 1}, {{0, kPi / 2}, 1}});
  const SizeRule rule{0.1};
  const BorderPoints border = sample_border(model, rule, std::vector<double>(model.edges.size(), 1.0));
  const auto& circle = border.edges[0];
  const int n = static_cast<int>(circle.points.size()) - 1;
  EXPECT_EQ(n, std::lround(2 * kPi * r / 0.1));
  EXPECT_EQ(circle.points.front(), circle.points.back());
  for (int i = 0; i < n; ++i) {
    const double chord = (border.points[circle.points[i + 1]] - border.points[circle.points[i]]).norm();
    EXPECT_NEAR(chord, 2 * r * std::sin(kPi / n), 1e-9);
  }
}

TEST(SampleBorder, MeetsThePoleInOnePoint) {
  const CadModel model = whole_sphere(1.0);
  const BorderPoints border = sample_border(model, SizeRule{0.2}, std::vector<double>(model.edges.size(), 1.0));
  int poles = 0;
  for (size_t e = 0; e < model.edges.size(); ++e) {
    if (!model.edges[e].degenerate()) continue;
    ASSERT_EQ(border.edges[e].points.size(), 1u);
    EXPECT_NEAR(std::abs(border.points[border.edges[e].points[0]].z()), 1.0, 1e-15);
    ++poles;
  }
  EXPECT_EQ(poles, 2);
}

// Beside a short edge the points stand closer, and the steps grow no faster than the gradation allows.
TEST(SampleBorder, GrowsAwayFromAShortEdgeAtTheGradation) {
  const CadModel model = one_face(std::make_shared<Plane>(origin_frame()),
                                  {{{0, 0}, 0}, {{10, 0}, 1}, {{10, 10}, 2}, {{0.05, 10}, 3}, {{0, 9.95}, 4}});
  SizeRule rule{1.0, 0.0};
  rule.gradation = 0.3;
  const BorderPoints border = sample_border(model, rule, std::vector<double>(model.edges.size(), 1.0));
  const auto& top = border.edges[2];  // from (10, 10) to the short edge
  double last = 0.0;
  for (size_t i = 0; i + 1 < top.points.size(); ++i) {
    const double step = (border.points[top.points[i + 1]] - border.points[top.points[i]]).norm();
    if (i > 0) {
      EXPECT_LT(last, step * (1.0 + 1.2 * rule.gradation)) << i;
    }
    last = step;
  }
  EXPECT_LT(last, 0.12);
}

TEST(SampleBorder, KeepsAHoleRoundHoweverCoarseTheSize) {
  const CadModel model = one_face(std::make_shared<Sphere>(origin_frame(), 1.0),
                                  {{{0, 1}, 0}, {{2 * kPi, 1}, 0}, {{2 * kPi, kPi / 2}, 1}, {{0, kPi / 2}, 1}});
  const BorderPoints border =
      sample_border(model, SizeRule{100.0, 100.0}, std::vector<double>(model.edges.size(), 1.0));
  EXPECT_GE(border.edges[0].points.size(), 9u);
}

BorderSampler::ForEach backwards() {
  return [](int n, const std::function<void(int)>& body) {
    for (int i = n - 1; i >= 0; --i) body(i);
  };
}

// Two squares side by side, the left one with a rule of its own.
TEST(BorderSampler, GivesACommonEdgeTheFinerOfTwoRules) {
  CadModel model =
      one_face(std::make_shared<Plane>(origin_frame()), {{{0, 0}, 0}, {{1, 0}, 1}, {{1, 1}, 2}, {{0, 1}, 3}});
  CadModel right =
      one_face(std::make_shared<Plane>(origin_frame()), {{{1, 0}, 1}, {{2, 0}, 4}, {{2, 1}, 5}, {{1, 1}, 2}});
  CadFace face = right.faces[0];
  for (Coedge& c : face.loops[0].coedges) c.edge += 4;
  face.loops[0].coedges[3] = {1, std::make_shared<Segment>(Uv{1, 0}, Uv{1, 1}), {0, 1}, true};
  model.vertices.resize(6);
  model.edges.insert(model.edges.end(), right.edges.begin(), right.edges.end());
  model.faces.push_back(face);
  SizeRule coarse{0.5}, fine{0.1};
  coarse.gradation = fine.gradation = 0.2;
  const BorderSampler sampler(model, {fine, coarse}, backwards());
  const BorderPoints border = sampler.sample(std::vector<double>(8, 1.0));
  const auto segments = [&](int e) { return border.edges[e].points.size() - 1; };
  EXPECT_EQ(segments(0), 10u);
  EXPECT_EQ(segments(1), 10u);                   // common
  EXPECT_EQ(border.edges[7].points.size(), 0u);  // no face uses it
  // int ds / (0.1 + 0.2 s) = 5 ln 3 from the common edge on, until the size is 0.3 at the far end.
  EXPECT_EQ(segments(4), static_cast<std::size_t>(std::lround(5 * std::log(3.0))));
  EXPECT_EQ(segments(5), 3u);
}

// A number and a place of a point follow from the model alone.
TEST(BorderSampler, GivesTheSamePointsInWhateverOrderEdgesAreLookedAt) {
  const CadModel model = whole_sphere(1.0);
  SizeRule rule{0.2};
  rule.angle = 0.1;
  const std::vector<double> finer(model.edges.size(), 1.0);
  const BorderPoints a = sample_border(model, rule, finer);
  const BorderPoints b = BorderSampler(model, {rule}, backwards()).sample(finer);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.size, b.size);
}

}  // namespace
}  // namespace geovor
