// The empty-ball test against brute force: DistanceFinder for every site, shooting from many starts, straight lines.
#include "voronoi/nearby_sites.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geodesic/distance.h"
#include "geodesic/offset.h"
#include "support/splines.h"
#include "test_faces.h"

namespace geovor {
namespace {

using namespace testing;

constexpr UvBox kBumpSquare = {{-2.0, 2.0}, {-2.0, 2.0}};

std::vector<Uv> random_points(const UvBox& box, int count, unsigned seed) {
  Uniform random(seed);
  std::vector<Uv> points;
  for (int i = 0; i < count; ++i) points.push_back(random.in(box));
  return points;
}

bool found_in(const std::vector<SiteRay>& rays, int site, double length, double angle) {
  return std::any_of(rays.begin(), rays.end(), [&](const SiteRay& r) {
    return r.site == site && std::abs(r.polar.s - length) < 1e-9 * length &&
           std::abs(wrap_angle(r.polar.t - angle)) < 1e-6;
  });
}

/// No conjugate point on the way, which is what makes a geodesic count.
bool counts(const Surface& surface, Uv from, const Connection& c) {
  return c.status == ConnectStatus::Converged && c.length > 0.0 && c.y > 0.0 && !c.leaves_domain &&
         !first_conjugate_point(surface, from, c.angle, c.length);
}

/// Geodesics that shooting from 24 directions at three lengths finds.
std::vector<Connection> many_shots(const Surface& surface, Uv from, Uv to, double limit) {
  std::vector<Connection> all;
  ConnectOptions once;
  once.persist = false;
  for (int i = 0; i < 24; ++i)
    for (const double part : {0.4, 0.7, 1.0}) {
      const Connection c = connect(surface, from, to, Polar{part * limit, i * kPi / 12.0}, once);
      if (c.status == ConnectStatus::Converged) all.push_back(c);
    }
  return all;
}

struct Scene {
  Scene(SurfacePtr s, std::vector<Uv> p) : surface(std::move(s)), sites(std::move(p)) {}
  SurfacePtr surface;
  std::vector<Uv> sites;
  SiteRays rays{*surface, sites};
  NearbySites nearby{rays};
};

/// What was found is a geodesic from its site to m, shorter than the limit and in order.
void expect_true_rays(const Scene& scene, Uv m, double limit, const std::vector<SiteRay>& found) {
  const Xyz x = scene.surface->position(m);
  double last = 0.0;
  for (const SiteRay& r : found) {
    EXPECT_LT(r.polar.s, limit);
    EXPECT_GE(r.polar.s, last);
    last = r.polar.s;
    TraceOptions finest;
    finest.tolerance = 1e-14;
    const OffsetJet o = offset(*scene.surface, scene.sites[r.site], r.polar.s, r.polar.t, finest);
    EXPECT_EQ(o.status, TraceStatus::Converged);
    EXPECT_LT(std::abs((o.at.S - x).dot(r.T)), 1e-11 * r.polar.s);  // of the length
    EXPECT_LT((o.at.S - x).norm(), 1e-9 * r.polar.s);
    EXPECT_NEAR(o.y, r.y, 1e-6 * r.polar.s);
  }
}

/// Nothing is missing that DistanceFinder or many shots find.
void expect_complete(const Scene& scene, const std::vector<Uv>& points, double limit, bool shots) {
  const DistanceFinder finder(*scene.surface);
  for (const Uv m : points) {
    const auto found = scene.nearby.nearer_than(limit, m, {});
    expect_true_rays(scene, m, limit, found);
    for (int site = 0; site < scene.rays.count(); ++site) {
      std::vector<Connection> truth = finder.distance(scene.sites[site], m).candidates;
      if (shots) {
        const auto more = many_shots(*scene.surface, scene.sites[site], m, limit);
        truth.insert(truth.end(), more.begin(), more.end());
      }
      for (const Connection& c : truth) {
        if (!(c.length < (1.0 - 1e-9) * limit) || found_in(found, site, c.length, c.angle)) continue;
        EXPECT_FALSE(counts(*scene.surface, scene.sites[site], c))
            << "site " << site << " at (" << m.u << ", " << m.v << "), length " << c.length << ", angle " << c.angle;
      }
    }
  }
}

TEST(NearbySites, AreThoseOfDistanceOnTheWave) {
  const auto wave = std::make_shared<WaveSurface>(UvBox{{-3.0, 3.0}, {-3.0, 3.0}});
  const Scene scene(wave, random_points(wave->domain(), 30, 1));
  expect_complete(scene, random_points(wave->domain(), 20, 2), 1.5, false);
  expect_complete(scene, random_points(wave->domain(), 10, 3), 4.0, false);
}

TEST(NearbySites, AreThoseOfManyShotsBehindBumps) {
  const auto one = std::make_shared<GaussianBumps>(std::vector<GaussianBumps::Bump>{{{0, 0}, 3, 0.3}}, kBumpSquare);
  const auto two = std::make_shared<GaussianBumps>(
      std::vector<GaussianBumps::Bump>{{{-1, 0.2}, 3, 0.3}, {{1, 0.2}, 3, 0.3}}, kBumpSquare);
  const Scene e1(one, {{1.2, 0}, {0, 0}}), e2(two, {{0, -1}, {-1, 0.2}, {1, 0.2}});
  const Scene e3(one, {{0.9, 0.25}, {-1.8, -1.6}, {0.1, 0.05}});
  for (const Scene* scene : {&e1, &e2, &e3}) expect_complete(*scene, random_points(kBumpSquare, 12, 4), 3.5, true);
}

TEST(NearbySites, AreThoseOfDistanceOnTorusAndEllipsoid) {
  const auto torus = std::make_shared<Torus>(Frame{}, 2.0, 0.7);
  const Scene ring(torus, random_points(torus->domain(), 12, 5));
  expect_complete(ring, random_points(torus->domain(), 8, 6), 3.0, true);
  const auto egg = std::make_shared<Ellipsoid>(1.0, 1.2, 1.5);
  const Scene eggs(egg, random_points(egg->domain(), 12, 7));
  expect_complete(eggs, random_points(egg->domain(), 8, 8), 2.5, true);
}

TEST(NearbySites, AreThoseOfDistanceOnABicubicSpline) {
  const auto sheet = std::make_shared<BSplineSurface>(random_spline(3, 3, 5, false, 9).surface());
  const Scene scene(sheet, random_points(sheet->domain(), 25, 10));
  expect_complete(scene, random_points(sheet->domain(), 15, 11), 1.2, false);
  expect_complete(scene, random_points(sheet->domain(), 5, 12), 3.0, false);
}

TEST(NearbySites, OnACylinderTheyAreTheStraightLinesOfItsDevelopment) {
  const double R = 0.5;
  const UvBox box{{0.0, 2.0 * kPi}, {-2.0, 2.0}};
  const Scene scene(std::make_shared<Cylinder>(Frame{}, R), random_points(box, 20, 13));
  for (const Uv m : random_points(box, 20, 14)) {
    constexpr double kLimit = 7.0;
    const auto found = scene.nearby.nearer_than(kLimit, m, {});
    std::size_t count = 0;
    for (int site = 0; site < scene.rays.count(); ++site)
      for (int turn = -4; turn <= 4; ++turn) {
        const double a = R * (m.u - scene.sites[site].u + turn * 2.0 * kPi), b = m.v - scene.sites[site].v;
        if (std::hypot(a, b) >= kLimit) continue;
        ++count;
        EXPECT_TRUE(found_in(found, site, std::hypot(a, b), std::atan2(b, a)));
      }
    EXPECT_EQ(found.size(), count);
  }
}

TEST(NearbySites, OnASphereTheyAreTheShorterArcsPolesIncluded) {
  const double R = 2.0;
  const auto sphere = std::make_shared<Sphere>(Frame{}, R);
  std::vector<Uv> sites = random_points(sphere->domain(), 20, 15), points = random_points(sphere->domain(), 20, 16);
  sites.push_back({1.0, kPi / 2});
  points.push_back({2.0, -kPi / 2});
  const Scene scene(sphere, sites);
  for (const Uv m : points) {
    const Xyz x = sphere->position(m);
    const auto found = scene.nearby.nearer_than(4.0, m, {});
    std::size_t count = 0;
    for (int site = 0; site < scene.rays.count(); ++site) {
      const Xyz p = scene.nearby.position(site);
      const double arc = 2.0 * R * std::atan2((x - p).norm(), (x + p).norm());
      if (arc >= 4.0) continue;
      ++count;
      EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const SiteRay& r) {
        return r.site == site && std::abs(r.polar.s - arc) < 1e-12 * arc;
      }));
    }
    EXPECT_EQ(found.size(), count);
  }
}

