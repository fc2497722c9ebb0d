// The border points of one face under many parameterizations: the same points of space.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "delaunay/border.h"
#include "occ_adapter/read_cad.h"

namespace geovor::testing {
namespace {

// The files' numbers have 15 digits: their curves agree to 1e-11, and their p-curves run up to 5e-11 beside them.
constexpr double kRoundingOfFiles = 1e-10;

/// Files of shared/faces: PREFIX_NAME.step.
struct Family {
  const char* prefix;
  std::vector<const char*> names;
};

void PrintTo(const Family& family, std::ostream* out) { *out << family.prefix; }

const Family kFamilies[] = {
    {"ff", {"deg5knots", "swap", "revu", "swaprev", "moeb4", "moeb16", "moeb64", "pow3u", "pow3uv", "smooth"}},
    {"pl",
     {"bilin", "shear1", "shear5", "shear20", "skew1", "skew2", "skew4", "moeb4", "moeb16", "moeb64", "pow3u", "pow3uv",
      "smooth"}},
    {"cyl", {"nurbs", "moeb4", "moeb16", "moeb64", "pow3u", "pow3uv", "smooth"}},
    {"sph", {"nurbs", "moeb4", "moeb16", "moeb64", "pow3u", "pow3uv", "smooth"}},
    {"tor", {"nurbs", "moeb4", "moeb16", "moeb64", "pow3u", "pow3uv", "smooth"}},
    {"oct", {"nurbs", "axisx", "axisout"}},
};

std::filesystem::path shared_folder() {
  const char* named = std::getenv("GEOVOR_SHARED");
  return named ? std::filesystem::path(named) : std::filesystem::path(GEOVOR_SOURCE_DIR) / ".." / "shared";
}

std::vector<Xyz> border_points(const CadModel& model, const SizeRule& rule) {
  return sample_border(model, rule, std::vector<double>(model.edges.size(), 1.0)).points;
}

/// From each of the points to the nearest of the others, the largest.
double largest_gap(const std::vector<Xyz>& points, const std::vector<Xyz>& others) {
  double largest = 0.0;
  for (const Xyz& p : points) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Xyz& q : others) nearest = std::min(nearest, (p - q).norm());
    largest = std::max(largest, nearest);
  }
  return largest;
}

class BorderFiles : public ::testing::TestWithParam<Family> {};

// Under the first rule the size decides alone, under the others curvature and gradation do too.
TEST_P(BorderFiles, HaveTheSamePointsUnderEveryParameterization) {
  const std::filesystem::path folder = shared_folder() / "faces";
  if (!std::filesystem::exists(folder)) {
    const char* ci = std::getenv("CI");
    if (ci && std::string(ci) == "true") FAIL() << folder << " is missing; set GEOVOR_SHARED";
    GTEST_SKIP() << folder << " is missing; set GEOVOR_SHARED to the folder of shared data";
  }
  const auto read = [&](const char* name) {
    return read_cad((folder / (std::string(GetParam().prefix) + "_" + name + ".step")).string());
  };
  SizeRule plain{0.3, 0.015}, fine{0.3, 0.015}, coarse{3.0, 0.15};
  fine.angle = coarse.angle = 0.2;
  const CadModel original = read("orig");
  for (const char* name : GetParam().names) {
    const CadModel variant = read(name);
    for (const SizeRule& rule : {plain, fine, coarse}) {
      SCOPED_TRACE(std::string(name) + " at " + std::to_string(rule.size) + ", " + std::to_string(rule.angle));
      const std::vector<Xyz> first = border_points(original, rule), other = border_points(variant, rule);
      ASSERT_GE(first.size(), 4u);
      EXPECT_EQ(other.size(), first.size());
      EXPECT_LT(largest_gap(first, other), kRoundingOfFiles);
      EXPECT_LT(largest_gap(other, first), kRoundingOfFiles);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Families, BorderFiles, ::testing::ValuesIn(kFamilies));

}  // namespace
}  // namespace geovor::testing
