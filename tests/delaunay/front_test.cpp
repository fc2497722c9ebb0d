#include "delaunay/front.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "delaunay/mesh_border.h"
#include "delaunay/meshing_faces.h"
#include "delaunay/stars.h"

namespace geovor {
namespace {

using namespace testing;

struct Filled {
  MeshBorder border;
  std::vector<MeshVertex> points;
};

Filled fill(const CadModel& model, const SizeRule& rule) {
  const CadFace& face = model.faces[0];
  const SurfaceProbe probe(*face.surface, parameter_box(face));
  const BorderPoints samples = sample_border(model, rule, std::vector<double>(model.edges.size(), 1.0));
  MeshBorder border = mesh_border(face, probe, samples);
  EXPECT_EQ(border.why, "");
  auto points = fill_by_fronts(probe, rule, SizeField(rule, border.points), border);
  return {std::move(border), std::move(points)};
}

double nearest_pair(const std::vector<MeshVertex>& points) {
  double least = 1e300;
  for (size_t i = 0; i < points.size(); ++i) {
    for (size_t k = 0; k < i; ++k) least = std::min(least, (points[i].x - points[k].x).norm());
  }
  return least;
}

/// From the place to the nearest point.
double gap_at(const std::vector<MeshVertex>& points, const Xyz& x) {
  double least = 1e300;
  for (const MeshVertex& p : points) least = std::min(least, (p.x - x).norm());
  return least;
}

TEST(FillByFronts, LeavesNoHoleInASphereAndCrowdsNowhere) {
  const Filled sphere = fill(whole_sphere(3.0), SizeRule{0.4});
  EXPECT_TRUE(sphere.border.points.empty());  // neither the seam nor the poles are border
  EXPECT_GT(nearest_pair(sphere.points), 0.75 * 0.4);
  for (int i = 0; i < 2000; ++i) {  // places of a spiral from pole to pole
    const double z = -1.0 + (i + 0.5) / 1000.0, turn = 2.399963229728653 * i, r = std::sqrt(1.0 - z * z);
    EXPECT_LT(gap_at(sphere.points, 3.0 * Xyz(r * std::cos(turn), r * std::sin(turn), z)), 0.9 * 0.4);
  }
}

TEST(FillByFronts, KeepsWithinTheBorder) {
  const Filled ring = fill(plate(10.0, 4.0), SizeRule{0.7});
  EXPECT_EQ(ring.border.points.size(), 4u * 14 + 4u * 6);
  for (size_t i = ring.border.points.size(); i < ring.points.size(); ++i) {
    const Xyz& x = ring.points[i].x;
    const double to_centre = std::max(std::abs(x[0] - 5.0), std::abs(x[1] - 5.0));
    EXPECT_GT(to_centre, 2.0 + 0.3 * 0.7);
    EXPECT_LT(to_centre, 5.0 - 0.3 * 0.7);
  }
}

TEST(FillByFronts, TakesTheSizesOfTheBorder) {
  SizeRule rule{1.0};
  CadModel model = plate(10.0, 0.0);
  BorderPoints samples = sample_border(model, rule, {8.0, 1.0, 1.0, 1.0});
  const SurfaceProbe probe(*model.faces[0].surface, parameter_box(model.faces[0]));
  const MeshBorder border = mesh_border(model.faces[0], probe, samples);
  const auto points = fill_by_fronts(probe, rule, SizeField(rule, border.points), border);
  for (const MeshVertex& p : points)
    EXPECT_LE(p.h, std::min(1.0, 0.125 * 1.3 + rule.gradation * p.x[1]) * 1.001) << p.x.transpose();
}

TEST(MeshBorder, OfATubeIsTwoCirclesWithoutTheSeam) {
  const CadModel tube = one_face(std::make_shared<Cylinder>(origin_frame(), 1.0),
                                 {{{0, 0}, 0}, {{2 * kPi, 0}, 0}, {{2 * kPi, 3}, 1}, {{0, 3}, 1}});
  const SizeRule rule{0.3};
  const SurfaceProbe probe(*tube.faces[0].surface, parameter_box(tube.faces[0]));
  const MeshBorder border =
      mesh_border(tube.faces[0], probe, sample_border(tube, rule, std::vector<double>(tube.edges.size(), 1.0)));
  EXPECT_EQ(border.why, "");
  EXPECT_EQ(border.points.size(), 2u * 21);  // the circle is 20.9 sizes long
  for (size_t i = 0; i < border.points.size(); ++i) {
    EXPECT_NEAR(border.points[i].x[2], border.points[border.next[i]].x[2], 1e-12);
    EXPECT_EQ(border.before[border.next[i]], static_cast<int>(i));
  }
}

TEST(MeshBorder, HasTheTipOfACone) {
  const double half_angle = kPi / 6;
  const CadModel cone = one_face(
      std::make_shared<Cone>(origin_frame(), 1.0, half_angle),
      {{{0, -1 / std::sin(half_angle)}, 0}, {{2 * kPi, -1 / std::sin(half_angle)}, 0}, {{2 * kPi, 1}, 1}, {{0, 1}, 1}});
  const SizeRule rule{0.3};
  const Filled filled = fill(cone, rule);
  const auto tip = std::count(filled.border.is_tip.begin(), filled.border.is_tip.end(), 1);
  EXPECT_EQ(tip, 1);
  const auto triangles = triangulate_by_stars(filled.points, filled.border, rule.size);
  ASSERT_TRUE(triangles.has_value());
  int vertices = 0, edges = 0;
  for (int v = 0; v < triangles->vertex_count(); ++v) vertices += triangles->outgoing(v) != HalfEdges::kNone;
  for (int e = 0; e < 3 * triangles->triangle_count(); ++e) edges += e > triangles->twin(e);
  EXPECT_EQ(vertices - edges + triangles->triangle_count(), 1);  // a disk
}

TEST(MeshBorder, SeesOnItsOwnSideOnly) {
  const CadModel model = plate(10.0, 4.0);
  const SizeRule rule{1.0};
  const SurfaceProbe probe(*model.faces[0].surface, parameter_box(model.faces[0]));
  const MeshBorder border =
      mesh_border(model.faces[0], probe, sample_border(model, rule, std::vector<double>(model.edges.size(), 1.0)));
  for (size_t i = 0; i < border.points.size(); ++i) {
    const Xyz& x = border.points[i].x;
    if (x[0] > 1e-9 || x[1] < 0.5 || x[1] > 9.5) continue;  // on the outer side x = 0
    EXPECT_TRUE(border.sees(static_cast<int>(i), x + Xyz(0.1, 0.0, 0.0)));
    EXPECT_FALSE(border.sees(static_cast<int>(i), x - Xyz(0.1, 0.0, 0.0)));
  }
}

}  // namespace
}  // namespace geovor
