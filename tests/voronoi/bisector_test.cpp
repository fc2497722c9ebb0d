// Bisector points and vertices against closed forms, differences and connect().
#include "voronoi/bisector.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "geodesic/connect.h"
#include "geodesic/integrator.h"
#include "support/splines.h"
#include "surface/forms.h"
#include "surface/tangent_frame.h"
#include "test_faces.h"
#include "voronoi/vertex_solver.h"

namespace geovor::testing {
namespace {

const WaveSurface kWave({{-3, 3}, {-3, 3}});

/// A point of the bisector of sites 0 (left) and 1 on the wave, near the place.
BisectorPoint near(const SiteRays& rays, Uv place) {
  const auto p = rays.to(0, place), q = rays.to(1, place);
  BisectorPoint guess{*p, *q};
  const Xyz t = guess.tangent();
  return *correct_bisector(rays, 0, 1, coordinates(guess), {t, t.dot(p->x)});
}

TEST(Bisector, IsThePerpendicularBisectorOnAPlane) {
  const Plane plane(Frame{});
  const std::vector<Uv> sites = {{-0.3, 0.2}, {0.5, 0.6}};
  const SiteRays rays(plane, sites);
  for (double x : {-2.0, -0.1, 0.4, 3.0}) {
    // |m - p|^2 = |m - q|^2 solved for y.
    const double y = (0.25 + 0.36 - 0.09 - 0.04 - 2 * x * 0.8) / (2 * 0.4);
    const auto p = rays.to(0, {x + 0.1, y - 0.2}), q = rays.to(1, {x + 0.1, y - 0.2});
    const auto m = correct_bisector(rays, 0, 1, coordinates({*p, *q}), {Xyz::UnitX(), x});
    ASSERT_TRUE(m);
    EXPECT_NEAR(m->position().x(), x, 1e-11);
    EXPECT_NEAR(m->position().y(), y, 1e-10);
  }
}

TEST(Bisector, IsEquallyFarFromBothSitesOnAWave) {
  const std::vector<Uv> sites = {{-0.4, 0.1}, {0.5, 0.3}};
  const SiteRays rays(kWave, sites);
  for (double v : {-0.8, -0.2, 0.3, 0.9}) {
    const BisectorPoint m = near(rays, {0.05, v});
    const Connection p = connect(kWave, sites[0], m.left.uv), q = connect(kWave, sites[1], m.left.uv);
    EXPECT_NEAR(p.length, q.length, 1e-11);
    EXPECT_NEAR(p.length, m.radius(), 1e-11);
  }
}

TEST(Bisector, HasTheLeftSiteToTheLeftOfItsTangent) {
  const std::vector<Uv> sites = {{-0.4, 0.1}, {0.5, 0.3}};
  const BisectorPoint m = near(SiteRays(kWave, sites), {0.05, 0.2});
  const Xyz n = m.left.T.cross(m.left.N);
  EXPECT_GT(n.dot(m.tangent().cross(-m.left.T)), 0.0);
  EXPECT_LT(n.dot(m.tangent().cross(-m.right.T)), 0.0);
}

TEST(Bisector, SlopeIsTheDerivativeOfItsCoordinates) {
  const std::vector<Uv> sites = {{-0.4, 0.1}, {0.5, 0.3}};
  const SiteRays rays(kWave, sites);
  const BisectorPoint m = near(rays, {0.1, 0.8});
  const BisectorSlope d = bisector_slope(m);
  const Xyz t = m.tangent();
  const double h = 1e-4;
  const auto on = correct_bisector(rays, 0, 1, coordinates(m), {t, t.dot(m.position()) + h});
  const auto back = correct_bisector(rays, 0, 1, coordinates(m), {t, t.dot(m.position()) - h});
  ASSERT_TRUE(on && back);
  EXPECT_NEAR((on->radius() - back->radius()) / (2 * h), d.radius, 1e-6);
  EXPECT_NEAR((on->left.polar.t - back->left.polar.t) / (2 * h), d.left_angle, 1e-6);
  EXPECT_NEAR((on->right.polar.t - back->right.polar.t) / (2 * h), d.right_angle, 1e-6);
}

// From flat ground into the bump's tail a step of the whole length met its tolerance by its own estimate and was 4e-11
// off. Against short legs at a finer tolerance.
TEST(SiteRays, AreExactInTheTailOfALowBump) {
  const GaussianBumps bump({{{0.0, 0.0}, 0.5, 0.5}}, {{-2, 2}, {-2, 2}});
  Uniform random(4);
  std::vector<Uv> sites;
  for (int i = 0; i < 200; ++i) sites.push_back(random.in(bump.domain()));
  const SiteRays rays(bump, sites);
  TraceOptions options;
  options.tolerance = 1e-14;
  options.stop_at_domain = false;
  constexpr int kLegs = 40;
  for (int i = 0; i < 2000; ++i) {
    const int site = i % 200;
    const double s = 0.05 + 1.95 * random(), t = 2.0 * kPi * random();
    const auto ray = rays.at(site, {s, t});
    if (!ray) continue;
    GeodesicIntegrator path(bump, sites[site], tangent_frame(bump, sites[site]).at_angle(t), s, options);
    for (int k = 1; k <= kLegs; ++k) path.advance(s * k / kLegs);
    EXPECT_LE((path.at().S - ray->x).norm(), 1e-12 * s) << site << " " << s << " " << t;
  }
}

/// The distance from the site to the point, from scratch.
double anew(const Surface& surface, Uv site, Uv m, Polar guess) {
  ConnectOptions options;
  options.tolerance = 1e-14;
  const Connection c = connect(surface, site, m, guess, options);
  EXPECT_EQ(c.status, ConnectStatus::Converged);
  return c.length;
}

double anew(const SiteRays& rays, const SiteRay& ray) {
  return anew(rays.surface(), rays.site(ray.site), ray.uv, ray.polar);
}

struct Patch {
  const char* name;
  SurfacePtr surface;
  UvBox box;
};

std::vector<Patch> patches() {
  const auto spline = std::make_shared<BSplineSurface>(random_spline(3, 3, 6, false, 5).surface());
  return {{"wave", std::make_shared<WaveSurface>(UvBox{{-9, 9}, {-9, 9}}), {{-3, 3}, {-3, 3}}},
          {"torus", std::make_shared<Torus>(Frame{}, 3.0, 1.0), {{0, 6.2}, {0, 6.2}}},
          {"ellipsoid", std::make_shared<Ellipsoid>(1.0, 0.8, 0.6), {{0, 6.2}, {-1.2, 1.2}}},
          {"sphere", std::make_shared<Sphere>(Frame{}, 2.0), {{0, 6.2}, {-1.2, 1.2}}},
          {"spline with knots", spline, {{1, 5}, {1, 5}}}};
}

constexpr double kEquidistance = 1e-12;

TEST(VertexSolver, IsEquallyFarFromThreeSitesOnEverySurface) {
  for (const Patch& patch : patches()) {
    Uniform random(11);
    int found = 0;
    for (const double size : {0.02, 0.1, 0.4}) {
      for (int i = 0; i < 20; ++i) {
        const Uv m = random.in(patch.box);
        const SurfaceJet j = patch.surface->jet(m);
        std::vector<Uv> sites;
        for (int k = 0; k < 3; ++k) {
          const UvVec d = direction_at_angle(j, 2.1 * k + random());
          sites.push_back(m + size * (0.7 + 0.6 * random()) * d);
        }
        const SiteRays rays(*patch.surface, sites);
        std::array<PolarGuess, 3> guess;
        for (int k = 0; k < 3; ++k) {
          const SurfaceJet at = patch.surface->jet(sites[k]);
          guess[k] = {k, angle_of_direction(at, m - sites[k])};
        }
        const auto v = solve_vertex(rays, guess, size);
        if (!v) continue;
        ++found;
        for (const SiteRay& r : *v) {
          EXPECT_NEAR(anew(rays, r), r.polar.s, kEquidistance * r.polar.s) << patch.name << " " << size << " " << i;
          EXPECT_NEAR((rays.at(r.site, r.polar)->x - r.x).norm(), 0.0, 2.0 * kEquidistance * r.polar.s) << patch.name;
        }
      }
    }
    EXPECT_EQ(found, 60) << patch.name;
  }
}

TEST(Bisector, IsExactWhateverThePredictorIsSaidToBe) {
  for (const Patch& patch : patches()) {
    Uniform random(12);
    for (const double size : {0.05, 0.3}) {
      for (int i = 0; i < 20; ++i) {
        const Uv p = random.in(patch.box);
        const std::vector<Uv> sites = {p, p + 2.0 * size * direction_at_angle(patch.surface->jet(p), 6.0 * random())};
        const SiteRays rays(*patch.surface, sites);
        const Uv place = lerp(sites[0], sites[1], 0.5) + 0.3 * (random() - 0.5) * (sites[1] - sites[0]);
        const auto left = rays.to(0, place), right = rays.to(1, place);
        ASSERT_TRUE(left && right) << patch.name;
        const BisectorPoint guess{*left, *right};
        const Xyz t = guess.tangent();
        for (const double miss : {0.3, 1e-3, 1e-6}) {
          const auto m = correct_bisector(rays, 0, 1, coordinates(guess), {t, t.dot(left->x) + 0.2 * size}, miss);
          ASSERT_TRUE(m) << patch.name;
          EXPECT_NEAR(anew(rays, m->left), m->radius(), kEquidistance * m->radius()) << patch.name << " " << miss;
          EXPECT_NEAR(anew(rays, m->right), m->radius(), kEquidistance * m->radius()) << patch.name << " " << miss;
          EXPECT_NEAR(t.dot(m->position() - left->x), 0.2 * size, kEquidistance);
        }
      }
    }
  }
}

// Behind a bump the two branches of a site's cut locus by symmetry meet on the axis: down to its free end, where they
// become one and the radius is that of the first conjugate point.
TEST(Bisector, FollowsACutLocusToSmallAngles) {
  const GaussianBumps bump({{{0.0, 0.0}, 3.0, 0.3}}, {{-4, 4}, {-4, 4}});
  const std::vector<Uv> sites = {{1.2, 0.0}};
  const SiteRays rays(bump, sites);
  // Shots at small angles to the axis cross it behind the bump: the point of the cut locus with that angle.
  for (const double angle : {0.3, 0.1, 0.03, 0.01, 3e-3}) {
    double s = 1.0;
    while (rays.at(0, {s, kPi - angle})->x.y() > 0.0) s += 0.01;
    for (int i = 0; i < 8; ++i) {
      const auto ray = rays.at(0, {s, kPi - angle});
      s -= ray->x.y() / ray->T.y();
    }
    const auto ray = rays.at(0, {s, kPi - angle});
    ASSERT_NEAR(ray->x.y(), 0.0, 1e-13);
    const double off = 1e-3 * angle;
    const auto m = correct_bisector(rays, 0, 0, {s * (1.0 + off * angle), kPi + angle + off, kPi - angle + off},
                                    {Xyz::UnitX(), ray->x.x()});
    ASSERT_TRUE(m) << angle;
    EXPECT_NEAR(m->position().y(), 0.0, 1e-12) << angle;
    EXPECT_NEAR(m->radius(), s, 1e-12 * s) << angle;
    EXPECT_NEAR(wrap_angle(m->left.polar.t - kPi), angle, 1e-12 / angle / angle) << angle;
    EXPECT_NEAR(wrap_angle(m->right.polar.t - kPi), -angle, 1e-12 / angle / angle) << angle;
  }
}

TEST(VertexSolver, FindsTheCircumcentreOnAPlane) {
  const Plane plane(Frame{});
  // A circle about (0.2, -0.1) of radius 0.7.
  std::vector<Uv> sites;
  for (double t : {0.3, 2.0, 4.4}) sites.push_back({0.2 + 0.7 * std::cos(t), -0.1 + 0.7 * std::sin(t)});
  const auto v = solve_vertex(SiteRays(plane, sites), {{{0, 3.3}, {1, -1.0}, {2, 1.0}}}, 0.5);
  ASSERT_TRUE(v);
  EXPECT_NEAR((*v)[0].polar.s, 0.7, 1e-11);
  EXPECT_NEAR((*v)[0].x.x(), 0.2, 1e-11);
  EXPECT_NEAR((*v)[0].x.y(), -0.1, 1e-11);
}

TEST(VertexSolver, FindsTheCircumcentreOnASphere) {
  const Sphere sphere(Frame{}, 2.0);
  const std::vector<Uv> sites = {{0.1, 0.2}, {1.0, -0.3}, {0.7, 0.9}};
  const Xyz a = sphere.position(sites[0]), b = sphere.position(sites[1]), c = sphere.position(sites[2]);
  const Xyz centre = 2.0 * (b - a).cross(c - a).normalized();
  const SiteRays rays(sphere, sites);
  const Uv guess = {0.6, 0.25};
  std::array<PolarGuess, 3> angles;
  for (int i = 0; i < 3; ++i) angles[i] = {i, rays.to(i, guess)->polar.t};
  const auto v = solve_vertex(rays, angles, 1.0);
  ASSERT_TRUE(v);
  EXPECT_NEAR(((*v)[0].x - centre).norm(), 0.0, 1e-11);
  EXPECT_NEAR((*v)[1].polar.s, 2.0 * std::acos(a.dot(centre) / 4.0), 1e-11);
}

}  // namespace
}  // namespace geovor::testing
