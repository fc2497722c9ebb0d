#include "pipeline/mesh_model.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/error.h"
#include "delaunay/meshing_faces.h"
#include "mesh/mesh_checks.h"

namespace geovor {
namespace {

using namespace testing;

MeshOptions of_size(double size) {
  MeshOptions o;
  o.size = size;
  return o;
}

std::string refusal(const MeshOptions& options) {
  try {
    mesh_model(plate(1.0, 0.0), options);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::Usage);
    return e.what();
  }
  return "";
}

TEST(MeshModel, RefusesOptionsThatMakeNoSense) {
  EXPECT_NE(refusal(of_size(-1.0)).find("size"), std::string::npos);
  EXPECT_NE(refusal(of_size(std::numeric_limits<double>::quiet_NaN())).find("size"), std::string::npos);
  MeshOptions o = of_size(0.1);
  o.min_size = 0.2;
  EXPECT_NE(refusal(o).find("smallest size"), std::string::npos);
  o = of_size(0.1);
  o.faces = {2};
  EXPECT_NE(refusal(o).find("no Face2"), std::string::npos);
  o = of_size(0.1);
  o.gradation = 0.0;
  EXPECT_NE(refusal(o).find("gradation"), std::string::npos);
}

TEST(MeshModel, RefusesASizeThatMistakesTheUnit) {
  CadModel model = plate(1000.0, 0.0);
  model.upper = {1000, 1000, 0};
  try {
    mesh_model(model, of_size(0.01));
    FAIL() << "a hundred million triangles";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("larger --size"), std::string::npos);
  }
}

// A size beyond the part itself leaves the shape to the other rules.
TEST(MeshModel, IsNoCoarserForASizeBeyondThePart) {
  CadModel model = whole_sphere(1.0);
  model.lower = {-1, -1, -1};
  model.upper = {1, 1, 1};
  const MeshResult r = mesh_model(model, of_size(1e9));
  EXPECT_EQ(r.faces[0].status, FaceStatus::Meshed);
  EXPECT_GT(quality(r.mesh).volume, 0.97 * 4.0 / 3.0 * kPi);
}

TEST(MeshModel, TurnsTheTrianglesOfAReversedFace) {
  CadModel model = whole_sphere(2.0);
  const double outward = quality(mesh_model(model, of_size(0.4)).mesh).volume;
  model.faces[0].reversed = true;
  const double inward = quality(mesh_model(model, of_size(0.4)).mesh).volume;
  EXPECT_GT(outward, 0.0);
  EXPECT_DOUBLE_EQ(outward, -inward);
}

TEST(MeshModel, GivesTheSameMeshInWhateverOrderTheFacesRun) {
  CadModel model = plate(3.0, 1.0);
  model.faces.push_back(model.faces[0]);
  model.faces[1].number = 2;
  model.faces[1].reversed = true;
  MeshOptions o = of_size(0.3);
  const MeshResult forward = mesh_model(model, o);
  o.for_each = [](int n, const std::function<void(int)>& body) {
    for (int i = n - 1; i >= 0; --i) body(i);
  };
  const MeshResult backward = mesh_model(model, o);
  EXPECT_EQ(forward.mesh.triangles, backward.mesh.triangles);
  ASSERT_EQ(forward.mesh.points.size(), backward.mesh.points.size());
  for (size_t i = 0; i < forward.mesh.points.size(); ++i) EXPECT_EQ(forward.mesh.points[i], backward.mesh.points[i]);
}

TEST(MeshModel, NamesTheFaceThatHasNoSurfaceAndMeshesTheOther) {
  CadModel model = plate(3.0, 1.0);
  model.faces.push_back(model.faces[0]);
  model.faces[1].number = 2;
  model.faces[1].surface = nullptr;
  model.faces[1].problems = {"its surface is of a kind that geovor does not know"};
  const MeshResult r = mesh_model(model, of_size(0.3));
  EXPECT_EQ(r.faces[0].status, FaceStatus::Meshed);
  EXPECT_NEAR(r.faces[0].mesh_area, 8.0, 1e-12);
  EXPECT_EQ(r.faces[1].status, FaceStatus::Rejected);
  EXPECT_EQ(r.faces[1].why,
            model.faces[1].problems[0] + "; repair the face in the CAD system, or leave it out with --faces");
}

TEST(MeshModel, StopsWhenToldTo) {
  CadModel model = plate(3.0, 1.0);
  model.faces.push_back(model.faces[0]);
  model.faces[1].number = 2;
  MeshOptions o = of_size(0.3);
  o.progress = [](int done, int total) {
    EXPECT_EQ(done, 1);
    EXPECT_EQ(total, 2);
    return false;
  };
  const MeshResult r = mesh_model(model, o);
  EXPECT_EQ(r.faces[0].status, FaceStatus::Meshed);
  EXPECT_EQ(r.faces[1].status, FaceStatus::Stopped);
}

