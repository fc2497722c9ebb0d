#include "delaunay/surface_triangulation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "delaunay/meshing_faces.h"

namespace geovor {
namespace {

using namespace testing;

MeshVertex on_sphere(const Sphere& sphere, Uv p) {
  const Xyz x = sphere.position(p);
  return {x, x.normalized(), 0.1, -1, {p}, false, false};
}

// Two points of the unit sphere whose arc is `arc`, joined as an edge of a triangle.
SurfaceTriangulation pair_at(const SurfaceProbe& probe, const Sphere& sphere, const SizeRule& rule, double arc) {
  return {HalfEdges(3, {{0, 1, 2}}),
          {on_sphere(sphere, {0.3, 0.2}), on_sphere(sphere, {0.3, 0.2 + arc}), on_sphere(sphere, {0.3 - arc, 0.2})},
          probe,
          rule};
}

TEST(SurfaceTriangulation, EstimatesAnArcToTheFifthOrder) {
  const Sphere sphere(origin_frame(), 1.0);
  const SurfaceProbe probe(sphere, {{0, 2 * kPi}, {-1, 1}});
  const SizeRule rule;
  const auto error = [&](double arc) {
    const SurfaceTriangulation pair = pair_at(probe, sphere, rule, arc);
    return std::abs(geodesic_estimate(pair.vertex(0), pair.vertex(1)) - arc);
  };
  EXPECT_LT(error(0.2), 1e-5);
  EXPECT_GT(error(0.4) / error(0.2), 24.0);  // 2^5 and more
}

TEST(SurfaceTriangulation, SolvesForTheGeodesicLength) {
  const Sphere sphere(origin_frame(), 1.0);
  const SurfaceProbe probe(sphere, {{0, 2 * kPi}, {-1, 1}});
  const SizeRule rule;
  const SurfaceTriangulation mesh = pair_at(probe, sphere, rule, 0.3);
  EXPECT_NEAR(mesh.geodesic_length(0, 1), 0.3, 1e-12);
  EXPECT_EQ(mesh.estimates_used(), 0);
}

TEST(SurfaceTriangulation, CountsTheLengthsThatItHadToEstimate) {
  const Sphere sphere(origin_frame(), 1.0);
  const SurfaceProbe probe(sphere, {{0, 2 * kPi}, {-kPi / 2, kPi / 2}});
  const SizeRule rule;
  MeshVertex pole = on_sphere(sphere, {0, kPi / 2});
  pole.free_u = true;
  MeshVertex seam = on_sphere(sphere, {0, 1.4});
  seam.uv.push_back({2 * kPi, 1.4});
  const SurfaceTriangulation mesh({3, {{0, 1, 2}}}, {pole, seam, on_sphere(sphere, {0.5, 1.4})}, probe, rule);
  EXPECT_NEAR(mesh.geodesic_length(0, 1), kPi / 2 - 1.4, 1e-4);
  EXPECT_EQ(mesh.estimates_used(), 1);
}

TEST(SurfaceTriangulation, DropsAPointOntoTheSurface) {
  const Sphere sphere(origin_frame(), 1.0);
  const SurfaceProbe probe(sphere, {{0, 2 * kPi}, {-1, 1}});
  const SizeRule rule;
  const SurfaceTriangulation mesh = pair_at(probe, sphere, rule, 0.1);
  const Xyz centre = mesh.circumcentre(0);
  const auto v = mesh.drop(centre, 0);
  ASSERT_TRUE(v);
  EXPECT_LT((v->x - centre.normalized()).norm(), 1e-14);
  EXPECT_FALSE(mesh.drop(centre + Xyz(5, 5, 5), 0));
}

TEST(SurfaceTriangulation, RefusesAVertexThatWouldTurnATriangleOver) {
  const Sphere sphere(origin_frame(), 1.0);
  const SurfaceProbe probe(sphere, {{0, 2 * kPi}, {-1, 1}});
  const SizeRule rule;
  SurfaceTriangulation mesh = pair_at(probe, sphere, rule, 0.1);
  EXPECT_FALSE(mesh.insert(on_sphere(sphere, {0.9, 0.2}), 0));
  EXPECT_EQ(mesh.topology().triangle_count(), 1);
}

}  // namespace
}  // namespace geovor
