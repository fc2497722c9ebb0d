// The faces of a set of STEP files that hold one shape each under many parameterizations, written by OpenCASCADE:
// distances and paths must be the original's, but for what the files themselves differ by (faces.tsv says how much).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include "geodesic/distance.h"
#include "geodesic/trace.h"
#include "occ_adapter/read_cad.h"
#include "support/differences.h"
#include "surface/project.h"

namespace geovor {
namespace {

using namespace testing;
constexpr double kLengthBar = 1e-12;
constexpr double kPathBar = 1e-11;

std::filesystem::path faces_folder() {
  const char* named = std::getenv("GEOVOR_SHARED");
  return (named ? std::filesystem::path(named) : std::filesystem::path(GEOVOR_SOURCE_DIR) / ".." / "shared") / "faces";
}

/// By name: how far the points of the file lie from those meant, as measured by who made it.
std::map<std::string, double> file_errors() {
  std::map<std::string, double> errors;
  std::ifstream table(faces_folder() / "faces.tsv");
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    std::istringstream columns(line);
    std::string name;
    double made = 0.0, read_back = 0.0;
    if (columns >> name >> made >> read_back) errors[name] = made + read_back;
  }
  return errors;
}

/// The rectangle of the parameter plane around a face.
UvBox parameter_box(const CadFace& face) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  UvBox box{{kInf, -kInf}, {kInf, -kInf}};
  for (const TrimLoop& loop : face.loops) {
    for (const Coedge& c : loop.coedges) {
      for (int i = 0; i <= 16; ++i) {
        const auto C = c.pcurve->jet(c.range.lo + i * c.range.length() / 16.0).C;
        const Uv p{C.x(), C.y()};
        box.u = {std::min(box.u.lo, p.u), std::max(box.u.hi, p.u)};
        box.v = {std::min(box.v.lo, p.v), std::max(box.v.hi, p.v)};
      }
    }
  }
  return box;
}

UvBox inner(const UvBox& box, double margin) {
  const double u = margin * box.u.length(), v = margin * box.v.length();
  return {{box.u.lo + u, box.u.hi - u}, {box.v.lo + v, box.v.hi - v}};
}

std::vector<GeodesicState> states(const Surface& surface, Uv p, const Connection& c) {
  TraceOptions options;
  options.tolerance = 1e-14;
  options.stop_at_domain = false;
  return sample_geodesic(surface, p, c.start_direction, c.length, 8, options);
}

class FaceFiles : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (std::filesystem::exists(faces_folder() / "faces.tsv")) return;
    const char* ci = std::getenv("CI");
    if (ci && std::string(ci) == "true")
      FAIL() << faces_folder() << " is missing; set GEOVOR_SHARED to the folder of shared data";
    GTEST_SKIP() << faces_folder() << " is missing; set GEOVOR_SHARED to the folder of shared data";
  }
};

TEST_P(FaceFiles, HaveTheDistancesAndPathsOfTheOriginal) {
  const std::string name = GetParam(), original = name.substr(0, name.find('_')) + "_orig";
  const CadModel model = read_cad((faces_folder() / (name + ".step")).string());
  const CadModel first = read_cad((faces_folder() / (original + ".step")).string());
  auto errors = file_errors();
  const double apart = errors.at(name) + errors.at(original);
  const Surface &a = *first.faces[0].surface, &b = *model.faces[0].surface;
  const UvBox box = parameter_box(first.faces[0]), other_box = parameter_box(model.faces[0]);
  DistanceOptions options;
  options.connect.tolerance = 1e-13;
  const DistanceFinder here(a, options), there(b, options);
  std::mt19937 random(1);
  int compared = 0;
  for (int i = 0; i < 15; ++i) {
    const Uv pa = random_point(random, inner(box, 0.15)), qa = random_point(random, inner(box, 0.15));
    const Connection ours = here.distance(pa, qa).shortest;
    ASSERT_EQ(ours.status, ConnectStatus::Converged);
    const std::vector<GeodesicState> path = states(a, pa, ours);
    // Beyond the face the two surfaces need not be the same.
    if (!std::all_of(path.begin(), path.end(), [&](const GeodesicState& s) { return box.contains(s.p); })) continue;
    const Projection p = project(b, a.position(pa), other_box), q = project(b, a.position(qa), other_box);
    ASSERT_LT(std::max(p.distance, q.distance), 4.0 * apart + 1e-14 * a.position(pa).norm());
    const Connection theirs = there.distance(p.uv, q.uv).shortest;
    ASSERT_EQ(theirs.status, ConnectStatus::Converged);
    ++compared;
    EXPECT_NEAR(ours.length, theirs.length, kLengthBar * ours.length + 4.0 * apart);
    const std::vector<GeodesicState> other = states(b, p.uv, theirs);
    ASSERT_EQ(path.size(), other.size());
    for (std::size_t k = 0; k < path.size(); ++k)
      EXPECT_LT((a.position(path[k].p) - b.position(other[k].p)).norm(), kPathBar * ours.length + 10.0 * apart) << k;
  }
  EXPECT_GE(compared, 5);
}

INSTANTIATE_TEST_SUITE_P(Freeform, FaceFiles,
                         ::testing::Values("ff_deg5knots", "ff_swap", "ff_revu", "ff_swaprev", "ff_moeb4", "ff_moeb16",
                                           "ff_moeb64", "ff_pow3u", "ff_pow3uv", "ff_smooth"),
                         [](const auto& instance) { return std::string(instance.param); });
INSTANTIATE_TEST_SUITE_P(Elementary, FaceFiles,
                         ::testing::Values("cyl_nurbs", "cyl_moeb4", "cyl_moeb16", "cyl_moeb64", "cyl_pow3u",
                                           "cyl_pow3uv", "cyl_smooth", "sph_nurbs", "sph_moeb4", "sph_moeb16",
                                           "sph_moeb64", "sph_pow3u", "sph_pow3uv", "sph_smooth", "tor_nurbs",
                                           "tor_moeb4", "tor_moeb16", "tor_moeb64", "tor_pow3u", "tor_pow3uv",
                                           "tor_smooth"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace geovor
