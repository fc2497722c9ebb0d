// Sites placed on one face under many parameterizations: the same points of space.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <ostream>

#include "brep/face_domain.h"
#include "occ_adapter/read_cad.h"
#include "voronoi/place_sites.h"

namespace geovor::testing {
namespace {

constexpr int kSites = 12;

/// Files of shared/faces: PREFIX_NAME.step, the first one beside which the others are held.
struct Family {
  const char* prefix;
  std::vector<const char*> names;
};

void PrintTo(const Family& family, std::ostream* out) { *out << family.prefix; }

const Family kFamilies[] = {
    {"ff", {"orig", "swaprev", "moeb16"}},
    {"sph", {"orig", "nurbs", "moeb16", "pow3u", "smooth"}},
    {"oct", {"orig", "axisx"}},
    {"pl", {"orig", "shear5", "skew2", "pow3u", "smooth"}},  // corners without tangent plane
    {"tor", {"orig", "smooth", "moeb64"}},                   // the same, and samples of the border elsewhere
};

std::filesystem::path shared_folder() {
  const char* named = std::getenv("GEOVOR_SHARED");
  return named ? std::filesystem::path(named) : std::filesystem::path(GEOVOR_SOURCE_DIR) / ".." / "shared";
}

struct Placed {
  std::vector<Xyz> x;
  double size = 0.0;
};

Placed places(const std::filesystem::path& file) {
  const CadModel model = read_cad(file.string());
  const FaceDomain domain(model, model.faces[0], 1e-6 * model.diagonal());
  Placed placed{{}, model.diagonal()};
  for (Uv p : place_sites(domain, kSites, 1)) placed.x.push_back(domain.surface().position(p));
  return placed;
}

class PlacedSites : public ::testing::TestWithParam<Family> {};

TEST_P(PlacedSites, AreTheSameUnderEveryParameterization) {
  const std::filesystem::path folder = shared_folder() / "faces";
  if (!std::filesystem::exists(folder)) {
    const char* ci = std::getenv("CI");
    if (ci && std::string(ci) == "true") FAIL() << folder << " is missing; set GEOVOR_SHARED";
    GTEST_SKIP() << folder << " is missing; set GEOVOR_SHARED to the folder of shared data";
  }
  const auto file = [&](const char* name) { return folder / (std::string(GetParam().prefix) + "_" + name + ".step"); };
  const Placed first = places(file(GetParam().names.front()));
  ASSERT_EQ(first.x.size(), static_cast<std::size_t>(kSites));
  for (const char* name : GetParam().names) {
    const Placed other = places(file(name));
    ASSERT_EQ(other.x.size(), first.x.size());
    for (int i = 0; i < kSites; ++i) {
      EXPECT_LT((other.x[i] - first.x[i]).norm(), 1e-8 * first.size) << name << ", site " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Families, PlacedSites, ::testing::ValuesIn(kFamilies));

}  // namespace
}  // namespace geovor::testing
