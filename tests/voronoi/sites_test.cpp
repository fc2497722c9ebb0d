// What sites must fulfil.
#include "voronoi/sites.h"

#include <gtest/gtest.h>

#include <limits>

#include "test_faces.h"

namespace geovor::testing {
namespace {

TEST(CheckSites, NamesTheSiteThatLiesOutside) {
  const TestFace face = plane_square();
  try {
    check_sites(face.domain(), {{0, 0}, {0.5, 1.2}, {3, 3}}, 1e-7);
    FAIL() << "no error";
  } catch (const SiteError& e) {
    EXPECT_EQ(e.code(), ErrorCode::Usage);
    EXPECT_EQ(e.site(), 1);
    EXPECT_EQ(e.other(), -1);
  }
}

TEST(CheckSites, NamesBothOfTwoEqualSites) {
  const TestFace face = plane_square();
  try {
    check_sites(face.domain(), {{0.5, 0}, {0, 0.5}, {-0.5, 0}, {1e-9, 0.5}, {0.5, 1e-9}}, 1e-7);
    FAIL() << "no error";
  } catch (const SiteError& e) {
    EXPECT_EQ(e.site(), 0);
    EXPECT_EQ(e.other(), 4);
  }
}

TEST(CheckSites, FindsEqualSitesOnBothSidesOfASeam) {
  const TestFace face = TestFace(std::make_shared<Cylinder>(Frame{}, 1.0)).ring({{0, 2 * kPi}, {0, 3}});
  EXPECT_THROW(check_sites(face.domain(), {{0, 1}, {2 * kPi, 1}}, 1e-7), SiteError);
}

TEST(CheckSites, TakesSitesOnTheBorder) {
  const TestFace face = plane_square();
  EXPECT_NO_THROW(check_sites(face.domain(), {{1, 0}, {-1, -1}, {0, 1 + 1e-9}}, 1e-7));
}

TEST(CheckSites, RejectsNumbersThatAreNotFinite) {
  const TestFace face = plane_square();
  EXPECT_THROW(check_sites(face.domain(), {{std::numeric_limits<double>::quiet_NaN(), 0}}, 1e-7), SiteError);
}

// On a plane x = const all sites tie along x; of 100,000 the two faulty pairs are told apart, in time.
TEST(CheckSites, FindsTheFirstEqualPairOfAHundredThousand) {
  const TestFace face =
      TestFace(std::make_shared<Plane>(Frame{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}})).rectangle(kSquare);
  Uniform random(11);
  std::vector<Uv> sites;
  for (int i = 0; i < 100000; ++i) sites.push_back(random.in(kSquare));
  const FaceDomain domain = face.domain();
  EXPECT_NO_THROW(check_sites(domain, sites, 1e-9));
  sites[70000] = sites[500];
  sites[99999] = sites[20];
  sites[99998] = sites[20];
  try {
    check_sites(domain, sites, 1e-9);
    FAIL() << "no error";
  } catch (const SiteError& e) {
    EXPECT_EQ(e.site(), 20);
    EXPECT_EQ(e.other(), 99998);
  }
}

// A chain of sites each too near to the next: the one that is kept is not always the last.
TEST(CheckSites, FindsTheFirstPairOfAChain) {
  const TestFace face = plane_square();
  try {
    check_sites(face.domain(), {{0.3, 0}, {0.0, 0}, {0.2e-7, 0}, {-0.9e-7, 0}, {0.3, 1e-6}}, 1e-7);
    FAIL() << "no error";
  } catch (const SiteError& e) {
    EXPECT_EQ(e.site(), 1);
    EXPECT_EQ(e.other(), 2);
  }
}

}  // namespace
}  // namespace geovor::testing
