// Diagrams on curved faces, held against laws, closed forms and brute force.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "brep/face_area.h"
#include "diagram_laws.h"
#include "surface/reparameterize.h"
#include "test_faces.h"
#include "voronoi/diagram_builder.h"

namespace geovor::testing {
namespace {

bool resolved(const VoronoiDiagram& d) {
  return std::none_of(d.warnings.begin(), d.warnings.end(), [](const auto& w) { return w.kind == "unresolved"; });
}

double area_of_cells(const VoronoiDiagram& d) {
  double sum = 0.0;
  for (const DiagramCell& cell : d.cells) sum += cell.area;
  return sum;
}

std::vector<Uv> on_sphere(int count, unsigned seed) {
  Uniform random(seed);
  std::vector<Uv> sites;
  for (int i = 0; i < count; ++i) sites.push_back({2 * kPi * random(), std::asin(2 * random() - 1)});
  return sites;
}

void check_patch(const TestFace& face, int count, unsigned seed) {
  const FaceDomain domain = face.domain();
  const VoronoiDiagram d = build_diagram(domain, random_sites(domain, count, seed));
  EXPECT_TRUE(resolved(d));
  EXPECT_EQ(broken_topology(d), "");
  EXPECT_EQ(unproved(face, d), "");
  EXPECT_EQ(euler_number(domain, d), 1);
  EXPECT_LT(worst_mismatch(domain.surface(), d), 1e-10);
  EXPECT_EQ(wrong_labels(domain, d, 2000, seed), 0);
  EXPECT_NEAR(area_of_cells(d), face_area(face.model, face.model.faces[0]).value, 1e-4);
}

TEST(CurvedDiagram, OnTheWaveObeysTheLaws) {
  check_patch(whole(std::make_shared<WaveSurface>(UvBox{{-2, 2}, {-2, 2}})), 16, 5);
}

TEST(CurvedDiagram, OnTheParaboloidObeysTheLaws) { check_patch(whole(std::make_shared<Paraboloid>(kSquare)), 12, 3); }

TEST(CurvedDiagram, OnAPatchOfASphereObeysTheLaws) {
  check_patch(TestFace(std::make_shared<Sphere>(Frame{}, 1.0)).rectangle({{0.2, 1.6}, {-0.4, 1.2}}), 15, 8);
}

/// The vertex in which a cut locus ends freely.
const DiagramVertex& free_end(const VoronoiDiagram& d) {
  const auto end = [](const DiagramVertex& v) { return v.sites.size() == 1; };
  EXPECT_EQ(std::count_if(d.vertices.begin(), d.vertices.end(), end), 1);
  return *std::find_if(d.vertices.begin(), d.vertices.end(), end);
}

// Of one site on a cone the cut locus is the line opposite, and ends in the tip.
TEST(CurvedDiagram, OnAConeEndsTheCutLocusInTheTip) {
  const auto cone = std::make_shared<Cone>(Frame{}, 2.0, 0.5);
  const double tip = cone->apex_v();
  const TestFace face = TestFace(cone).ring({{0, 2 * kPi}, {tip, tip + 6.0}});
  for (const std::vector<Uv>& sites : {std::vector<Uv>{{1.0, tip + 4.0}}, {{1.0, tip + 4.0}, {4.0, tip + 4.8}}}) {
    const VoronoiDiagram d = build_diagram(face.domain(), sites);
    EXPECT_EQ(d.warnings.size(), 0u) << d.warnings.front().kind << " " << d.warnings.front().text
                                     << d.warnings.front().uv.v;
    EXPECT_EQ(broken_topology(d), "");
    EXPECT_EQ(unproved(face, d), "");
    const DiagramVertex& end = free_end(d);
    EXPECT_EQ(end.sites.front(), 0);
    EXPECT_NEAR(end.radius, 4.0, 1e-13);
    EXPECT_LT((end.xyz - cone->apex()).norm(), 1e-13);
  }
}

// A line that turns about an axis which it meets at an angle: r = v, z = v + v^2 / 4.
class Ogive final : public Surface {
 public:
  SurfaceKind kind() const override { return SurfaceKind::Function; }
  UvBox domain() const override { return {{0.0, 2.0 * kPi}, {0.0, 2.0}}; }
  std::optional<double> u_period() const override { return 2.0 * kPi; }
  SurfaceJet jet(Uv p) const override {
    const Xyz r{std::cos(p.u), std::sin(p.u), 0.0}, q{-std::sin(p.u), std::cos(p.u), 0.0}, z = Xyz::UnitZ();
    return {p.v * r + (p.v + 0.25 * p.v * p.v) * z, p.v * q, r + (1.0 + 0.5 * p.v) * z, -p.v * r, q, 0.5 * z};
  }
  using Surface::jet;
};

// Its meridians are parabolas: the integral of sqrt(1 + w^2) dv, w = 1 + v / 2.
TEST(CurvedDiagram, OnAnOgiveEndsTheCutLocusInTheTip) {
  const TestFace face = TestFace(std::make_shared<Ogive>()).ring({{0.0, 2.0 * kPi}, {0.0, 2.0}});
  const double v = 1.2;
  const VoronoiDiagram d = build_diagram(face.domain(), {{1.0, v}});
  EXPECT_EQ(broken_topology(d), "");
  EXPECT_EQ(unproved(face, d), "");
  const auto integral = [](double w) { return w * std::hypot(1.0, w) + std::asinh(w); };
  const DiagramVertex& end = free_end(d);
  EXPECT_NEAR(end.radius, integral(1.0 + 0.5 * v) - integral(1.0), 1e-11);
  EXPECT_LT(end.xyz.norm(), 1e-11);
}

TEST(CurvedDiagram, OnTheWholeSphereHasSphericalCircumcentresAsVertices) {
  const TestFace face = whole(std::make_shared<Sphere>(Frame{}, 1.0));
  const FaceDomain domain = face.domain();
  const auto sites = on_sphere(30, 4);
  const VoronoiDiagram d = build_diagram(domain, sites);
  EXPECT_TRUE(resolved(d));
  EXPECT_EQ(broken_topology(d), "");
  EXPECT_EQ(unproved(face, d), "");
  EXPECT_EQ(euler_number(domain, d), 2);
  // 2 n - 4 faces of the convex hull.
  EXPECT_EQ(d.vertices.size(), 56u);
  for (const DiagramVertex& v : d.vertices) {
    const Xyz a = d.sites[v.sites[0]].xyz, b = d.sites[v.sites[1]].xyz, c = d.sites[v.sites[2]].xyz;
    const Xyz n = (b - a).cross(c - a).normalized();
    EXPECT_NEAR((v.xyz - n).norm(), 0.0, 1e-10);
    for (const DiagramSite& s : d.sites) EXPECT_LT(n.dot(s.xyz), n.dot(a) + 1e-10);
  }
  EXPECT_EQ(wrong_labels_in_polar_charts(domain, d, 2000, 1), 0);
  EXPECT_NEAR(area_of_cells(d), 4 * kPi, 1e-4);
}

TEST(CurvedDiagram, OfTwoPointsOfASphereIsAGreatCircle) {
  const TestFace face = whole(std::make_shared<Sphere>(Frame{}, 1.0));
  const VoronoiDiagram d = build_diagram(face.domain(), {{0.3, 0.4}, {2.0, -0.5}});
  ASSERT_EQ(d.edges.size(), 1u);
  EXPECT_TRUE(d.edges[0].closed());
  EXPECT_TRUE(d.vertices.empty());
  const Xyz axis = (d.sites[1].xyz - d.sites[0].xyz).normalized();
  for (const EdgePoint& p : d.edges[0].points) EXPECT_NEAR(axis.dot(p.xyz), 0.0, 1e-10);
  EXPECT_NEAR(d.edges[0].length, 2 * kPi, 1e-3);
  for (const DiagramCell& cell : d.cells) EXPECT_NEAR(cell.area, 2 * kPi, 1e-4);
}

TEST(CurvedDiagram, OnATorusObeysTheLaws) {
  const TestFace face = whole(std::make_shared<Torus>(Frame{}, 3.0, 1.0));
  const FaceDomain domain = face.domain();
  const VoronoiDiagram d = build_diagram(domain, random_sites(domain, 24, 11));
  EXPECT_TRUE(resolved(d));
  EXPECT_EQ(broken_topology(d), "");
  EXPECT_EQ(unproved(face, d), "");
  EXPECT_EQ(euler_number(domain, d), 0);
  EXPECT_LT(worst_mismatch(domain.surface(), d), 1e-10);
  EXPECT_NEAR(area_of_cells(d), 12 * kPi * kPi, 1e-3);
}

TEST(CurvedDiagram, OnAnEllipsoidObeysTheLaws) {
  const TestFace face = whole(std::make_shared<Ellipsoid>(1.0, 1.4, 0.8));
  const FaceDomain domain = face.domain();
  const VoronoiDiagram d = build_diagram(domain, on_sphere(12, 2));
  EXPECT_TRUE(resolved(d));
  EXPECT_EQ(broken_topology(d), "");
  EXPECT_EQ(unproved(face, d), "");
  EXPECT_EQ(euler_number(domain, d), 2);
  EXPECT_LT(worst_mismatch(domain.surface(), d), 1e-10);
}

// The development of a cylinder is a strip of the plane that repeats itself: sites and their copies one turn away.
TEST(CurvedDiagram, OnACylinderIsThatOfItsDevelopment) {
  const UvBox box = {{0, 2 * kPi}, {0, 3}};
  const TestFace face = TestFace(std::make_shared<Cylinder>(Frame{}, 1.0)).ring(box);
  const FaceDomain domain = face.domain();
  const VoronoiDiagram d = build_diagram(domain, random_sites(domain, 12, 6));
  EXPECT_TRUE(resolved(d));
  EXPECT_EQ(broken_topology(d), "");
  EXPECT_EQ(unproved(face, d), "");
  EXPECT_EQ(euler_number(domain, d), 0);
  EXPECT_NEAR(area_of_cells(d), 6 * kPi, 1e-4);
  for (const DiagramVertex& v : d.vertices) {
    for (const DiagramSite& s : d.sites) {
      double nearest = 1e9;
      for (double turn : {-2 * kPi, 0.0, 2 * kPi}) {
        nearest = std::min(nearest, std::hypot(v.uv.u - s.uv.u + turn, v.uv.v - s.uv.v));
      }
      EXPECT_GT(nearest, v.radius * (1 - 1e-11));
    }
  }
}

// A tube's only site meets itself on the line that is opposite to it.
TEST(CurvedDiagram, OfOneSiteOnACylinderIsItsCutLocus) {
  const TestFace face = TestFace(std::make_shared<Cylinder>(Frame{}, 1.0)).ring({{0, 2 * kPi}, {0, 3}});
  const VoronoiDiagram d = build_diagram(face.domain(), {{1.0, 1.2}});
  EXPECT_EQ(broken_topology(d), "");
  EXPECT_EQ(unproved(face, d), "");
  ASSERT_EQ(d.edges.size(), 1u);
  EXPECT_EQ(d.edges[0].kind, EdgeKind::CutLocus);
  EXPECT_NEAR(d.edges[0].length, 3.0, 1e-9);
  for (const EdgePoint& p : d.edges[0].points) EXPECT_NEAR(p.uv.u, 1.0 + kPi, 1e-10);
  EXPECT_NEAR(d.cells[0].area, 6 * kPi, 1e-4);
}

// A bump of height 3 and width 0.3: the cell of the site on its top is an island in the other's. The numbers are those
// of two other methods.
TEST(CurvedDiagram, FindsTheIslandOnABump) {
  const TestFace face = whole(
      std::make_shared<GaussianBumps>(std::vector<GaussianBumps::Bump>{{{0, 0}, 3.0, 0.3}}, UvBox{{-2, 2}, {-2, 2}}));
  const VoronoiDiagram d = build_diagram(face.domain(), {{1.2, 0}, {0, 0}});
  EXPECT_TRUE(resolved(d));
  EXPECT_EQ(broken_topology(d), "");
  EXPECT_EQ(unproved(face, d), "");
  const auto corner = std::find_if(d.vertices.begin(), d.vertices.end(), [](const auto& v) { return !v.on_boundary; });
  ASSERT_NE(corner, d.vertices.end());
  EXPECT_NEAR(corner->uv.u, -0.498008114704, 1e-10);
  EXPECT_NEAR(corner->uv.v, 0.0, 1e-10);
  EXPECT_NEAR(corner->radius, 2.318702738386, 1e-10);
  double nearest = 1e9, u = 0.0;
  for (const DiagramEdge& e : d.edges) {
    if (e.kind == EdgeKind::CutLocus) continue;
    for (const EdgePoint& p : e.points) {
      if (p.radius < nearest) nearest = p.radius, u = p.uv.u;
    }
  }
  EXPECT_NEAR(nearest, 1.741302701141, 1e-4);
  EXPECT_NEAR(u, 0.384006670378, 1e-2);
}

// Two bumps, each with a site on its top: two islands in the cell of the site between them (the paper's figure 6). The
// picture is its own mirror image in u = 0.
TEST(CurvedDiagram, FindsTwoIslandsOnTwoBumps) {
  const std::vector<GaussianBumps::Bump> bumps = {{{-1, 0.2}, 3.0, 0.3}, {{1, 0.2}, 3.0, 0.3}};
  const TestFace face = whole(std::make_shared<GaussianBumps>(bumps, UvBox{{-2, 2}, {-2, 2}}));
  const FaceDomain domain = face.domain();
  const VoronoiDiagram d = build_diagram(domain, {{0, -1}, {-1, 0.2}, {1, 0.2}});
  EXPECT_TRUE(resolved(d));
  EXPECT_EQ(broken_topology(d), "");
  EXPECT_EQ(unproved(face, d), "");
  EXPECT_LT(worst_mismatch(domain.surface(), d), 1e-10);
  EXPECT_NEAR(area_of_cells(d), face_area(face.model, face.model.faces[0]).value, 1e-2);
  EXPECT_NEAR(d.cells[1].area, d.cells[2].area, 1e-6);
  for (int island : {1, 2}) {
    ASSERT_EQ(d.cells[island].loops.size(), 1u);
    for (const CellPiece& piece : d.cells[island].loops[0]) {
      ASSERT_GE(piece.edge, 0) << "an island does not touch the border";
      const DiagramEdge& e = d.edges[piece.edge];
      EXPECT_EQ(std::min(e.left, e.right), 0);
      EXPECT_EQ(std::max(e.left, e.right), island);
    }
  }
}

/// Vertices as (sorted sites, place), in an order of their own.
std::vector<std::pair<std::vector<int>, Xyz>> sorted_vertices(const VoronoiDiagram& d, const std::vector<int>& rename) {
  std::vector<std::pair<std::vector<int>, Xyz>> out;
  for (const DiagramVertex& v : d.vertices) {
    std::vector<int> sites;
    for (int s : v.sites) sites.push_back(rename[s]);
    std::sort(sites.begin(), sites.end());
    out.push_back({sites, v.xyz});
  }
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) {
    if (a.first != b.first) return a.first < b.first;
    return a.second.x() < b.second.x();
  });
  return out;
}

