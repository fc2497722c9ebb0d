// Meshes whose distances, angles and faults are known in closed form.
#include "pipeline/check_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "delaunay/meshing_faces.h"

namespace geovor {
namespace {

using namespace testing;

constexpr double kPhi = std::numbers::phi;

void one_by_one(int n, const std::function<void(int)>& body) {
  for (int i = 0; i < n; ++i) body(i);
}

LoadedMesh loaded(std::vector<Xyz> points, std::vector<std::array<int, 3>> triangles) {
  LoadedMesh l;
  l.mesh.points = std::move(points);
  l.mesh.triangles = std::move(triangles);
  l.mesh.face_of.assign(l.mesh.triangles.size(), -1);
  return l;
}

MeshCheck check(const LoadedMesh& mesh, CadModel model) {
  const double r = 10.0;  // the diagonal is for tolerances alone
  model.lower = Xyz::Constant(-r);
  model.upper = Xyz::Constant(r);
  return check_mesh(mesh, model, one_by_one);
}

/// Inscribed in the sphere of this radius, turned a little so that no vertex lies on its poles or its seam.
LoadedMesh icosahedron(double radius) {
  std::vector<Xyz> points;
  const double a = 0.3;
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-kPhi, kPhi}) {
      for (const Xyz& p : {Xyz(0, s, t), Xyz(s, t, 0), Xyz(t, 0, s)}) {
        const Xyz q(std::cos(a) * p.x() - std::sin(a) * p.y(), std::sin(a) * p.x() + std::cos(a) * p.y(), p.z());
        const Xyz w(q.x(), std::cos(a) * q.y() - std::sin(a) * q.z(), std::sin(a) * q.y() + std::cos(a) * q.z());
        points.push_back(radius * w.normalized());
      }
    }
  }
  std::vector<std::array<int, 3>> triangles;
  const double side = radius / std::sin(2 * kPi / 5);
  const auto near = [&](int i, int k) { return std::abs((points[i] - points[k]).norm() - side) < 1e-6 * radius; };
  for (int i = 0; i < 12; ++i) {
    for (int j = i + 1; j < 12; ++j) {
      for (int k = j + 1; k < 12; ++k) {
        if (!near(i, j) || !near(j, k) || !near(i, k)) continue;
        const double out = (points[j] - points[i]).cross(points[k] - points[i]).dot(points[i]);
        triangles.push_back(out > 0.0 ? std::array{i, j, k} : std::array{i, k, j});
      }
    }
  }
  return loaded(points, triangles);
}

// The inscribed sphere of an icosahedron touches the middles of its triangles.
double chord_height(double radius) { return radius * (1.0 - kPhi * kPhi / std::sqrt(3.0 * (kPhi * kPhi + 1.0))); }

TEST(CheckMesh, AnIcosahedronLiesItsChordHeightUnderTheSphere) {
  constexpr double kRadius = 7.0;
  const MeshCheck c = check(icosahedron(kRadius), whole_sphere(kRadius));
  EXPECT_NEAR(c.on_cad.distance.largest, chord_height(kRadius), 1e-9);
  EXPECT_NEAR(c.on_mesh.distance.largest, chord_height(kRadius), 1e-6);
  EXPECT_LT(c.vertices.largest, 1e-13 * kRadius * 10);
  EXPECT_EQ(c.vertices.beyond, 0);
  EXPECT_TRUE(c.topology.closed() && c.faults.manifold());
  EXPECT_EQ(c.topology.euler(), 2);
  EXPECT_NEAR(c.angles.smallest, 60.0, 1e-10);
  EXPECT_NEAR(c.normals.largest, 0.0, 1e-6);
  EXPECT_TRUE(c.normals.inverted.empty());
  EXPECT_EQ(c.faces[0].triangles, 20);
  EXPECT_NEAR(c.faces[0].face_area, 4 * kPi * kRadius * kRadius, 1e-6);
  const double side = kRadius / std::sin(2 * kPi / 5);
  EXPECT_NEAR(c.faces[0].mesh_area, 5 * std::sqrt(3.0) * side * side, 1e-9);
  EXPECT_NEAR(c.edges.at(0.5), side, 1e-12);
}

