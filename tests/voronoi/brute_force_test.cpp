// For 1e5 random points a face the nearest site by brute force is the site of the cell that holds the point.
#include <gtest/gtest.h>

#include <tuple>

#include "cell_labels.h"
#include "support/splines.h"
#include "test_faces.h"
#include "voronoi/diagram_builder.h"

namespace geovor::testing {
namespace {

constexpr int kSites = 20;
constexpr int kPoints = 100000;
constexpr int kShards = 4;  ///< each is a ctest case of its own

const char* const kFaces[] = {"plane", "sphere", "cylinder", "wave", "paraboloid", "spline", "torus", "ellipsoid"};

TestFace face_of(const std::string& name) {
  if (name == "plane") return plane_square();
  if (name == "sphere") return whole(std::make_shared<Sphere>(Frame{}, 1.0));
  if (name == "cylinder")
    return TestFace(std::make_shared<Cylinder>(Frame{}, 1.0)).ring({{0.0, 2.0 * kPi}, {0.0, 3.0}});
  if (name == "wave") return whole(std::make_shared<WaveSurface>(UvBox{{-2, 2}, {-2, 2}}));
  if (name == "paraboloid") return whole(std::make_shared<Paraboloid>(kSquare));
  if (name == "spline") return whole(std::make_shared<BSplineSurface>(random_spline(3, 3, 3, true, 7).surface()));
  if (name == "torus") return whole(std::make_shared<Torus>(Frame{}, 3.0, 1.0));
  return whole(std::make_shared<Ellipsoid>(1.0, 1.4, 0.8));
}

class BruteForce : public ::testing::TestWithParam<std::tuple<const char*, int>> {};

TEST_P(BruteForce, AgreesWithTheCells) {
  const auto [name, shard] = GetParam();
  const TestFace face = face_of(name);
  const FaceDomain domain = face.domain();
  VoronoiOptions options;
  options.measure = false;
  const VoronoiDiagram d = build_diagram(domain, random_sites(domain, kSites, 3), options);
  const DistanceFinder finder(domain.surface());
  const LabelCheck check =
      compare_with_brute_force(domain, d, shortest_by(finder), kPoints / kShards, 100 + static_cast<unsigned>(shard));
  EXPECT_EQ(check.looked_at, kPoints / kShards);
  EXPECT_EQ(check.wrong, 0) << check.first_wrong;
  EXPECT_LT(check.undecided, check.looked_at / 1000);
}

INSTANTIATE_TEST_SUITE_P(Shards, BruteForce,
                         ::testing::Combine(::testing::ValuesIn(kFaces), ::testing::Range(0, kShards)),
                         [](const auto& instance) {
                           return std::string(std::get<0>(instance.param)) + "_" +
                                  std::to_string(std::get<1>(instance.param));
                         });

}  // namespace
}  // namespace geovor::testing
