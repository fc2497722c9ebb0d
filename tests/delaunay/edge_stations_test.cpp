#include "delaunay/edge_stations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "surface/bspline_curve.h"
#include "surface/elementary_curves.h"

namespace geovor {
namespace {

EdgeStations look(Curve3Ptr curve, Interval range, const SizeRule& rule) {
  CadEdge edge;
  edge.curve = std::move(curve);
  edge.range = range;
  return look_along(edge, {{0, nullptr, nullptr, &rule}});
}

double least(const EdgeStations& st) { return *std::min_element(st.h.begin(), st.h.end()); }

// Lines of the lengths 10 and 7.3 joined by a parabola between (10 - l, 0) and (10, l), whose curvature is sqrt(2) / l
// at its vertex: a thousandth of the way on a curve that is straight elsewhere.
Curve3Ptr sharp_bend(double l) {
  const std::vector<Xyz> poles = {{0, 0, 0},  {5, 0, 0},     {10 - l, 0, 0}, {10, 0, 0},
                                  {10, l, 0}, {10, 3.65, 0}, {10, 7.3, 0}};
  return std::make_shared<BSplineCurve<3>>(KnotVector({0, 1, 2, 3}, {3, 2, 2, 3}, 2, false), poles);
}

TEST(LookAlong, SeesASharpBendOnALongEdge) {
  SizeRule rule{2.0};
  rule.angle = 0.2;
  for (double l : {0.1, 0.01}) {
    const double wanted = rule.angle * l / std::numbers::sqrt2;
    const EdgeStations st = look(sharp_bend(l), {0, 3}, rule);
    EXPECT_GT(least(st), 0.99 * wanted) << l;
    EXPECT_LT(least(st), 1.2 * wanted) << l;
    EXPECT_EQ(st.h.front(), 2.0);
    EXPECT_TRUE(std::is_sorted(st.s.begin(), st.s.end()));
    EXPECT_LT(st.s.size(), 200u);
  }
}

TEST(LookAlong, AddsUpTheTurnOfTheTangent) {
  const ConicFrame<3> frame{{0, 0, 0}, Xyz::UnitX(), Xyz::UnitY()};
  const auto circle = std::make_shared<Circle<3>>(frame, 3.0);
  EXPECT_NEAR(look(circle, {0, 2 * std::numbers::pi}, SizeRule{1.0}).turn, 2 * std::numbers::pi, 1e-3);
  EXPECT_NEAR(look(sharp_bend(0.01), {0, 3}, SizeRule{1.0}).turn, std::numbers::pi / 2, 1e-9);
}

TEST(LookAlong, TakesTheSmallestOfTheFacesRules) {
  CadEdge edge;
  edge.curve = std::make_shared<Circle<3>>(ConicFrame<3>{{0, 0, 0}, Xyz::UnitX(), Xyz::UnitY()}, 2.0);
  edge.range = {0, 3};
  SizeRule coarse{5.0}, angled{4.0};
  angled.angle = 0.25;
  for (const EdgeStations& st : {look_along(edge, {{0, nullptr, nullptr, &coarse}, {1, nullptr, nullptr, &angled}}),
                                 look_along(edge, {{1, nullptr, nullptr, &angled}, {0, nullptr, nullptr, &coarse}})}) {
    for (double h : st.h) {
      EXPECT_LE(h, 0.25 * 2.0);
      EXPECT_GE(h, 0.998 * 0.25 * 2.0);
    }
  }
}

}  // namespace
}  // namespace geovor
