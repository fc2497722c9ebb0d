// The files in samples/cad are the ones that make_samples writes: same geometry (not bytes: the last digits and the
// writer's words may change with the version of OpenCASCADE).
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "brep/face_domain.h"
#include "occ_adapter/read_cad.h"
#include "samples/sample_files.h"

namespace geovor::testing {
namespace {

/// A folder with freshly made samples, removed at the end.
class FreshSamples : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::filesystem::temp_directory_path() / ("geovor-samples-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    made_ = std::system(("'" GEOVOR_MAKE_SAMPLES "' '" + folder_.string() + "'").c_str()) == 0;
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(folder_); }

  inline static std::filesystem::path folder_;
  inline static bool made_ = false;
};

void expect_same_edges(const CadModel& a, const CadModel& b, double tolerance) {
  ASSERT_EQ(a.edges.size(), b.edges.size());
  for (std::size_t i = 0; i < a.edges.size(); ++i) {
    ASSERT_EQ(a.edges[i].degenerate(), b.edges[i].degenerate());
    if (a.edges[i].degenerate()) continue;
    for (const double k : {0.0, 0.3, 1.0}) {
      const auto at = [k](const CadEdge& e) { return e.curve->position(e.range.lo + k * e.range.length()); };
      EXPECT_LT((at(a.edges[i]) - at(b.edges[i])).norm(), tolerance) << "edge " << i;
    }
  }
}

void expect_same_faces(const CadModel& a, const CadModel& b, double tolerance) {
  ASSERT_EQ(a.faces.size(), b.faces.size());
  constexpr double kDeflection = 1e-3;  // of the diagonal; only the region to sample is made with it
  for (std::size_t i = 0; i < a.faces.size(); ++i) {
    EXPECT_EQ(a.faces[i].reversed, b.faces[i].reversed);
    const UvBox box = FaceDomain(a, a.faces[i], kDeflection * a.diagonal()).box();
    for (const double ku : {0.1, 0.45, 0.9})
      for (const double kv : {0.2, 0.65, 0.95}) {
        const Uv p{box.u.lo + ku * box.u.length(), box.v.lo + kv * box.v.length()};
        const double gap = (a.faces[i].surface->position(p) - b.faces[i].surface->position(p)).norm();
        EXPECT_LT(gap, tolerance) << "Face" << i + 1;
      }
  }
}

TEST_F(FreshSamples, AreTheOnesInTheFolder) {
  ASSERT_TRUE(made_);
  std::vector<std::string> fresh;
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
    fresh.push_back(entry.path().filename().string());
  std::sort(fresh.begin(), fresh.end());
  EXPECT_EQ(fresh, sample_files());
}

TEST_F(FreshSamples, HaveTheGeometryOfTheFilesInTheFolder) {
  ASSERT_TRUE(made_);
  constexpr double kRelative = 1e-12;
  for (const std::string& file : sample_files()) {
    SCOPED_TRACE(file);
    const CadModel& kept = sample(file);
    const CadModel fresh = read_cad((folder_ / file).string());
    expect_same_edges(kept, fresh, kRelative * kept.diagonal());
    expect_same_faces(kept, fresh, kRelative * kept.diagonal());
  }
}

}  // namespace
}  // namespace geovor::testing
