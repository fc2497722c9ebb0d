// Every sample is meshed, and the mesh is held against the facts of the shape and against the CAD's surfaces.
#include <gmock/gmock.h>

#include "mesh/mesh_checks.h"
#include "pipeline/mesh_model.h"
#include "samples/facts.h"
#include "samples/mesh_facts.h"
#include "samples/sample_files.h"

namespace geovor::testing {
namespace {

constexpr double kSize = 0.04;  ///< of the diagonal of the bounding box

class MeshSample : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    ASSERT_TRUE(facts_of(GetParam())) << "no facts about this file in tests/samples/facts.cpp";
    facts_ = *facts_of(GetParam());
    options_.size = kSize * model().diagonal();
    result_ = mesh_model(model(), options_);
  }
  const CadModel& model() const { return sample(GetParam()); }
  const TriangleMesh& mesh() const { return result_.mesh; }

  Facts facts_;
  MeshOptions options_;
  MeshResult result_;
};

// One test a sample, because the mesh is made anew for each.
TEST_P(MeshSample, IsAMeshOfTheShape) {
  for (const FaceReport& face : result_.faces) {
    EXPECT_TRUE(face.status == FaceStatus::Meshed) << "Face" << face.face << ": " << face.why;
    EXPECT_EQ(face.inverted, 0) << "Face" << face.face;
  }
  ASSERT_EQ(first_fault(mesh()), std::nullopt);

  const MeshTopology shape = topology(mesh());
  EXPECT_EQ(shape.closed(), facts_.closed);
  EXPECT_EQ(shape.bad_edges, 0);
  EXPECT_EQ(shape.components, 1);
  EXPECT_EQ(shape.euler(), facts_.euler);

  constexpr int kTrianglesMeasured = 2000;
  const Fit f = fit(model(), mesh(), 1 + static_cast<int>(mesh().triangles.size()) / kTrianglesMeasured);
  EXPECT_EQ(f.inverted, 0);
  // Border points lie on the CAD's edges, which keep within their tolerance of the surfaces.
  double tolerance = 1e-9 * model().diagonal();
  for (const CadEdge& edge : model().edges) tolerance = std::max(tolerance, edge.tolerance);
  EXPECT_LT(f.worst_vertex, tolerance);
  // The curvature is sampled at four points of a triangle and may be larger between them.
  constexpr double kCurvatureBetweenSamples = 1.5;
  EXPECT_LT(f.worst_bound, kCurvatureBetweenSamples);

  const MeshQuality q = quality(mesh());
  constexpr double kAreaError = 0.005;
  EXPECT_NEAR(q.area, facts_.area, kAreaError * facts_.area);
  EXPECT_EQ(q.zero_area, 0);
  EXPECT_GT(q.mean_smallest_angle, 40.0);
  EXPECT_LT(q.below_20, 0.01 * mesh().triangles.size() + 1);
  // The solid between mesh and shape is a layer no thicker than the largest distance.
  if (facts_.volume) {
    EXPECT_NEAR(q.volume, *facts_.volume, facts_.area * f.worst_triangle + 1e-9 * *facts_.volume);
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, MeshSample, ::testing::ValuesIn(sample_files()), test_name);

}  // namespace
}  // namespace geovor::testing