TEST(NearbySites, NearestIsTheNearestOfAllDistances) {
  const auto bumps = std::make_shared<GaussianBumps>(
      std::vector<GaussianBumps::Bump>{{{-1, 0.2}, 3, 0.3}, {{1, 0.2}, 3, 0.3}}, kBumpSquare);
  const Scene scene(bumps, random_points(kBumpSquare, 15, 17));
  const DistanceFinder finder(*bumps);
  for (const Uv m : random_points(kBumpSquare, 20, 18)) {
    const auto nearest = scene.nearby.nearest(m);
    ASSERT_FALSE(nearest.empty());
    double least = 1e300;
    for (const Uv p : scene.sites) least = std::min(least, finder.distance(p, m).shortest.length);
    EXPECT_NEAR(nearest.front().polar.s, least, 1e-11 * least);
  }
}

TEST(NearbySites, NearestGivesAllThatTie) {
  const auto bump = std::make_shared<GaussianBumps>(std::vector<GaussianBumps::Bump>{{{0, 0}, 3, 0.3}}, kBumpSquare);
  const Scene scene(bump, {{1.2, 0.0}, {1.7, 1.7}});
  EXPECT_EQ(scene.nearby.nearest({-1.2, 0.0}).size(), 2u);  // left and right of the bump
  const Scene plane(std::make_shared<Plane>(Frame{}), {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {0, 1.1}});
  EXPECT_EQ(plane.nearby.nearest({0.0, 0.0}).size(), 4u);
  EXPECT_EQ(plane.nearby.nearest({1.0, 0.0}).size(), 1u);
  EXPECT_EQ(plane.nearby.nearest({1.0, 0.0}).front().polar.s, 0.0);
}

