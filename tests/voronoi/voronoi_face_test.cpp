// From a face of a model and a request to a diagram.
#include "pipeline/voronoi_face.h"

#include <gtest/gtest.h>

#include <limits>

#include "test_faces.h"

namespace geovor::testing {
namespace {

/// The square of plane_square(), with the box that a reader of files states.
TestFace square() {
  TestFace face = plane_square();
  face.model.lower = {-1, -1, 0};
  face.model.upper = {1, 1, 0};
  return face;
}

VoronoiResult diagram_of(const VoronoiRequest& request) {
  const TestFace face = square();
  return voronoi_face(face.model, face.model.faces[0], request);
}

VoronoiRequest given(std::vector<std::variant<Uv, Xyz>> sites) {
  VoronoiRequest request;
  request.sites = std::move(sites);
  return request;
}

VoronoiRequest counted(int count, std::uint64_t seed) {
  VoronoiRequest request;
  request.count = count;
  request.seed = seed;
  return request;
}

/// The sites at fault, (-2, -2) where there is no fault.
std::pair<int, int> fault(const VoronoiRequest& request) {
  try {
    diagram_of(request);
  } catch (const SiteError& e) {
    EXPECT_EQ(e.code(), ErrorCode::Usage);
    return {e.site(), e.other()};
  }
  return {-2, -2};
}

ErrorCode refusal(const TestFace& face, const VoronoiRequest& request) {
  try {
    voronoi_face(face.model, face.model.faces[0], request);
  } catch (const Error& e) {
    return e.code();
  }
  ADD_FAILURE() << "no error";
  return ErrorCode::Unwritable;
}

using Fault = std::pair<int, int>;

TEST(VoronoiFace, NamesTheSiteOffTheFace) {
  EXPECT_EQ(fault(given({Uv{0, 0}, Uv{0.5, 1.2}})), Fault(1, -1));
  EXPECT_EQ(fault(given({Xyz{0, 0, 0}, Xyz{0.5, 0.5, 0.1}})), Fault(1, -1));
  EXPECT_EQ(fault(given({Uv{0, 0}, Uv{std::numeric_limits<double>::quiet_NaN(), 0}})), Fault(1, -1));
}

TEST(VoronoiFace, NamesTwoEqualSitesHoweverTheyAreGiven) {
  EXPECT_EQ(fault(given({Uv{0.5, 0.5}, Uv{0, 0}, Xyz{0.5, 0.5, 0}})), Fault(0, 2));
}

TEST(VoronoiFace, TakesPlacesInSpaceForSites) {
  const VoronoiResult r = diagram_of(given({Xyz{-0.5, 0.2, 0}, Xyz{0.5, 0.2, 0}}));
  ASSERT_EQ(r.diagram.edges.size(), 1u);
  for (const EdgePoint& p : r.diagram.edges[0].points) EXPECT_NEAR(p.xyz.x(), 0.0, 1e-11);
  EXPECT_NEAR(r.diagram.edges[0].length, 2.0, 1e-10);
  EXPECT_NEAR(r.face_area, 4.0, 1e-9);
  ASSERT_EQ(r.dual.edges.size(), 1u);
  EXPECT_NEAR(r.dual.edges[0].length, 1.0, 1e-12);
}

TEST(VoronoiFace, SnapsAPlaceOffTheFaceOnlyWhenAsked) {
  VoronoiRequest request = given({Xyz{-0.5, 0, 0.3}, Xyz{0.5, 0, 0}});
  EXPECT_EQ(fault(request), Fault(0, -1));
  request.snap = true;
  EXPECT_NEAR((diagram_of(request).diagram.sites[0].xyz - Xyz(-0.5, 0, 0)).norm(), 0.0, 1e-9);
}

TEST(VoronoiFace, PlacesAsManySitesAsAreAskedFor) {
  EXPECT_EQ(diagram_of(counted(7, 0)).diagram.sites.size(), 7u);
  EXPECT_EQ(diagram_of(counted(1, 0)).diagram.sites.size(), 1u);
  VoronoiRequest spaced;
  spaced.spacing = 0.5;
  // Hexagons of this spacing in a square of area 4: 4 / (0.25 sqrt(3) / 2) = 18.5.
  EXPECT_NEAR(static_cast<double>(diagram_of(spaced).diagram.sites.size()), 18.5, 1.0);
}

TEST(VoronoiFace, GivesTheSameDiagramForTheSameSeedOnly) {
  const auto places = [](std::uint64_t seed) {
    std::vector<double> out;
    const VoronoiDiagram d = diagram_of(counted(6, seed)).diagram;
    for (const DiagramSite& s : d.sites) out.insert(out.end(), {s.xyz.x(), s.xyz.y()});
    for (const DiagramVertex& v : d.vertices) out.insert(out.end(), {v.xyz.x(), v.xyz.y(), v.radius});
    return out;
  };
  EXPECT_EQ(places(4), places(4));
  EXPECT_NE(places(4), places(5));
}

TEST(VoronoiFace, RefusesASpacingThatAsksForMillionsOfSites) {
  VoronoiRequest request;
  request.spacing = 1e-6;
  EXPECT_EQ(refusal(square(), request), ErrorCode::Usage);
}

TEST(VoronoiFace, RefusesARequestWithoutSitesAndAFaceWithoutSurface) {
  EXPECT_EQ(refusal(square(), {}), ErrorCode::Usage);
  EXPECT_EQ(refusal(square(), counted(-3, 0)), ErrorCode::Usage);
  TestFace bare = square();
  bare.model.faces[0].surface = nullptr;
  EXPECT_EQ(refusal(bare, counted(3, 0)), ErrorCode::FaceRejected);
}

}  // namespace
}  // namespace geovor::testing
