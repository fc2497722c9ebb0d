// The points between an edge's traced ones against connect() and the corrector.
#include "voronoi/dense_edge.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "edge_patches.h"
#include "geodesic/connect.h"
#include "support/splines.h"
#include "test_faces.h"
#include "voronoi/edge_curve.h"

namespace geovor::testing {
namespace {

constexpr double kEquidistance = 1e-12;

std::vector<BisectorPoint> steps(const SiteRays& rays, Uv place, double h, int count) {
  const auto p = rays.to(0, place), q = rays.to(1, place);
  BisectorPoint m{*p, *q};
  std::vector<BisectorPoint> points;
  for (int i = 0; i <= count; ++i) {
    const Xyz t = m.tangent();
    const auto next = correct_bisector(rays, 0, 1, coordinates(m), {t, t.dot(m.position()) + (i == 0 ? 0.0 : h)}, 0.1);
    if (!next) break;
    m = *next;
    points.push_back(m);
  }
  return points;
}

double anew(const SiteRays& rays, int site, const EdgePoint& m, double angle) {
  ConnectOptions options;
  options.tolerance = 1e-14;
  const Connection c = connect(rays.surface(), rays.site(site), m.uv, Polar{m.radius, angle}, options);
  EXPECT_EQ(c.status, ConnectStatus::Converged);
  EXPECT_NEAR(wrap_angle(c.angle - angle) * m.radius, 0.0, 1e-11);
  return c.length;
}

TEST(DenseEdge, EveryPointIsEquallyFarFromBothSites) {
  for (const Patch& patch : patches()) {
    const std::vector<Uv> sites = {patch.p, patch.q};
    const SiteRays rays(*patch.surface, sites);
    const auto traced = steps(rays, lerp(patch.p, patch.q, 0.5), 0.12, 5);
    ASSERT_EQ(traced.size(), 6u) << patch.name;
    const auto line = dense_edge(rays, traced, 1e-6);
    for (const EdgePoint& m : line) {
      EXPECT_NEAR(anew(rays, 0, m, m.left_angle), m.radius, kEquidistance * m.radius) << patch.name;
      EXPECT_NEAR(anew(rays, 1, m, m.right_angle), m.radius, kEquidistance * m.radius) << patch.name;
      EXPECT_NEAR((rays.surface().position(m.uv) - m.xyz).norm(), 0.0, 1e-14) << patch.name;
    }
  }
}

TEST(DenseEdge, ChordsStayWithinTheSag) {
  for (const Patch& patch : patches()) {
    const std::vector<Uv> sites = {patch.p, patch.q};
    const SiteRays rays(*patch.surface, sites);
    for (const double sag : {1e-3, 1e-5}) {
      DiagramEdge edge;
      edge.left = 0;
      edge.right = 1;
      edge.points = dense_edge(rays, steps(rays, lerp(patch.p, patch.q, 0.5), 0.12, 5), sag);
      for (size_t i = 1; i < edge.points.size(); ++i) {
        DiagramEdge piece = edge;
        piece.points = {edge.points[i - 1], edge.points[i]};
        const EdgeCurve curve(rays, piece);
        for (const double k : {0.25, 0.5, 0.75}) {
          const auto m = curve.at(k);
          ASSERT_TRUE(m) << patch.name;
          const Xyz &a = edge.points[i - 1].xyz, &b = edge.points[i].xyz;
          EXPECT_LE((m->xyz - a - k * (b - a)).norm(), 1.1 * sag) << patch.name;
        }
      }
    }
  }
}

TEST(DenseEdge, SlopesAreTheDerivativesAlongTheEdge) {
  const WaveSurface wave({{-9, 9}, {-9, 9}});
  const std::vector<Uv> sites = {{0.1, 0.2}, {0.6, 0.3}};
  const SiteRays rays(wave, sites);
  const auto line = dense_edge(rays, steps(rays, lerp(sites[0], sites[1], 0.5), 0.12, 5), 1e-7);
  ASSERT_GT(line.size(), 50u);
  for (size_t i = 1; i < line.size(); ++i) {
    const EdgePoint &a = line[i - 1], &b = line[i];
    const double h = (b.xyz - a.xyz).norm();
    EXPECT_NEAR((b.radius - a.radius) / h, 0.5 * (a.radius_slope + b.radius_slope), 10.0 * h * h);
    EXPECT_NEAR((b.left_angle - a.left_angle) / h, 0.5 * (a.left_slope + b.left_slope), 30.0 * h * h);
    EXPECT_NEAR((b.right_angle - a.right_angle) / h, 0.5 * (a.right_slope + b.right_slope), 30.0 * h * h);
  }
}

}  // namespace
}  // namespace geovor::testing