TEST(NearbySites, LeavesOutWhatIsKnown) {
  const auto bump = std::make_shared<GaussianBumps>(std::vector<GaussianBumps::Bump>{{{0, 0}, 3, 0.3}}, kBumpSquare);
  const Scene scene(bump, {{1.2, 0.1}, {0.0, 0.0}, {1.5, 1.5}});
  const Uv m{-1.0, 0.05};
  const auto all = scene.nearby.nearer_than(3.5, m, {});
  ASSERT_GE(all.size(), 3u);
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::vector<SiteRay> known = all;
    known.erase(known.begin() + static_cast<std::ptrdiff_t>(i));
    const auto rest = scene.nearby.nearer_than(3.5, m, known);
    ASSERT_EQ(rest.size(), 1u);
    EXPECT_TRUE(same_generator(rest.front(), all[i]));
  }
  EXPECT_TRUE(scene.nearby.nearer_than(3.5, m, all).empty());
}

/// The upper half of the unit sphere as a graph, over a domain that it does not fill.
class Dome final : public GraphSurface {
 public:
  Dome() : GraphSurface({{-2.0, 2.0}, {-2.0, 2.0}}) {}
  HeightJet height(Uv p) const override {
    const double h = std::sqrt(1.0 - p.u * p.u - p.v * p.v), h3 = h * h * h;
    return {h, -p.u / h, -p.v / h, -1.0 / h - p.u * p.u / h3, -p.u * p.v / h3, -1.0 / h - p.v * p.v / h3};
  }
  HeightThirds height_thirds(Uv) const override { return {}; }
};

