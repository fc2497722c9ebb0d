#include "delaunay/size_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "delaunay/edge_set.h"
#include "delaunay/space_grid.h"

namespace geovor {
namespace {

MeshVertex vertex(const Xyz& x, double h) { return {x, Xyz::UnitZ(), h, -1, {{0, 0}}, false, false}; }

std::vector<MeshVertex> random_points(int n, double least, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 10.0), size(least, 1.0);
  std::vector<MeshVertex> points;
  for (int i = 0; i < n; ++i) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    points.push_back(vertex({x, y, z}, size(random)));
  }
  return points;
}

TEST(SizeField, IsTheLowerEnvelopeOfItsPlaces) {
  const SizeRule rule{1.0};
  const auto places = random_points(300, 0.01, 1);
  const SizeField field(rule, places);
  for (const MeshVertex& at : random_points(500, 0.1, 2)) {
    double expected = 0.9;
    for (const MeshVertex& p : places) {
      if (p.h < 0.98) expected = std::min(expected, p.h + rule.gradation * (p.x - at.x).norm());
    }
    EXPECT_NEAR(field.at(at.x, 0.9), expected, 1e-12);
  }
}

TEST(SizeField, SaysThatPointsStandTooNearToSmallerOnes) {
  const SizeRule rule{1.0};
  const MeshVertex fine = vertex({0, 0, 0}, 0.1), far = vertex({3, 0, 0}, 1.0);
  const MeshVertex near = vertex({0.5, 0, 0}, 1.0);  // 0.35 would be right
  SizeField too_coarse(rule, {}), good(rule, {});
  EXPECT_TRUE(too_coarse.learn(std::vector<MeshVertex>{fine, near}));
  EXPECT_FALSE(good.learn(std::vector<MeshVertex>{fine, far}));
  EXPECT_NEAR(too_coarse.at(near.x, 1.0), 0.35, 1e-12);
}

TEST(SpaceGrid, FindsAllThatIsWithinReach) {
  const auto points = random_points(400, 0.1, 3);
  SpaceGrid grid;
  for (const MeshVertex& p : points) grid.add(p.x - Xyz(5, 5, 5));
  for (const double reach : {0.05, 0.3, 1.0, 2.7}) {
    for (const MeshVertex& at : random_points(50, 0.1, 4)) {
      std::set<int> found;
      grid.each_near(at.x - Xyz(5, 5, 5), reach, [&](int i) { EXPECT_TRUE(found.insert(i).second); });
      for (size_t i = 0; i < points.size(); ++i) {
        const bool is_near = (points[i].x - at.x).norm() < reach;
        EXPECT_TRUE(!is_near || found.count(static_cast<int>(i)) == 1);
      }
    }
  }
}

TEST(EdgeSet, HoldsAsManyEdgesOfAPointAsThereAre) {
  EdgeSet set;
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(set.insert(3, i));
  for (int i = 0; i < 50; ++i) {
    EXPECT_FALSE(set.insert(3, i));
    EXPECT_TRUE(set.has(3, i));
    EXPECT_FALSE(set.has(i == 3 ? 4 : i, 3));
  }
}

}  // namespace
}  // namespace geovor