// The mean distance of a flat disc from the sphere above it has a closed form; of the icosahedron's triangles it is an
// integral that a fine rule gives as well.
TEST(CheckMesh, TheMeanDistanceIsTheIntegralOverTheTriangles) {
  constexpr double kRadius = 2.0;
  const LoadedMesh mesh = icosahedron(kRadius);
  const MeshCheck c = check(mesh, whole_sphere(kRadius));
  const auto& [a, b, d] = mesh.mesh.triangles[0];
  const Xyz &p = mesh.mesh.points[a], &q = mesh.mesh.points[b], &r = mesh.mesh.points[d];
  double sum = 0.0, squares = 0.0;
  constexpr int kGrid = 400;
  int n = 0;
  for (int i = 0; i < kGrid; ++i) {
    for (int k = 0; i + k < kGrid; ++k) {
      const double u = (i + 1.0 / 3) / kGrid, v = (k + 1.0 / 3) / kGrid,
                   distance = kRadius - (p + u * (q - p) + v * (r - p)).norm();
      sum += distance;
      squares += distance * distance;
      ++n;
    }
  }
  EXPECT_NEAR(c.on_cad.distance.mean, sum / n, 0.01 * sum / n);
  EXPECT_NEAR(c.on_cad.distance.rms, std::sqrt(squares / n), 0.01 * std::sqrt(squares / n));
}

// An obtuse triangle comes nearest to the middle of the sphere in the middle of its longest side, whichever that is.
TEST(CheckMesh, TheMiddleOfALongSideIsFarthestFromTheSphere) {
  constexpr double kRadius = 4.0;
  const auto on_sphere = [](double longitude, double latitude) {
    return Xyz(kRadius * std::cos(latitude) * std::cos(longitude), kRadius * std::cos(latitude) * std::sin(longitude),
               kRadius * std::sin(latitude));
  };
  const std::vector<Xyz> points{on_sphere(0.2, 0.0), on_sphere(1.2, 0.0), on_sphere(0.6, 0.1)};
  for (const std::array<int, 3>& t : {std::array{0, 1, 2}, {1, 2, 0}, {2, 0, 1}}) {
    const MeshCheck c = check(loaded(points, {t}), whole_sphere(kRadius));
    EXPECT_NEAR(c.on_cad.distance.largest, kRadius * (1.0 - std::cos(0.5)), 1e-9);
  }
}

TEST(CheckMesh, FaultsAreFoundWhereTheyWereMade) {
  constexpr double kRadius = 3.0;
  LoadedMesh mesh = icosahedron(kRadius);
  std::swap(mesh.mesh.triangles[4][1], mesh.mesh.triangles[4][2]);
  mesh.mesh.triangles.pop_back();
  mesh.mesh.face_of.pop_back();
  const MeshCheck c = check(mesh, whole_sphere(kRadius));
  EXPECT_EQ(c.normals.inverted, std::vector{4});
  EXPECT_NEAR(c.normals.largest, 180.0, 1e-6);
  EXPECT_EQ(c.normals.largest_at, 4);
  EXPECT_EQ(c.faults.open.size(), 3u);
  EXPECT_EQ(c.faults.disagreeing.size(), 3u);
  EXPECT_FALSE(c.topology.closed());
  // The sphere above the hole is as far from the hole's rim as its top from a side's middle.
  const double side = kRadius / std::sin(2 * kPi / 5), inradius = side / std::sqrt(12.0);
  EXPECT_NEAR(c.on_mesh.distance.largest, std::hypot(inradius, chord_height(kRadius)), 1e-6);
}

TEST(CheckMesh, ADisplacedVertexIsMeasured) {
  constexpr double kRadius = 3.0, kMoved = 1e-3;
  LoadedMesh mesh = icosahedron(kRadius);
  mesh.mesh.points[5] *= 1.0 + kMoved / kRadius;
  const MeshCheck c = check(mesh, whole_sphere(kRadius));
  EXPECT_EQ(c.vertices.largest_at, 5);
  EXPECT_NEAR(c.vertices.largest, kMoved, 1e-12);
  EXPECT_EQ(c.vertices.beyond, 1);
}

