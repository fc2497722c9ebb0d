// Every sample is read and is what samples/README.md says of it.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "brep/face_domain.h"
#include "samples/facts.h"
#include "samples/panel_quadrature.h"
#include "samples/sample_files.h"
#include "surface/forms.h"

namespace geovor::testing {
namespace {

double face_areas(const CadModel& model) {
  double sum = 0.0;
  for (const CadFace& face : model.faces) sum += face_area(model, face).value;
  return sum;
}

TEST(SamplesFolder, IsNotEmpty) { EXPECT_FALSE(sample_files().empty()) << GEOVOR_SAMPLES_DIR; }

TEST(SamplesFolder, HoldsNoFileAboveTheLimit) {
  constexpr std::uintmax_t kLimit = 150000;  // bytes; samples are to stay small
  for (const std::string& file : sample_files())
    EXPECT_LT(std::filesystem::file_size(sample_path(file)), kLimit) << file;
}

class ReadSample : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { ASSERT_TRUE(facts_of(GetParam())) << "no facts about this file in tests/samples/facts.cpp"; }
};

TEST_P(ReadSample, HasItsFacesWithoutProblems) {
  const CadModel& model = sample(GetParam());
  EXPECT_EQ(static_cast<int>(model.faces.size()), facts_of(GetParam())->faces);
  EXPECT_THAT(model.warnings, ::testing::IsEmpty());
  for (const CadFace& face : model.faces) {
    EXPECT_TRUE(face.surface) << "Face" << face.number;
    EXPECT_THAT(face.problems, ::testing::IsEmpty()) << "Face" << face.number;
  }
}

TEST_P(ReadSample, IsInMillimetresWhateverTheFileStates) {
  const CadModel& model = sample(GetParam());
  EXPECT_EQ(model.unit, "mm");
  EXPECT_EQ(model.file_unit, facts_of(GetParam())->unit);
}

TEST_P(ReadSample, HasOneShellThatIsClosedWhereTheShapeIs) {
  const CadModel& model = sample(GetParam());
  ASSERT_EQ(model.shells.size(), 1u);
  EXPECT_EQ(model.shells[0].closed, facts_of(GetParam())->closed);
}

TEST_P(ReadSample, HasTheAreaOfTheShape) {
  const Facts facts = *facts_of(GetParam());
  EXPECT_NEAR(face_areas(sample(GetParam())), facts.area, facts.area_error * facts.area);
}

INSTANTIATE_TEST_SUITE_P(Samples, ReadSample, ::testing::ValuesIn(sample_files()), test_name);

std::vector<std::string> graph_files() {
  std::vector<std::string> files = sample_files();
  std::erase_if(files, [](const std::string& file) { return !graph_height(file, 0.0, 0.0); });
  return files;
}

class ReadGraph : public ::testing::TestWithParam<std::string> {};

TEST_P(ReadGraph, LiesOnTheFormulaThatItWasMadeFrom) {
  const Surface& surface = *sample(GetParam()).faces[0].surface;
  const UvBox box = surface.domain();
  constexpr int kSteps = 301;
  double largest = 0.0;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const double x = box.u.lo + box.u.length() * i / kSteps, y = box.v.lo + box.v.length() * j / kSteps;
      const Xyz p = surface.position({x, y});
      largest = std::max({largest, std::abs(p.z() - *graph_height(GetParam(), p.x(), p.y())), std::abs(p.x() - x),
                          std::abs(p.y() - y)});
    }
  EXPECT_LT(largest, graph_error(GetParam()) + 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Samples, ReadGraph, ::testing::ValuesIn(graph_files()), test_name);

// The trimmed face is the patch without three disks of the parameter plane; their images by quadrature in polar
// coordinates, with no use of the p-curves.
TEST(TrimmedSample, HasTheAreaOfThePatchWithoutItsDisks) {
  const Surface& patch = *sample("freeform.step").faces[0].surface;
  const auto stretch = [&](Uv p) { return std::sqrt(first_form(patch.jet(p)).W2()); };
  constexpr int kPanelsOfPatch = 25;  // a multiple of the five spans: no panel holds a knot inside
  double area = integrate_panels({{0, 1}, {0, 1}}, kPanelsOfPatch, [&](double u, double v) { return stretch({u, v}); });
  EXPECT_NEAR(area, facts_of("freeform.step")->area, 1e-8 * area);
  struct Disk {
    Uv centre;
    double radius;
  };
  constexpr int kPanelsOfDisk = 60;
  for (const Disk& disk : {Disk{{0.3, 0.35}, 0.12}, Disk{{0.7, 0.3}, 0.08}, Disk{{0.6, 0.75}, 0.15}})
    area -= integrate_panels({{0, disk.radius}, {0, 2 * std::numbers::pi}}, kPanelsOfDisk, [&](double r, double t) {
      return r * stretch({disk.centre.u + r * std::cos(t), disk.centre.v + r * std::sin(t)});
    });
  const CadModel& model = sample("freeform_trimmed.step");
  EXPECT_NEAR(face_area(model, model.faces[0]).value, area, 1e-7 * area);
}

}  // namespace
}  // namespace geovor::testing
