// The nearest point on a model's trimmed faces against OpenCASCADE's own search over the same file.
#include <gtest/gtest.h>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>

#include <algorithm>
#include <limits>
#include <random>

#include "occ_adapter/corpus.h"
#include "occ_adapter/read_cad.h"
#include "pipeline/nearest_on_cad.h"

namespace geovor {
namespace {

class NearestAgainstOcc : public testing::TestWithParam<const char*> {};

double distance_by_occ(const std::vector<TopoDS_Face>& faces, const Xyz& x) {
  const TopoDS_Vertex vertex = BRepBuilderAPI_MakeVertex(gp_Pnt(x.x(), x.y(), x.z()));
  double least = std::numeric_limits<double>::infinity();
  for (const TopoDS_Face& face : faces) {
    const BRepExtrema_DistShapeShape found(vertex, face);
    if (found.IsDone()) least = std::min(least, found.Value());
  }
  return least;
}

// Inside and around the model's box, so that feet lie in faces, on edges and in corners, seams and poles among them.
TEST_P(NearestAgainstOcc, DistancesAgree) {
  constexpr int kPoints = 150;
  const std::string path = std::string(GEOVOR_SOURCE_DIR) + "/samples/cad/" + GetParam();
  const CadModel model = read_cad(path);
  const std::vector<TopoDS_Face> faces = test::faces_of(test::read_by_occ(path));
  const NearestOnCad cad(model, [](int n, const std::function<void(int)>& body) {
    for (int i = 0; i < n; ++i) body(i);
  });
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(-0.2, 1.2);
  // What the flattened border may hide, and what a vertex's and an edge's tolerance allows.
  const double tolerance = NearestOnCad::kPrecision * model.diagonal();
  for (int i = 0; i < kPoints; ++i) {
    Xyz x = model.lower;
    for (int k = 0; k < 3; ++k) x[k] += share(random) * (model.upper[k] - model.lower[k]);
    const CadPlace place = cad.nearest(x);
    ASSERT_GE(place.face, 0);
    EXPECT_NEAR(place.distance, distance_by_occ(faces, x), tolerance) << "at " << x.transpose();
    EXPECT_NEAR((place.foot - x).norm(), place.distance, 1e-12 * model.diagonal());
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, NearestAgainstOcc,
                         testing::Values("bracket.step", "cone.step", "cylinder_tube.step", "freeform_moebius.step",
                                         "freeform_trimmed.step", "plate.step", "sphere.step", "torus.step"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

}  // namespace
}  // namespace geovor