TEST(CheckMesh, TheRoundingOfTheFileIsAllowedFor) {
  constexpr double kRadius = 3.0;
  LoadedMesh mesh = icosahedron(kRadius);
  for (Xyz& p : mesh.mesh.points) p = p.cast<float>().cast<double>();
  EXPECT_GT(check(mesh, whole_sphere(kRadius)).vertices.beyond, 0);
  mesh.rounding = std::numbers::sqrt3 * 0.5 * std::numeric_limits<float>::epsilon() * kRadius;
  EXPECT_EQ(check(mesh, whole_sphere(kRadius)).vertices.beyond, 0);
}

// Two triangles over a square plate with a square hole: the middle of the hole is the farthest from the face.
TEST(CheckMesh, AHoleThatIsCoveredIsNotOnTheFace) {
  const MeshCheck c =
      check(loaded({{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}}, {{0, 1, 2}, {0, 2, 3}}), plate(10, 4));
  EXPECT_NEAR(c.on_cad.distance.largest, 2.0, 1e-9);
  EXPECT_NEAR(c.on_cad.distance.from.x(), 5.0, 1e-6);
  EXPECT_NEAR(c.on_mesh.distance.largest, 0.0, 1e-12);
  EXPECT_NEAR(c.area, 100.0, 1e-12);
  EXPECT_NEAR(c.faces[0].face_area, 84.0, 1e-9);
}

// And beyond the border the nearest point lies on it: a mesh that sticks out by a length.
TEST(CheckMesh, WhatSticksOutIsMeasuredFromTheBorder) {
  const MeshCheck c =
      check(loaded({{0, 0, 0}, {13, 0, 0}, {13, 10, 0}, {0, 10, 0}}, {{0, 1, 2}, {0, 2, 3}}), plate(10, 0));
  EXPECT_NEAR(c.on_cad.distance.largest, 3.0, 1e-12);
  EXPECT_NEAR(c.vertices.largest, 3.0, 1e-12);
  EXPECT_EQ(c.vertices.beyond, 2);
}

// A face that ends in a corner of 20 degrees: the triangle in it can't do better.
TEST(CheckMesh, NarrowTrianglesInSharperCornersOfTheCadAreToldApart) {
  const double h = 10 * std::tan(kPi / 9);
  const CadModel model = one_face(std::make_shared<Plane>(origin_frame()), {{{0, 0}, 0}, {{10, 0}, 1}, {{10, h}, 2}});
  const MeshCheck c = check(
      loaded({{0, 0, 0}, {5, 0, 0}, {5, h / 2, 0}, {10, 0, 0}, {10, h, 0}}, {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}}), model);
  EXPECT_NEAR(c.angles.smallest, 20.0, 1e-9);
  ASSERT_EQ(c.angles.narrow[2].limit, 30.0);
  EXPECT_EQ(c.angles.narrow[2].count, 2);  // in the corner, and {1, 3, 2} with atan(h / 10) = 20 degrees
  EXPECT_EQ(c.angles.narrow[2].at_sharper_corners, 1);
  EXPECT_EQ(c.angles.narrow[0].count, 0);
  ASSERT_EQ(c.angles.at_sharper_corners.size(), 1u);
  EXPECT_EQ(c.angles.at_sharper_corners[0].triangle, 0);
}

TEST(CheckMesh, AGroupStandsForTheFaceOnWhichItLies) {
  LoadedMesh mesh = icosahedron(3.0);
  mesh.groups = {"anything"};
  mesh.mesh.face_of.assign(20, 0);
  const MeshCheck c = check(mesh, whole_sphere(3.0));
  ASSERT_EQ(c.groups.size(), 1u);
  EXPECT_EQ(c.groups[0].face, 0);
  EXPECT_EQ(c.groups[0].triangles, 20);
  EXPECT_EQ(c.groups[0].elsewhere, 0);
}

TEST(CheckMesh, AMeshWithoutTrianglesIsAnError) { EXPECT_THROW(check(loaded({{0, 0, 0}}, {}), plate(1, 0)), Error); }

}  // namespace
}  // namespace geovor