void expect_same(const std::vector<std::pair<std::vector<int>, Xyz>>& a,
                 const std::vector<std::pair<std::vector<int>, Xyz>>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].first, b[i].first);
    EXPECT_NEAR((a[i].second - b[i].second).norm(), 0.0, 1e-9);
  }
}

TEST(CurvedDiagram, IsBlindToTheOrderOfTheSites) {
  const TestFace face = whole(std::make_shared<WaveSurface>(UvBox{{-2, 2}, {-2, 2}}));
  const FaceDomain domain = face.domain();
  const auto sites = random_sites(domain, 10, 7);
  const std::vector<int> order = {3, 7, 1, 9, 0, 4, 8, 2, 6, 5}, same = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  std::vector<Uv> permuted;
  for (int i : order) permuted.push_back(sites[i]);
  expect_same(sorted_vertices(build_diagram(domain, sites), same),
              sorted_vertices(build_diagram(domain, permuted), order));
}

TEST(CurvedDiagram, IsBlindToTheParameterization) {
  const auto wave = std::make_shared<WaveSurface>(UvBox{{-2, 2}, {-2, 2}});
  const auto warped = std::make_shared<Reparameterized>(wave, affine_map(-2.0, 0.3), cubic_map({-2, 2}, 0.4), true);
  const TestFace plain = whole(wave), other = whole(warped);
  const auto sites = random_sites(plain.domain(), 10, 9);
  std::vector<Uv> moved;
  for (Uv p : sites) moved.push_back(warped->from_base(p));
  const std::vector<int> same = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  expect_same(sorted_vertices(build_diagram(plain.domain(), sites), same),
              sorted_vertices(build_diagram(other.domain(), moved), same));
}

}  // namespace
}  // namespace geovor::testing
