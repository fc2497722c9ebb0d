// Bisector points and vertices against closed forms, differences and connect().
#include "voronoi/bisector.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "geodesic/connect.h"
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
