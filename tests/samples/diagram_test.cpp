// The geodesic Voronoi diagram of some sites on the largest face of every sample, held against distances computed anew.
#include <gmock/gmock.h>

#include <algorithm>
#include <optional>
#include <random>

#include "samples/diagram_facts.h"
#include "samples/sample_files.h"
#include "voronoi/diagram_builder.h"

namespace geovor::testing {
namespace {

constexpr int kSites = 6;

class DiagramSample : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const CadModel& model = sample(GetParam());
    cad_face_ = &largest_face(model);
    face_.emplace(model, *cad_face_, 1e-5 * model.diagonal());
    sites_ = spread_sites(*face_, kSites);
    ASSERT_EQ(static_cast<int>(sites_.size()), kSites);
    diagram_ = build_diagram(*face_, sites_);
    for (const DiagramWarning& w : diagram_.warnings) ASSERT_NE(w.kind, "unresolved") << w.text;
    ASSERT_EQ(static_cast<int>(diagram_.cells.size()), kSites);
  }
  const Surface& surface() const { return face_->surface(); }
  double distance_to_site(int site, Uv p) const { return measured_distance(surface(), sites_[site], p); }
  void expect_vertices_as_far_as_said_and_no_site_nearer() const;
  void expect_edges_halfway() const;
  void expect_cells_that_add_up_to_the_face() const;
  void expect_each_site_in_its_cell_alone() const;
  void expect_points_in_the_cells_of_their_nearest_sites() const;
  bool periodic() const { return surface().u_period() || surface().v_period(); }

  const CadFace* cad_face_ = nullptr;
  std::optional<FaceDomain> face_;
  std::vector<Uv> sites_;
  VoronoiDiagram diagram_;
};

void DiagramSample::expect_vertices_as_far_as_said_and_no_site_nearer() const {
  constexpr double kRelative = 1e-9;
  for (const DiagramVertex& vertex : diagram_.vertices) {
    EXPECT_LT((surface().position(vertex.uv) - vertex.xyz).norm(), kRelative * sample(GetParam()).diagonal());
    for (int site = 0; site < kSites; ++site) {
      const double measured = distance_to_site(site, vertex.uv);
      const bool own = std::find(vertex.sites.begin(), vertex.sites.end(), site) != vertex.sites.end();
      EXPECT_GE(measured, vertex.radius * (1.0 - kRelative)) << "site " << site;
      // A vertex of one site is the end of its cut locus, next to a conjugate point: there the referee's shooting is
      // singular.
      if (own && vertex.sites.size() > 1) {
        EXPECT_LE(measured, vertex.radius * (1.0 + kRelative)) << "site " << site;
      }
    }
  }
}

void DiagramSample::expect_edges_halfway() const {
  constexpr double kRelative = 1e-9;
  constexpr int kPointsAnEdge = 3;
  for (const DiagramEdge& edge : diagram_.edges)
    for (int k = 1; k <= kPointsAnEdge; ++k) {
      const EdgePoint& p = edge.points[edge.points.size() * k / (kPointsAnEdge + 1)];
      EXPECT_NEAR(distance_to_site(edge.left, p.uv), p.radius, kRelative * p.radius);
      EXPECT_NEAR(distance_to_site(edge.right, p.uv), p.radius, kRelative * p.radius);
    }
}

void DiagramSample::expect_cells_that_add_up_to_the_face() const {
  const double whole = face_area(sample(GetParam()), *cad_face_).value;
  double sum = 0.0;
  for (const DiagramCell& cell : diagram_.cells) {
    EXPECT_GT(cell.area, 0.0) << "cell of site " << cell.site;
    sum += cell.area;
  }
  // The cells' borders are polylines within 1e-5 of the face's size. Where a cut locus is not followed to its end a
  // sliver of the cell is missing, and the diagram must say so.
  const auto told = [this](const std::string& kind) {
    return std::any_of(diagram_.warnings.begin(), diagram_.warnings.end(),
                       [&](const auto& w) { return w.kind == kind; });
  };
  const double relative = told("cut_locus") ? 1e-2 : 1e-4;
  EXPECT_NEAR(sum, whole, relative * whole);
}

void DiagramSample::expect_each_site_in_its_cell_alone() const {
  for (int site = 0; site < kSites; ++site)
    for (const DiagramCell& cell : diagram_.cells)
      EXPECT_EQ(cell_holds(diagram_, cell, sites_[site]), cell.site == site)
          << "site " << site << " cell " << cell.site;
}

// Points of the face taken at random lie in the cell of the site that is nearest to them.
void DiagramSample::expect_points_in_the_cells_of_their_nearest_sites() const {
  std::mt19937 random(21);
  std::uniform_real_distribution<double> u(face_->box().u.lo, face_->box().u.hi),
      v(face_->box().v.lo, face_->box().v.hi);
  constexpr int kPoints = 60;
  constexpr double kClear = 1e-3;  // of the distance: nearer to a border than this the polyline may decide otherwise
  for (int i = 0; i < kPoints; ++i) {
    const Uv p{u(random), v(random)};
    if (!face_->contains(p) || face_->distance_to_border(p) < 1e-3 * sample(GetParam()).diagonal()) continue;
    std::vector<double> measured;
    for (int site = 0; site < kSites; ++site) measured.push_back(distance_to_site(site, p));
    const int nearest = static_cast<int>(std::min_element(measured.begin(), measured.end()) - measured.begin());
    std::vector<double> sorted = measured;
    std::sort(sorted.begin(), sorted.end());
    if (sorted[1] - sorted[0] < kClear * sorted[1]) continue;
    EXPECT_TRUE(cell_holds(diagram_, diagram_.cells[nearest], p)) << p.u << " " << p.v << " nearest site " << nearest;
  }
}

// One test a sample, so that each diagram is computed once.
TEST_P(DiagramSample, IsTheDiagramOfItsSites) {
  expect_vertices_as_far_as_said_and_no_site_nearer();
  expect_edges_halfway();
  expect_cells_that_add_up_to_the_face();
  if (periodic()) return;  // in the parameter plane the cells of a closed surface are no plain polygons
  expect_each_site_in_its_cell_alone();
  expect_points_in_the_cells_of_their_nearest_sites();
}

INSTANTIATE_TEST_SUITE_P(Samples, DiagramSample, ::testing::ValuesIn(sample_files()), test_name);

}  // namespace
}  // namespace geovor::testing
