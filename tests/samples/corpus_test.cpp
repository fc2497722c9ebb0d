// CAD files that others wrote, meshed whole at 2 % of the diagonal of their bounding box.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <ostream>

#include "mesh/mesh_checks.h"
#include "occ_adapter/read_cad.h"
#include "pipeline/mesh_model.h"
#include "samples/mesh_facts.h"

namespace geovor::testing {
namespace {

constexpr double kSize = 0.02;        ///< of the diagonal
constexpr double kAreaError = 0.005;  ///< relative

std::filesystem::path shared_folder() {
  const char* named = std::getenv("GEOVOR_SHARED");
  return named ? std::filesystem::path(named) : std::filesystem::path(GEOVOR_SOURCE_DIR) / ".." / "shared";
}

struct CorpusFile {
  const char* name;
  const char* path;  ///< below shared/corpus
};

void PrintTo(const CorpusFile& file, std::ostream* out) { *out << file.name; }

const CorpusFile kFiles[] = {
    {"wigley", "dealii+dealii/tests__opencascade__step_files__wigley.step"},
    {"bulbous_bow", "dealii+dealii/examples__step-54__input__DTMB-5415_bulbous_bow.iges"},
    {"nacelle", "DLR-SC+tigl/tests__TestData__nacelle.stp"},
    {"tip", "mathLab+BladeX/tests__test_datasets__tip.iges"},
    {"revolved_sphere", "LLNL+axom_data/quest__step__revolved_sphere.step"},
    {"linkrods", "Open-Cascade-SAS+OCCT/data__step__linkrods.step"},
    {"ship_kcs", "unifem+overtureframework/Overture__rap__ship_kcs.igs"},
    {"frame", "debian-netgen-doc/usr__share__doc__netgen__examples__frame.step"},
};

class MeshCorpus : public ::testing::TestWithParam<CorpusFile> {
 protected:
  void SetUp() override {
    path_ = shared_folder() / "corpus" / GetParam().path;
    if (std::filesystem::exists(path_)) return;
    const char* ci = std::getenv("CI");
    if (ci && std::string(ci) == "true")
      FAIL() << path_ << " is missing; set GEOVOR_SHARED to the folder of shared data";
    GTEST_SKIP() << path_ << " is missing; set GEOVOR_SHARED to the folder of shared data";
  }
  std::filesystem::path path_;
};

void expect_closed_where_the_shape_is(const CadModel& model, const TriangleMesh& mesh) {
  for (std::size_t i = 0; i < model.shells.size(); ++i) {
    if (!model.shells[i].closed) continue;
    std::vector<int> numbers;
    for (const int face : model.shells[i].faces) numbers.push_back(model.faces[face].number);
    const MeshTopology shell = topology(part_of(mesh, numbers));
    EXPECT_TRUE(shell.closed()) << "shell " << i << ": " << shell.border_edges << " border edges, " << shell.bad_edges
                                << " bad edges";
  }
}

TEST_P(MeshCorpus, IsMeshedWhole) {
  const CadModel model = read_cad(path_.string());
  MeshOptions options;
  options.size = kSize * model.diagonal();
  const MeshResult result = mesh_model(model, options);
  ASSERT_EQ(result.faces.size(), model.faces.size());
  for (const FaceReport& face : result.faces) {
    EXPECT_TRUE(face.status == FaceStatus::Meshed) << "Face" << face.face << ": " << face.why;
    EXPECT_EQ(face.inverted, 0) << "Face" << face.face;
  }
  EXPECT_EQ(first_fault(result.mesh), std::nullopt);
  const double area = area_by_dense_sum(model);
  EXPECT_NEAR(quality(result.mesh).area, area, kAreaError * area);
  expect_closed_where_the_shape_is(model, result.mesh);
  constexpr int kTrianglesMeasured = 2000;
  EXPECT_EQ(fit(model, result.mesh, 1 + static_cast<int>(result.mesh.triangles.size()) / kTrianglesMeasured).inverted,
            0);
}

INSTANTIATE_TEST_SUITE_P(Corpus, MeshCorpus, ::testing::ValuesIn(kFiles),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace geovor::testing
