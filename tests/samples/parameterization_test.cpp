// One patch under four parameterizations: what is measured on it may not depend on which one is asked.
#include <gtest/gtest.h>

#include <random>

#include "brep/face_domain.h"
#include "geodesic/distance.h"
#include "samples/sample_files.h"

namespace geovor::testing {
namespace {

constexpr const char* kOriginal = "freeform.step";

/// A file with the map from the original's parameters to its own.
struct Variant {
  const char* file;
  Uv (*map)(Uv);
};

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

INSTANTIATE_TEST_SUITE_P(Samples, ParameterizedSample, ::testing::ValuesIn(kVariants), [](const auto& each) {
  const std::string file = each.param.file;
  return file.substr(0, file.find('.'));
});

}  // namespace
}  // namespace geovor::testing
