// What a diagram says about the limits of its own truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "surface/bspline_surface.h"
#include "surface/project.h"
#include "test_faces.h"
#include "voronoi/diagram_builder.h"
#include "voronoi/lost_geodesics.h"

namespace geovor::testing {
namespace {

/// A surface that keeps its periods to itself.
class Undeclared final : public Surface {
 public:
  Undeclared(SurfacePtr base, UvBox domain) : base_(std::move(base)), domain_(domain) {}
  SurfaceKind kind() const override { return SurfaceKind::Function; }
  UvBox domain() const override { return domain_; }
  SurfaceJet jet(Uv p) const override { return base_->jet(p); }

 private:
  SurfacePtr base_;
  UvBox domain_;
};

constexpr UvBox kOnce = {{0.0, 2.0 * kPi}, {0.0, 3.0}};

SurfacePtr tube() { return std::make_shared<Cylinder>(Frame{}, 1.0); }

std::vector<DiagramWarning> warnings_of(const TestFace& face, const std::vector<Uv>& sites, const std::string& kind) {
  std::vector<DiagramWarning> out;
  for (const DiagramWarning& w : build_diagram(face.domain(), sites).warnings) {
    if (w.kind == kind) out.push_back(w);
  }
  return out;
}

const std::vector<Uv> kTubeSites = {{0.5, 0.7}, {2.6, 2.2}, {5.0, 1.1}};

TEST(Warnings, ASeamWithoutPeriodIsNamed) {
  const auto w =
      warnings_of(TestFace(std::make_shared<Undeclared>(tube(), kOnce)).ring(kOnce), kTubeSites, "seam_is_border");
  ASSERT_EQ(w.size(), 1u);
  EXPECT_LT(std::min(w[0].uv.u, 2.0 * kPi - w[0].uv.u), 1e-9);
  EXPECT_NE(w[0].text.find("period"), std::string::npos);
}

TEST(Warnings, ASeamWithoutPeriodIsNamedWhereItsSidesAreTwoEdges) {
  const TestFace two_edges = TestFace(std::make_shared<Undeclared>(tube(), kOnce)).rectangle(kOnce);
  EXPECT_EQ(warnings_of(two_edges, kTubeSites, "seam_is_border").size(), 1u);
  const TestFace no_loops = whole(std::make_shared<Undeclared>(tube(), kOnce));
  EXPECT_EQ(warnings_of(no_loops, kTubeSites, "seam_is_border").size(), 1u);
}

TEST(Warnings, NoSeamIsNamedWhereThereIsNoneOrThePeriodIsDeclared) {
  EXPECT_TRUE(warnings_of(TestFace(tube()).ring(kOnce), kTubeSites, "seam_is_border").empty());
  EXPECT_TRUE(warnings_of(plane_square(), {{0.2, 0.1}, {-0.4, 0.5}}, "seam_is_border").empty());
  const UvBox open = {{0.0, 2.0 * kPi - 1e-3}, {0.0, 3.0}};
  EXPECT_TRUE(
      warnings_of(TestFace(std::make_shared<Undeclared>(tube(), open)).rectangle(open), kTubeSites, "seam_is_border")
          .empty());
}

/// A B-spline whose first and last row of poles are one is closed: the diagram runs on over its seam.
TEST(Warnings, NoSeamIsNamedOnAClosedSplineWithoutPeriodicKnots) {
  const double h = std::numbers::sqrt2 / 2.0;
  const double ring[9][3] = {{1, 0, 1},   {1, 1, h},  {0, 1, 1},  {-1, 1, h}, {-1, 0, 1},
                             {-1, -1, h}, {0, -1, 1}, {1, -1, h}, {1, 0, 1}};
  std::vector<Xyz> poles;
  std::vector<double> weights;
  for (const auto& p : ring) {
    for (const double z : {0.0, 3.0}) {
      poles.push_back({p[0], p[1], z});
      weights.push_back(p[2]);
    }
  }
  const auto spline = std::make_shared<BSplineSurface>(KnotVector({0, 1, 2, 3, 4}, {3, 2, 2, 2, 3}, 2),
                                                       KnotVector({0.0, 3.0}, {2, 2}, 1), poles, weights);
  const TestFace closed = TestFace(spline).ring({{0.0, 4.0}, {0.0, 3.0}}), round = TestFace(tube()).ring(kOnce);
  std::vector<Uv> sites;
  for (const Uv p : kTubeSites) {
    const Xyz x = tube()->position(p);
    const Uv q{p.u * 2.0 / kPi, p.v};
    sites.push_back(project_near(*spline, x, q, spline->domain()).uv);
  }
  const VoronoiDiagram a = build_diagram(closed.domain(), sites), b = build_diagram(round.domain(), kTubeSites);
  EXPECT_TRUE(a.warnings.empty());
  ASSERT_EQ(a.vertices.size(), b.vertices.size());
  ASSERT_EQ(a.edges.size(), b.edges.size());
}

std::set<int> sites_with_hidden_parts(const TestFace& face, const std::vector<Uv>& sites) {
  std::set<int> out;
  for (const DiagramWarning& w : warnings_of(face, sites, "path_leaves_face")) out.insert(w.sites.at(0));
  return out;
}

TestFace ell() {
  return TestFace(std::make_shared<Plane>(Frame{})).polygon({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
}

using Sites = std::set<int>;

// From (0.5, 0.5) all of the L is seen; from the end of one arm the end of the other is not.
TEST(Warnings, PathsAroundTheCornerOfAnLAreNamedForTheSitesTheyStartFrom) {
  EXPECT_EQ(sites_with_hidden_parts(ell(), {{0.5, 0.5}}), Sites{});
  EXPECT_EQ(sites_with_hidden_parts(ell(), {{1.8, 0.9}}), Sites{0});
  EXPECT_EQ(sites_with_hidden_parts(ell(), {{1.8, 0.9}, {0.5, 0.5}}), Sites{0});
  EXPECT_EQ(sites_with_hidden_parts(ell(), {{0.5, 0.5}, {1.8, 0.2}, {0.2, 1.8}}), Sites{});
}

// The hole's shadow falls on the edge x = 0 between y = 0.42 and y = 0.59: neither on its ends nor on its middle.
TEST(Warnings, AHoleInTheWayToAnyPartOfAnEdgeIsNamed) {
  TestFace face = plane_square();
  face.polygon({{-0.27, 0.23}, {-0.27, 0.27}, {-0.23, 0.27}, {-0.23, 0.23}});
  EXPECT_EQ(sites_with_hidden_parts(face, {{-0.5, 0.0}, {0.5, 0.0}}), Sites{0});
}

// The hole's shadow falls on the left side of the square alone.
TEST(Warnings, AHoleInTheWayToTheBorderIsNamed) {
  TestFace face = plane_square();
  face.polygon({{-0.82, 0.08}, {-0.82, 0.12}, {-0.78, 0.12}, {-0.78, 0.08}});
  EXPECT_EQ(sites_with_hidden_parts(face, {{-0.5, 0.0}, {0.5, 0.0}}), Sites{0});
}

TEST(Warnings, NoPathIsNamedOnConvexFaces) {
  const TestFace face = plane_square();
  EXPECT_EQ(sites_with_hidden_parts(face, random_sites(face.domain(), 9, 3)), Sites{});
  EXPECT_EQ(sites_with_hidden_parts(TestFace(tube()).ring(kOnce), kTubeSites), Sites{});
}

/// A plane with nothing where u and v are both small.
class TornPlane final : public Surface {
 public:
  SurfaceKind kind() const override { return SurfaceKind::Function; }
  UvBox domain() const override { return kSquare; }
  SurfaceJet jet(Uv p) const override {
    const double z = std::hypot(p.u, p.v) < kTorn ? std::numeric_limits<double>::quiet_NaN() : 0.0;
    const Xyz zero = Xyz::Zero();
    return {Xyz(p.u, p.v, z), Xyz::UnitX(), Xyz::UnitY(), zero, zero, zero};
  }
  static constexpr double kTorn = 0.1;
};

// Rays into the tear are lost, and what lies behind it can't be known from the other side.
TEST(Warnings, LostGeodesicsAreNamed) {
  TestFace face(std::make_shared<TornPlane>());
  face.rectangle(kSquare).polygon({{-0.2, -0.2}, {-0.2, 0.2}, {0.2, 0.2}, {0.2, -0.2}});
  std::set<int> named;
  for (const DiagramWarning& w : warnings_of(face, {{-0.5, 0.1}, {-0.6, -0.9}, {-0.55, 0.9}}, "unresolved"))
    named.insert(w.sites.begin(), w.sites.end());
  EXPECT_TRUE(named.count(0));
}

TEST(Warnings, WhatHasNoMeasureIsNamed) {
  VoronoiDiagram d = build_diagram(plane_square().domain(), {{0.2, 0.1}, {-0.4, 0.5}});
  warn_of_what_has_no_measure(d);
  EXPECT_TRUE(d.warnings.empty());
  d.cells[1].area = std::numeric_limits<double>::quiet_NaN();
  d.edges[0].residual = std::numeric_limits<double>::infinity();
  d.vertices[1].residual = std::numeric_limits<double>::quiet_NaN();
  warn_of_what_has_no_measure(d);
  ASSERT_EQ(d.warnings.size(), 3u);
  for (const DiagramWarning& w : d.warnings) EXPECT_EQ(w.kind, "unresolved");
  EXPECT_EQ(d.warnings[0].sites, std::vector<int>{1});
}

}  // namespace
}  // namespace geovor::testing
