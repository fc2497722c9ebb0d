// One patch under four parameterizations: what is measured on it may not depend on which one is asked.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "brep/face_domain.h"
#include "geodesic/distance.h"
#include "samples/diagram_facts.h"
#include "samples/sample_files.h"
#include "voronoi/diagram_builder.h"

namespace geovor::testing {
namespace {

constexpr const char* kOriginal = "freeform.step";

/// A file with the map from the original's parameters to its own.
struct Variant {
  const char* file;
  Uv (*map)(Uv);
};

void PrintTo(const Variant& variant, std::ostream* out) { *out << variant.file; }

/// The inverse of u = a s / (1 + (a - 1) s).
double moebius_inverse(double u, double a) { return u / (a - (a - 1.0) * u); }

const Variant kVariants[] = {
    {"freeform_refined.step", [](Uv p) { return p; }},
    {"freeform_swapped.step",
     [](Uv p) {
       return Uv{1.0 - p.v, p.u};
     }},
    {"freeform_moebius.step",
     [](Uv p) {
       return Uv{moebius_inverse(p.u, 4.0), moebius_inverse(p.v, 0.5)};
     }},
};

const Surface& surface_of(const char* file) { return *sample(file).faces[0].surface; }

class ParameterizedSample : public ::testing::TestWithParam<Variant> {};

TEST_P(ParameterizedSample, HasThePointsOfTheOriginal) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    const Uv p{unit(random), unit(random)};
    const Xyz gap = surface_of(GetParam().file).position(GetParam().map(p)) - surface_of(kOriginal).position(p);
    ASSERT_LT(gap.norm(), 1e-12 * sample(kOriginal).diagonal()) << p.u << " " << p.v;
  }
}

TEST_P(ParameterizedSample, HasTheAreaOfTheOriginal) {
  const CadModel &model = sample(GetParam().file), &original = sample(kOriginal);
  const double area = face_area(original, original.faces[0]).value;
  EXPECT_NEAR(face_area(model, model.faces[0]).value, area, 1e-10 * area);
}

TEST_P(ParameterizedSample, HasTheDistancesOfTheOriginal) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> inside(0.1, 0.9);
  for (int i = 0; i < 40; ++i) {
    const Uv p{inside(random), inside(random)}, q{inside(random), inside(random)};
    const Connection here = distance(surface_of(kOriginal), p, q).shortest;
    const Connection there = distance(surface_of(GetParam().file), GetParam().map(p), GetParam().map(q)).shortest;
    ASSERT_EQ(here.status, ConnectStatus::Converged) << p.u << " " << p.v << " to " << q.u << " " << q.v;
    ASSERT_EQ(there.status, ConnectStatus::Converged) << p.u << " " << p.v << " to " << q.u << " " << q.v;
    EXPECT_NEAR(here.length, there.length, 1e-10 * here.length) << p.u << " " << p.v << " to " << q.u << " " << q.v;
  }
}

/// The vertices of the diagram of six sites (given on the original), in the order of the sites that they belong to.
std::vector<DiagramVertex> diagram_vertices(const char* file, Uv (*map)(Uv)) {
  const CadModel& model = sample(file);
  const FaceDomain original(sample(kOriginal), sample(kOriginal).faces[0], 1e-5 * model.diagonal());
  std::vector<Uv> sites;
  for (const Uv site : spread_sites(original, 6)) sites.push_back(map(site));
  std::vector<DiagramVertex> vertices =
      build_diagram(FaceDomain(model, model.faces[0], 1e-5 * model.diagonal()), sites).vertices;
  for (DiagramVertex& vertex : vertices) std::sort(vertex.sites.begin(), vertex.sites.end());
  std::sort(vertices.begin(), vertices.end(), [](const DiagramVertex& a, const DiagramVertex& b) {
    constexpr double kApart = 1e-3;  // mm: two vertices of the same sites are farther apart than this
    if (a.sites != b.sites) return a.sites < b.sites;
    return std::abs(a.xyz.x() - b.xyz.x()) > kApart ? a.xyz.x() < b.xyz.x() : a.xyz.y() < b.xyz.y();
  });
  return vertices;
}

TEST_P(ParameterizedSample, HasTheDiagramOfTheOriginal) {
  const auto here = diagram_vertices(kOriginal, [](Uv p) { return p; });
  const auto there = diagram_vertices(GetParam().file, GetParam().map);
  ASSERT_EQ(here.size(), there.size());
  EXPECT_GT(here.size(), 6u);
  for (std::size_t i = 0; i < here.size(); ++i) {
    EXPECT_EQ(here[i].sites, there[i].sites);
    EXPECT_LT((here[i].xyz - there[i].xyz).norm(), 1e-9 * sample(kOriginal).diagonal()) << "vertex " << i;
    EXPECT_NEAR(here[i].radius, there[i].radius, 1e-9 * here[i].radius) << "vertex " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, ParameterizedSample, ::testing::ValuesIn(kVariants), [](const auto& each) {
  const std::string file = each.param.file;
  return file.substr(0, file.find('.'));
});

}  // namespace
}  // namespace geovor::testing