TEST(MeshModel, RefusesFaceRulesThatMakeNoSense) {
  const auto refused = [](FaceRule rule) {
    MeshOptions o = of_size(0.1);
    o.face_rules = {rule};
    return refusal(o);
  };
  EXPECT_NE(refused({2, 0.1, {}, {}}).find("no Face2"), std::string::npos);
  EXPECT_NE(refused({1, -0.1, {}, {}}).find("Face1"), std::string::npos);
  EXPECT_NE(refused({1, {}, std::numeric_limits<double>::quiet_NaN(), {}}).find("Face1"), std::string::npos);
  EXPECT_NE(refused({1, 1e-6, {}, {}}).find("1/10000"), std::string::npos);
  MeshOptions twice = of_size(0.1);
  twice.face_rules = {{1, 0.1, {}, {}}, {1, 0.2, {}, {}}};
  EXPECT_NE(refusal(twice).find("two rules"), std::string::npos);
}

// The rule of a face is that of the whole mesh where it is the only face.
TEST(MeshModel, MeshesAFaceByItsOwnRule) {
  const CadModel model = whole_sphere(1.0);
  MeshOptions all = of_size(0.3), own = of_size(0.5);
  all.angle = 0.2;
  own.face_rules = {{1, 0.3, {}, 0.2}};
  const MeshResult a = mesh_model(model, all), b = mesh_model(model, own);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_EQ(a.mesh.points, b.mesh.points);
  EXPECT_EQ(b.faces[0].size, 0.3);
}

// Between triangles and a sphere of radius 1 there is at most the deflection, unless a smallest size forbids it.
TEST(MeshModel, KeepsTheDeflectionOrSaysThatItDoesNot) {
  const CadModel model = whole_sphere(1.0);
  for (double deflection : {0.03, 0.01, 0.003}) {
    MeshOptions o = of_size(1.0);
    o.angle = 10.0;
    o.deflection = deflection;
    const MeshResult r = mesh_model(model, o);
    ASSERT_EQ(r.faces[0].status, FaceStatus::Meshed);
    for (const auto& corners : r.mesh.triangles) {
      const Xyz middle = (r.mesh.points[corners[0]] + r.mesh.points[corners[1]] + r.mesh.points[corners[2]]) / 3.0;
      EXPECT_LT(1.0 - middle.norm(), deflection);
    }
    EXPECT_GT(r.faces[0].largest_distance, 0.3 * deflection);  // nor is it far finer than asked for
  }
  MeshOptions o = of_size(1.0);
  o.min_size = 0.5;
  o.deflection = 0.001;
  const MeshResult r = mesh_model(model, o);
  EXPECT_EQ(r.faces[0].status, FaceStatus::Partial);
  EXPECT_NE(r.faces[0].why.find("--min-size"), std::string::npos) << r.faces[0].why;
}

// A wedge of 20 degrees: its corner is listed, and the triangle in it is not held against the mesh.
TEST(MeshModel, ListsSharpCornersAndCountsSmallAnglesAwayFromThem) {
  const double angle = 20.0 * kPi / 180.0;
  const CadModel model = one_face(std::make_shared<Plane>(origin_frame()),
                                  {{{0, 0}, 0}, {{8, 0}, 1}, {{8 * std::cos(angle), 8 * std::sin(angle)}, 2}});
  const MeshResult result = mesh_model(model, of_size(1.0));
  ASSERT_EQ(result.sharp_corners.size(), 1u);
  EXPECT_NEAR(result.sharp_corners[0].angle, 20.0, 1e-9);
  EXPECT_NEAR(result.sharp_corners[0].place.norm(), 0.0, 1e-12);
  EXPECT_EQ(result.faces[0].below_30.all, 1 + result.faces[0].below_30.away_from_corners);
  int below = 0;  // counted on the mesh itself, by the law of cosines
  for (const auto& t : result.mesh.triangles) {
    const std::array<double, 3> l{(result.mesh.points[t[0]] - result.mesh.points[t[1]]).norm(),
                                  (result.mesh.points[t[1]] - result.mesh.points[t[2]]).norm(),
                                  (result.mesh.points[t[2]] - result.mesh.points[t[0]]).norm()};
    double largest = -1.0;
    for (int i = 0; i < 3; ++i) {
      const double a = l[i], b = l[(i + 1) % 3], c = l[(i + 2) % 3];
      largest = std::max(largest, (a * a + b * b - c * c) / (2 * a * b));
    }
    below += largest > std::cos(kPi / 6);
  }
  EXPECT_EQ(result.faces[0].below_30.all, below);
}

}  // namespace
}  // namespace geovor
