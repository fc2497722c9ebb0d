// Places chosen for sites: far from one another, whatever the shape and its parameters.
#include "voronoi/place_sites.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "geodesic/distance.h"
#include "test_faces.h"
#include "voronoi/diagram_builder.h"
#include "voronoi/sites.h"

namespace geovor::testing {
namespace {

std::vector<Xyz> places(const TestFace& face, int count, std::uint64_t seed = 0) {
  std::vector<Xyz> x;
  for (Uv p : place_sites(face.domain(), count, seed)) x.push_back(face.model.faces[0].surface->position(p));
  return x;
}

double nearest_pair(const std::vector<Xyz>& x) {
  double nearest = 1e9;
  for (size_t i = 0; i < x.size(); ++i) {
    for (size_t j = 0; j < i; ++j) nearest = std::min(nearest, (x[i] - x[j]).norm());
  }
  return nearest;
}

TEST(PlaceSites, SpreadsThemOverTheFace) {
  const TestFace face = whole(std::make_shared<WaveSurface>(UvBox{{-2, 2}, {-2, 2}}));
  const auto sites = place_sites(face.domain(), 25, 1);
  ASSERT_EQ(sites.size(), 25u);
  EXPECT_NO_THROW(check_sites(face.domain(), sites, 1e-7));
  // Discs of this diameter about the sites fill at least a third of an area of about 21.
  EXPECT_GT(nearest_pair(places(face, 25, 1)), std::sqrt(21.0 / 25 * 4 / kPi / 3));
}

TEST(PlaceSites, GivesTheSamePlacesForTheSameSeedOnly) {
  const TestFace face = plane_square();
  const FaceDomain domain = face.domain();
  EXPECT_EQ(place_sites(domain, 9, 4), place_sites(domain, 9, 4));
  EXPECT_NE(place_sites(domain, 9, 4), place_sites(domain, 9, 5));
}

TEST(PlaceSites, TellsHowManyThereAreAndStopsWhereToldSo) {
  const TestFace face = plane_square();
  const FaceDomain domain = face.domain();
  std::vector<int> told;
  const auto sites = place_sites(domain, 9, 4, [&](int placed, int total) {
    EXPECT_EQ(total, 9);
    told.push_back(placed);
    return placed < 4;
  });
  EXPECT_EQ(told, (std::vector<int>{1, 2, 3, 4}));
  const auto all = place_sites(domain, 9, 4);
  EXPECT_EQ(sites, std::vector<Uv>(all.begin(), all.begin() + 4));
}

TEST(PlaceSites, RejectsANumberThatIsNotPositive) {
  const TestFace face = plane_square();
  EXPECT_THROW(place_sites(face.domain(), 0, 1), Error);
  EXPECT_THROW(place_sites_apart(face.domain(), 0.0, 1), Error);
  EXPECT_THROW(place_sites_apart(face.domain(), std::nan(""), 1), Error);
}

// Farthest points of a sphere: opposite points, the octahedron, and from there the middles of its triangles.
TEST(PlaceSites, FindsTheCornersOfTheOctahedronOnASphere) {
  const TestFace face = whole(std::make_shared<Sphere>(Frame{}, 2.0));
  const std::vector<Xyz> x = places(face, 7, 3);
  EXPECT_NEAR((x[0] + x[1]).norm(), 0.0, 1e-9);
  EXPECT_NEAR(nearest_pair({x.begin(), x.begin() + 6}), 2.0 * std::sqrt(2.0), 1e-9);
  double nearest = 9;
  for (int i = 0; i < 6; ++i) nearest = std::min(nearest, (x[6] - x[i]).norm());
  EXPECT_NEAR(2.0 * std::asin(nearest / 4.0), std::acos(1.0 / std::sqrt(3.0)), 1e-9);
}

// A cylinder is a plane rolled up: half a turn away and as far up as the rule for borders lets it.
TEST(PlaceSites, GoesRoundACylinderAndStaysOffItsRims) {
  const TestFace face = TestFace(std::make_shared<Cylinder>(Frame{}, 1.0)).ring({{0, 2 * kPi}, {0, 3}});
  const std::vector<Xyz> x = places(face, 10, 1);
  for (const Xyz& p : x) {
    EXPECT_GT(p.z(), 0.2);
    EXPECT_LT(p.z(), 2.8);
  }
  EXPECT_GT(nearest_pair(x), 0.8);
}

TEST(PlaceSites, TakesTorusesDiscsAndNarrowFaces) {
  const TestFace torus = whole(std::make_shared<Torus>(Frame{}, 3.0, 1.0));
  EXPECT_GT(nearest_pair(places(torus, 6, 2)), 2.0);
  std::vector<Uv> circle;
  for (int k = 0; k < 200; ++k) circle.push_back({std::cos(k * kPi / 100), std::sin(k * kPi / 100)});
  const TestFace disc = TestFace(std::make_shared<Plane>(Frame{})).polygon(circle);
  const std::vector<Xyz> on_disc = places(disc, 7, 5);
  EXPECT_GT(nearest_pair(on_disc), 0.45);
  for (const Xyz& p : on_disc) EXPECT_LT(p.norm(), 0.9);
  const TestFace strip = TestFace(std::make_shared<Plane>(Frame{})).rectangle({{0, 10}, {0, 0.1}});
  const std::vector<Xyz> in_a_row = places(strip, 5, 0);
  EXPECT_GT(nearest_pair(in_a_row), 0.05);
}

// Plane rings: from the outer border back to the first site most of the way leads through the hole.
TEST(PlaceSites, FindsPlacesBehindTheHoleOfANarrowRing) {
  const auto circle = [](double radius, double turn) {
    std::vector<Uv> points;
    for (int k = 0; k < 200; ++k)
      points.push_back({radius * std::cos(k * kPi / 100), turn * radius * std::sin(k * kPi / 100)});
    return points;
  };
  for (const double hole : {2.0, 5.0}) {
    const TestFace ring =
        TestFace(std::make_shared<Plane>(Frame{})).polygon(circle(7.0, 1.0)).polygon(circle(hole, -1.0));
    for (const int count : {2, 4, 9, 25}) {
      const std::vector<Xyz> x = places(ring, count);
      ASSERT_EQ(static_cast<int>(x.size()), count);
      // Half of what squares on the ring's area would have.
      const double area = kPi * (49.0 - hole * hole);
      EXPECT_GT(nearest_pair(x), 0.5 * std::sqrt(area / count)) << count << " sites, hole " << hole;
    }
  }
}

// What place_sites_apart() promises, held against a grid of points.
TEST(PlaceSites, ApartLeavesNoPointFarFromItsSite) {
  const TestFace face = plane_square();
  constexpr double kSpacing = 0.35;
  const std::vector<Uv> sites = place_sites_apart(face.domain(), kSpacing, 7);
  const double reach = kReachOfSpacing * kSpacing;
  double farthest = 0.0, nearest = 9.0;
  for (int i = 0; i < 100; ++i) {
    for (int j = 0; j < 100; ++j) {
      const Uv p = {-0.995 + 0.02 * i - 0.005, -0.995 + 0.02 * j - 0.005};
      double to_site = 9.0;
      for (Uv s : sites) to_site = std::min(to_site, std::hypot(p.u - s.u, p.v - s.v));
      farthest = std::max(farthest, std::min(to_site, 2 * (1 - std::max(std::abs(p.u), std::abs(p.v)))));
    }
  }
  for (size_t i = 0; i < sites.size(); ++i) {
    for (size_t j = 0; j < i; ++j)
      nearest = std::min(nearest, std::hypot(sites[i].u - sites[j].u, sites[i].v - sites[j].v));
  }
  EXPECT_LE(farthest, reach * (1 + 1e-9));
  EXPECT_GE(nearest, reach * (1 - 1e-9));
  // A hexagonal arrangement has this many in the square.
  const double hexagons = 4.0 / (0.5 * std::sqrt(3.0) * kSpacing * kSpacing);
  EXPECT_NEAR(static_cast<double>(sites.size()), hexagons, 0.25 * hexagons);
}

}  // namespace
}  // namespace geovor::testing
