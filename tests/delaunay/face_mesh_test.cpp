#include "delaunay/face_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>

#include "delaunay/meshing_faces.h"
#include "mesh/mesh_checks.h"
#include "surface/analytic_surfaces.h"

namespace geovor {
namespace {

using namespace testing;

TriangleMesh mesh_of(const CadModel& model, const SizeRule& rule, FaceMesh* part = nullptr) {
  const BorderPoints border = sample_border(model, rule, std::vector<double>(model.edges.size(), 1.0));
  const FaceMesh face = mesh_face(model.faces[0], border, rule);
  EXPECT_TRUE(face.ok) << face.why;
  TriangleMesh mesh;
  mesh.points = border.points;
  mesh.points.insert(mesh.points.end(), face.inner.begin(), face.inner.end());
  for (auto t : face.triangles) {
    for (int& c : t) c = c < 0 ? static_cast<int>(border.points.size()) - 1 - c : c;
    mesh.triangles.push_back(t);
    mesh.face_of.push_back(1);
  }
  if (part != nullptr) *part = face;
  return mesh;
}

// For each inner edge: how far the fourth point lies above the plane of a triangle, in edge lengths. On a sphere the
// geodesic Delaunay triangulation is the convex hull, so none does.
double highest_above_hull(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> apex;
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) apex[{t[i], t[(i + 1) % 3]}] = t[(i + 2) % 3];
  }
  double highest = 0.0;
  for (const auto& t : mesh.triangles) {
    const Xyz &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    const Xyz n = (b - a).cross(c - a).normalized();
    for (int i = 0; i < 3; ++i) {
      const auto other = apex.find({t[(i + 1) % 3], t[i]});
      if (other == apex.end()) continue;
      highest = std::max(highest, n.dot(mesh.points[other->second] - a) / (b - a).norm());
    }
  }
  return highest;
}

TEST(MeshFace, CoversAPlateWithAHoleExactly) {
  FaceMesh part;
  const TriangleMesh mesh = mesh_of(plate(10.0, 4.0), SizeRule{0.7}, &part);
  EXPECT_EQ(first_fault(mesh), std::nullopt);
  const MeshTopology shape = topology(mesh);
  EXPECT_EQ(shape.euler(), 0);  // a ring
  EXPECT_EQ(shape.bad_edges, 0);
  const MeshQuality q = quality(mesh);
  EXPECT_NEAR(q.area, 100.0 - 16.0, 1e-10);
  EXPECT_EQ(part.inverted, 0);
  EXPECT_GT(q.smallest_angle, 20.0);
  EXPECT_NEAR(q.median_edge, 0.7, 0.15 * 0.7);
}

// In the plane the criterion is Euclid's: no other corner lies in the circle of a triangle, where no border is between.
TEST(MeshFace, OfThePlaneIsDelaunay) {
  const TriangleMesh mesh = mesh_of(plate(5.0, 0.0), SizeRule{0.5});
  for (const auto& t : mesh.triangles) {
    const Xyz &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    for (const Xyz& d : mesh.points) {
      Eigen::Matrix3d m;
      const Xyz p = a - d, q = b - d, r = c - d;
      m << p.x(), p.y(), p.squaredNorm(), q.x(), q.y(), q.squaredNorm(), r.x(), r.y(), r.squaredNorm();
      EXPECT_LT(m.determinant(), 1e-9);
    }
  }
}

TEST(MeshFace, ClosesASphereOverSeamAndPoles) {
  const double radius = 3.0, h = 0.4;
  FaceMesh part;
  const TriangleMesh mesh = mesh_of(whole_sphere(radius), SizeRule{h}, &part);
  EXPECT_EQ(first_fault(mesh), std::nullopt);
  const MeshTopology shape = topology(mesh);
  EXPECT_TRUE(shape.closed());
  EXPECT_EQ(shape.euler(), 2);
  EXPECT_EQ(part.inverted, 0);
  for (const Xyz& p : mesh.points) EXPECT_NEAR(p.norm(), radius, 1e-13 * radius);
  // Triangles of edge h cut off h^2/4R^2 of the area and of the volume, to first order, and never add to them.
  const double loss = h * h / (4 * radius * radius);
  const MeshQuality q = quality(mesh);
  EXPECT_LT(q.area, 4 * kPi * radius * radius);
  EXPECT_GT(q.area, 4 * kPi * radius * radius * (1 - 1.5 * loss));
  EXPECT_LT(q.volume, 4.0 / 3 * kPi * std::pow(radius, 3));
  EXPECT_GT(q.volume, 4.0 / 3 * kPi * std::pow(radius, 3) * (1 - 2.0 * loss));
  EXPECT_GT(q.smallest_angle, 25.0);
}

TEST(MeshFace, OfASphereIsItsConvexHull) {
  EXPECT_LT(highest_above_hull(mesh_of(whole_sphere(1.0), SizeRule{0.2})), 1e-9);
}

TEST(MeshFace, FollowsCurvatureByTheAngleRule) {
  auto wave = std::make_shared<WaveSurface>(UvBox{{-3, 3}, {-3, 3}});
  const CadModel model = one_face(wave, {{{-3, -3}, 0}, {{3, -3}, 1}, {{3, 3}, 2}, {{-3, 3}, 3}});
  SizeRule rule{5.0, 0.01};
  FaceMesh coarse, fine;
  rule.angle = 0.4;
  mesh_of(model, rule, &coarse);
  rule.angle = 0.2;
  mesh_of(model, rule, &fine);
  EXPECT_EQ(fine.inverted, 0);
  // Half the angle is half the edge, a quarter of the distance, four times the triangles.
  EXPECT_NEAR(coarse.largest_distance / fine.largest_distance, 4.0, 2.0);
  EXPECT_NEAR(static_cast<double>(fine.triangles.size()) / coarse.triangles.size(), 4.0, 0.8);
}

TEST(MeshFace, SaysThatABorderCrossesItself) {
  const CadModel model =
      one_face(std::make_shared<Plane>(origin_frame()), {{{0, 0}, 0}, {{1, 1}, 1}, {{1, 0}, 2}, {{0, 1}, 3}});
  const SizeRule rule{0.3};
  const BorderPoints border = sample_border(model, rule, std::vector<double>(4, 1.0));
  const FaceMesh face = mesh_face(model.faces[0], border, rule);
  EXPECT_FALSE(face.ok);
  EXPECT_NE(face.why.find("border"), std::string::npos);
  EXPECT_TRUE(face.triangles.empty());
}

}  // namespace
}  // namespace geovor
