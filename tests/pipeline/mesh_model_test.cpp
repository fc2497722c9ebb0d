#include "pipeline/mesh_model.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace geovor