TEST(NearbySites, SaysHowFarTheSearchWasComplete) {
  const auto dome = std::make_shared<Dome>();
  const Scene scene(dome, {{0.0, 0.0}, {0.5, 0.0}});
  EXPECT_EQ(scene.nearby.nearer_than(1.0, {-0.3, 0.0}, {}).size(), 2u);
  EXPECT_TRUE(scene.nearby.complete_to(0, 1.0));
  EXPECT_TRUE(scene.nearby.complete_as_asked(0, 2.0)) << "nobody asked for more than 1";
  EXPECT_FALSE(scene.nearby.complete_to(0, 2.0));  // the rim lies at pi / 2
  EXPECT_FALSE(scene.nearby.complete_to(1, 1.2));  // at pi / 3 on this side
  const auto bump = std::make_shared<GaussianBumps>(std::vector<GaussianBumps::Bump>{{{0, 0}, 3, 0.3}}, kBumpSquare);
  EXPECT_TRUE(Scene(bump, {{1.2, 0.0}}).nearby.complete_to(0, 4.0));
}

// On the paraboloid a geodesic between neighbouring corners runs out to u = 1.30 (notes on which distance is meant).
TEST(NearbySites, FollowsRaysBeyondTheDomain) {
  const auto bowl = std::make_shared<Paraboloid>(kSquare);
  const Scene scene(bowl, {{1.0, -0.9}});
  const auto found = scene.nearby.nearer_than(2.0, {1.0, 0.9}, {});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found.front().polar.s, 1.950, 1e-3);
}

TEST(NearbySites, WorksAtPolesWhateverTheCopyOfThePoint) {
  const auto egg = std::make_shared<Ellipsoid>(1.0, 1.0, 1.5);
  const double pole = kPi / 2;
  const Scene scene(egg, {{0.3, pole}, {1.0, 0.2}, {4.0, -pole}});
  for (const Uv m : {Uv{2.0, 0.9}, Uv{2.0 + 2.0 * kPi, 0.9}}) {
    const auto found = scene.nearby.nearest(m);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found.front().site, 0);
  }
  // Meridians of the same length meet in the other pole, or run from the first to a parallel.
  const double s = scene.nearby.nearest({0.0, 0.9}).front().polar.s;
  for (const double u : {1.0, 3.0, 5.0}) EXPECT_NEAR(scene.nearby.nearest({u, 0.9}).front().polar.s, s, 1e-12);
  const Scene two(egg, {{1.0, 0.9}, {2.5, 0.8}});
  const auto at_pole = two.nearby.nearer_than(1.5, {5.0, pole}, {});
  ASSERT_EQ(at_pole.size(), 2u);
  EXPECT_NEAR(at_pole.front().polar.s, s, 1e-12);
  EXPECT_NEAR(two.nearby.nearest({0.0, pole}).front().polar.s, s, 1e-12);
}

TEST(SiteTree, FindsWhatLookingAtEveryPointFinds) {
  Uniform random(19);
  std::vector<Xyz> points;
  for (int i = 0; i < 500; ++i) points.push_back({random(), random(), 0.2 * random()});
  points.push_back(points[7]);
  const SiteTree tree(points);
  for (int k = 0; k < 200; ++k) {
    const Xyz x{random(), random(), 0.2 * random()};
    const double r = 0.3 * random();
    std::vector<int> inside;
    int next = 0;
    for (int i = 0; i < tree.count(); ++i) {
      if ((points[i] - x).norm() <= r) inside.push_back(i);
      if ((points[i] - x).norm() < (points[next] - x).norm()) next = i;
    }
    std::stable_sort(inside.begin(), inside.end(),
                     [&](int a, int b) { return (points[a] - x).norm() < (points[b] - x).norm(); });
    EXPECT_EQ(tree.in_ball(x, r), inside);
    EXPECT_EQ(tree.nearest(x), next);
  }
  EXPECT_EQ(tree.nearest(points[7], 7), 500);
  EXPECT_EQ(SiteTree({Xyz::Zero()}).nearest(Xyz::Zero(), 0), -1);
}

}  // namespace
}  // namespace geovor
