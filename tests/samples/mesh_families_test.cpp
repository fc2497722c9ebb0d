// One geometry under many parameterizations: one mesh, and a good one.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "mesh/mesh_checks.h"
#include "occ_adapter/read_cad.h"
#include "pipeline/mesh_model.h"

namespace geovor::testing {
namespace {

constexpr double kSize = 0.3;
// Of the size: the vertices of the same mesh. The p-curves of two octants' files run 5e-8 beside their edges.
constexpr double kSame = 1e-9, kSameByPcurves = 1e-8;

/// Files of shared/faces: PREFIX_orig.step and all other PREFIX_*.step. `area`: by closed forms, but for ff (adaptive
/// quadrature, from the table that comes with the files).
struct Family {
  const char* prefix;
  double area;
};

void PrintTo(const Family& family, std::ostream* out) { *out << family.prefix; }

constexpr double kPi = std::numbers::pi;
const Family kFamilies[] = {
    {"ff", 116.63304}, {"pl", 100.0},       {"cyl", 104.71976},    {"sph", 65.83439},
    {"tor", 49.18327}, {"oct", 12.5 * kPi}, {"fsph", 100.0 * kPi}, {"ftor", 40.0 * kPi* kPi},
};

class MeshFamilies : public ::testing::TestWithParam<Family> {
 protected:
  void SetUp() override {
    const char* named = std::getenv("GEOVOR_SHARED");
    folder_ =
        (named ? std::filesystem::path(named) : std::filesystem::path(GEOVOR_SOURCE_DIR) / ".." / "shared") / "faces";
    if (std::filesystem::exists(folder_)) return;
    const char* ci = std::getenv("CI");
    if (ci && std::string(ci) == "true") FAIL() << folder_ << " is missing; set GEOVOR_SHARED";
    GTEST_SKIP() << folder_ << " is missing; set GEOVOR_SHARED to the folder of shared data";
  }

  std::string original() const { return std::string(GetParam().prefix) + "_orig"; }

  std::vector<std::string> variants() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      const std::string name = entry.path().stem().string();
      const bool ours = name.rfind(std::string(GetParam().prefix) + "_", 0) == 0;
      if (ours && entry.path().extension() == ".step" && name != original()) names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  TriangleMesh mesh_of(const std::string& name, double size) const {
    MeshOptions options;
    options.size = size;
    MeshResult result = mesh_model(read_cad((folder_ / (name + ".step")).string()), options);
    EXPECT_EQ(result.faces.at(0).status, FaceStatus::Meshed) << name << ": " << result.faces[0].why;
    EXPECT_EQ(result.faces[0].inverted, 0) << name;
    return std::move(result.mesh);
  }

 private:
  std::filesystem::path folder_;
};

/// The points in the order of their place along a direction in which no two of the mesh agree.
std::vector<int> by_place(const std::vector<Xyz>& points) {
  const Xyz direction(0.31, 0.17, 0.93);
  std::vector<int> order(points.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return direction.dot(points[a]) < direction.dot(points[b]); });
  return order;
}

/// For each point of `mesh` the nearest of `other`, and the largest distance.
std::vector<int> matches(const TriangleMesh& mesh, const TriangleMesh& other, double& largest) {
  const Xyz direction(0.31, 0.17, 0.93);
  const std::vector<int> order = by_place(other.points);
  std::vector<double> along;
  for (const int i : order) along.push_back(direction.dot(other.points[i]));
  std::vector<int> match;
  largest = 0.0;
  for (const Xyz& x : mesh.points) {
    const double reach = 0.01 * kSize;
    const auto from = std::lower_bound(along.begin(), along.end(), direction.dot(x) - reach);
    int best = order[0];
    for (auto i = from; i != along.end() && *i < direction.dot(x) + reach; ++i) {
      const int k = order[i - along.begin()];
      if ((other.points[k] - x).norm() < (other.points[best] - x).norm()) best = k;
    }
    match.push_back(best);
    largest = std::max(largest, (other.points[best] - x).norm());
  }
  return match;
}

std::set<std::array<int, 3>> corners(const TriangleMesh& mesh, const std::vector<int>& names) {
  std::set<std::array<int, 3>> result;
  for (std::array<int, 3> t : mesh.triangles) {
    for (int& v : t) v = names[v];
    std::sort(t.begin(), t.end());
    result.insert(t);
  }
  return result;
}

TEST_P(MeshFamilies, HaveOneMeshUnderEveryParameterization) {
  for (const double size : {kSize, 1.1 * kSize}) {
    const TriangleMesh first = mesh_of(original(), size);
    double nothing = 0.0;
    const auto expected = corners(first, matches(first, first, nothing));
    for (const std::string& name : variants()) {
      SCOPED_TRACE(name + " at " + std::to_string(size));
      const TriangleMesh mesh = mesh_of(name, size);
      ASSERT_EQ(mesh.points.size(), first.points.size());
      double largest = 0.0;
      EXPECT_EQ(corners(mesh, matches(mesh, first, largest)), expected);
      EXPECT_LT(largest, (name.find("_axis") == std::string::npos ? kSame : kSameByPcurves) * size);
    }
  }
}

TEST_P(MeshFamilies, AreMeshedWell) {
  const TriangleMesh mesh = mesh_of(original(), kSize);
  const MeshQuality q = quality(mesh);
  EXPECT_GE(q.smallest_angle, 36.0);
  EXPECT_GE(q.mean_smallest_angle, 55.0);
  EXPECT_EQ(q.zero_area, 0);
  EXPECT_NEAR(q.median_edge, kSize, 0.02 * kSize);
  const double ideal = GetParam().area / (0.4330127 * kSize * kSize);
  EXPECT_LE(static_cast<double>(mesh.triangles.size()), 1.04 * ideal);

  std::set<std::array<int, 2>> edges;
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) edges.insert({std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])});
  }
  std::vector<double> lengths;
  for (const auto& [a, b] : edges) lengths.push_back((mesh.points[a] - mesh.points[b]).norm());
  std::sort(lengths.begin(), lengths.end());
  EXPECT_GE(lengths[lengths.size() / 20], 0.82 * kSize);
  EXPECT_LE(lengths[lengths.size() - lengths.size() / 20], 1.12 * kSize);
}

INSTANTIATE_TEST_SUITE_P(All, MeshFamilies, ::testing::ValuesIn(kFamilies),
                         [](const auto& family) { return std::string(family.param.prefix); });

}  // namespace
}  // namespace geovor::testing
