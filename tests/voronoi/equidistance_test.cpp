// Equidistance by a second method over 113 bits: Hamilton's equations by extrapolation (support/quad_geodesic.h) on
// surfaces written anew, from the sites to the vertices and to points of the edges.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>

#include "support/quad_geodesic.h"
#include "surface/forms.h"
#include "test_faces.h"
#include "voronoi/diagram_builder.h"

namespace geovor::testing {
namespace {

constexpr double kEqual = 1e-12;  ///< relative difference of the distances from a point to its sites

// Of the stored points of all edges, one after the other, every third is looked at: 2,977 of 8,933. All would take two
// and a half minutes.
constexpr int kEvery = 3;

struct Scene {
  std::string name;
  TestFace face;
  std::shared_ptr<const QuadSurface> quad;
  int sites;
};

void PrintTo(const Scene& s, std::ostream* out) { *out << s.name; }

class Equidistance : public ::testing::TestWithParam<Scene> {
 protected:
  /// The distance from the site to x, given what the diagram says of the geodesic: the ray that leaves the site under
  /// this angle ends within the square root of any error from x, and its tangent there tells the rest.
  double distance(int site, double radius, double angle, const Xyz& x) const {
    const Uv start = diagram_.sites[site].uv;
    const UvVec direction = direction_at_angle(face_surface().jet(start), angle);
    const QuadEnd end = quad_geodesic(*GetParam().quad, start, direction, radius);
    Float128 ahead = 0, off = 0;
    for (int i = 0; i < 3; ++i) {
      const Float128 miss = Float128(x[i]) - coordinate(end.x, i);
      ahead += miss * coordinate(end.tangent, i);
      off += miss * miss;
    }
    EXPECT_LT(static_cast<double>(off), 1e-18 * radius * radius);
    return radius + static_cast<double>(ahead);
  }
  const Surface& face_surface() const { return *GetParam().face.model.faces[0].surface; }
  static Float128 coordinate(const QuadVec& v, int i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; }

  VoronoiDiagram diagram_;
};

TEST_P(Equidistance, HoldsAtVerticesAndAlongEdges) {
  const TestFace& face = GetParam().face;
  VoronoiOptions options;
  options.measure = false;
  diagram_ = build_diagram(face.domain(), random_sites(face.domain(), GetParam().sites, 3), options);
  double worst = 0.0;
  for (const DiagramVertex& v : diagram_.vertices) {
    if (v.sites.size() < 2) continue;
    double lo = v.radius, hi = v.radius;
    for (std::size_t i = 0; i < v.sites.size(); ++i) {
      const double d = distance(v.sites[i], v.radius, v.angles[i], v.xyz);
      lo = std::min(lo, d), hi = std::max(hi, d);
    }
    worst = std::max(worst, (hi - lo) / v.radius);
  }
  EXPECT_LE(worst, kEqual) << "at a vertex";
  worst = 0.0;
  int point = 0;
  for (const DiagramEdge& e : diagram_.edges) {
    for (const EdgePoint& p : e.points) {
      if (point++ % kEvery != 0) continue;
      const double a = distance(e.left, p.radius, p.left_angle, p.xyz);
      const double b = distance(e.right, p.radius, p.right_angle, p.xyz);
      worst = std::max(worst, std::abs(a - b) / p.radius);
    }
  }
  EXPECT_LE(worst, kEqual) << "at a point of an edge";
}

std::vector<Scene> scenes() {
  const UvBox square = {{-2, 2}, {-2, 2}};
  const auto bump = [&](double height, double width) {
    return std::make_shared<GaussianBumps>(std::vector<GaussianBumps::Bump>{{{0, 0}, height, width}}, square);
  };
  const SplineData spline = random_spline(3, 3, 3, true, 7);
  TestFace tube(std::make_shared<Cylinder>(Frame{}, 1.0));
  tube.ring({{0.0, 2.0 * kPi}, {0.0, 3.0}});
  const auto ellipsoid = std::make_shared<Ellipsoid>(1.0, 1.4, 0.8);
  return {
      {"wave", whole(std::make_shared<WaveSurface>(square)), std::make_shared<QuadWave>(), 8},
      {"paraboloid", whole(std::make_shared<Paraboloid>(kSquare)), std::make_shared<QuadParaboloid>(), 8},
      {"low_bump", whole(bump(0.5, 0.5)), std::make_shared<QuadBump>(0.5, 0.5), 60},
      {"high_bump", whole(bump(1.5, 0.4)), std::make_shared<QuadBump>(1.5, 0.4), 12},
      {"ellipsoid", whole(ellipsoid), std::make_shared<QuadEllipsoid>(1.0, 1.4, 0.8), 8},
      {"sphere", whole(std::make_shared<Sphere>(Frame{}, 1.0)), std::make_shared<QuadEllipsoid>(1.0, 1.0, 1.0), 8},
      {"cylinder", tube, std::make_shared<QuadCylinder>(), 8},
      {"torus", whole(std::make_shared<Torus>(Frame{}, 3.0, 1.0)), std::make_shared<QuadTorus>(3.0, 1.0), 8},
      {"spline", whole(std::make_shared<BSplineSurface>(spline.surface())), std::make_shared<QuadSpline>(spline), 6}};
}

INSTANTIATE_TEST_SUITE_P(Surfaces, Equidistance, ::testing::ValuesIn(scenes()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace geovor::testing
