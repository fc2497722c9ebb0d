#include "brep/face_area.h"

#include <gtest/gtest.h>

#include <random>

#include "base/error.h"
#include "numeric/gauss_legendre.h"
#include "surface/bspline_surface.h"
#include "test_faces.h"

namespace geovor::testing {
namespace {

constexpr double kPromised = 1e-9;  // relative

void expect_area(FaceBuilder& b, double expected) {
  const Area area = face_area(b.model(), b.face());
  EXPECT_NEAR(area.value, expected, kPromised * expected);
  EXPECT_LE(area.error, kPromised * expected);
}

TEST(FaceArea, OfARectangleAndADiscInThePlane) {
  FaceBuilder rectangle(plane());
  rectangle.rectangle(-1, 2, 4, 5);
  expect_area(rectangle, 15.0);
  FaceBuilder disc(plane());
  disc.ellipse({100, -50}, 3, 3);
  expect_area(disc, 9 * kPi);
}

TEST(FaceArea, LeavesHolesOut) {
  FaceBuilder b(plane());
  b.rectangle(0, 0, 10, 10).ellipse({3, 3}, 1, 2, true).ellipse({7, 6}, 2, 1, true);
  expect_area(b, 100 - 4 * kPi);
}

TEST(FaceArea, OfSphereTorusAndCylinder) {
  FaceBuilder octant(sphere(3));
  octant.rectangle(0, 0, kPi / 2, kPi / 2);
  expect_area(octant, 4 * kPi * 9 / 8);
  FaceBuilder whole_sphere(sphere(3));
  whole_sphere.strip(0.0, -kPi / 2, kPi / 2, true, true);
  expect_area(whole_sphere, 4 * kPi * 9);
  FaceBuilder untrimmed_torus(torus(5, 2));
  expect_area(untrimmed_torus, 4 * kPi * kPi * 10);
  FaceBuilder tube(cylinder(2));
  tube.strip(1.0, -3, 4);
  expect_area(tube, 4 * kPi * 7);
  // A trapezium on the developed cylinder.
  FaceBuilder patch(cylinder(2));
  patch.polygon({{6, 0}, {8, 0}, {8, 3}, {6, 1}});
  expect_area(patch, 2 * 2 * 2.0);
}

TEST(FaceArea, OfATrimmedParaboloidIsTheClosedForm) {
  // z = a r^2 inside r = R: pi / (6 a^2) ((1 + 4 a^2 R^2)^(3/2) - 1).
  const double a = 0.7;
  const auto cap = [a](double R) { return kPi / (6 * a * a) * (std::pow(1 + 4 * a * a * R * R, 1.5) - 1); };
  FaceBuilder disc(paraboloid(a));
  disc.ellipse({0, 0}, 2, 2);
  expect_area(disc, cap(2));
  FaceBuilder ring(paraboloid(a));
  ring.ellipse({0, 0}, 2, 2).ellipse({0, 0}, 0.5, 0.5, true);
  expect_area(ring, cap(2) - cap(0.5));
}

TEST(FaceArea, OfAFoldedParameterizationCountsBothSides) {
  // x = u, y = (v - c)^2 with the fold c = 0.3 + 0.4 u: W = 2 |v - c|, so the integral over v in [0, 1] is
  // c^2 + (1 - c)^2.
  FaceBuilder b(std::make_shared<FunctionSurface>(UvBox{{0, 1}, {0, 1}}, [](Uv p) {
    const double d = p.v - 0.3 - 0.4 * p.u;
    return SurfaceJet{{p.u, d * d, 0}, {1, -0.8 * d, 0}, {0, 2 * d, 0}, Xyz::Zero(), Xyz::Zero(), Xyz::Zero()};
  }));
  b.rectangle(0, 0, 1, 1);
  const auto cubes = [](double c) { return (c * c * c - (1 - c) * (1 - c) * (1 - c)) / 3; };
  expect_area(b, (cubes(0.7) - cubes(0.3)) / 0.4);
}

TEST(FaceArea, IsBlindToTheStartOfTheLoopAndToWholePeriods) {
  std::vector<Uv> corners{{5.5, 0.2}, {7.5, -0.4}, {8.0, 0.9}, {6.2, 1.2}};
  FaceBuilder first(sphere(1));
  first.polygon(corners);
  const double area = face_area(first.model(), first.face()).value;
  for (int turn = 1; turn < 4; ++turn) {
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    std::vector<Uv> shifted = corners;
    for (Uv& c : shifted) c.u += 2 * kPi * turn;
    FaceBuilder b(sphere(1));
    b.polygon(shifted);
    EXPECT_NEAR(face_area(b.model(), b.face()).value, area, 1e-12);
  }
}

TEST(FaceArea, ClosesTheGapsThatTheCadLeaves) {
  // Ends that miss each other by 1e-6 may cost an area of that order, wherever A is counted from; an open loop would
  // cost as much as the gap times the width.
  FaceBuilder b(plane());
  b.loop();
  const double gap = 1e-6;
  b.add(b.edge(), std::make_shared<Segment>(Uv{0, 0}, Uv{1e5, 0}));
  b.add(b.edge(), std::make_shared<Segment>(Uv{1e5, gap}, Uv{1e5, 1}));
  b.add(b.edge(), std::make_shared<Segment>(Uv{1e5, 1}, Uv{0, 1}));
  b.add(b.edge(), std::make_shared<Segment>(Uv{0, 1}, Uv{0, 0}));
  EXPECT_NEAR(face_area(b.model(), b.face()).value, 1e5, 1e-6);
}

/// A hilly bicubic spline with n by n poles over the unit square.
SurfacePtr hills(int n) {
  std::vector<double> knots;
  std::vector<int> multiplicities;
  for (int i = 0; i <= n - 3; ++i) {
    knots.push_back(static_cast<double>(i) / (n - 3));
    multiplicities.push_back(i == 0 || i == n - 3 ? 4 : 1);
  }
  const KnotVector vector(knots, multiplicities, 3);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> height(0.0, 1.0 / n);
  std::vector<Xyz> poles;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) poles.push_back({i / (n - 1.0), j / (n - 1.0), height(random)});
  }
  return std::make_shared<BSplineSurface>(vector, vector, poles);
}

/// The second method: a product rule on every span of the whole surface.
double product_rule(const Surface& s, int spans, int order) {
  double sum = 0.0;
  for (int i = 0; i < spans; ++i) {
    for (int j = 0; j < spans; ++j) {
      const Interval u{static_cast<double>(i) / spans, (i + 1.0) / spans};
      const Interval v{static_cast<double>(j) / spans, (j + 1.0) / spans};
      sum += integrate(
          [&](double x) {
            return integrate(
                [&](double y) {
                  const SurfaceJet jet = s.jet({x, y});
                  const double E = jet.Su.dot(jet.Su), F = jet.Su.dot(jet.Sv), G = jet.Sv.dot(jet.Sv);
                  return std::sqrt(E * G - F * F);
                },
                v, order);
          },
          u, order);
    }
  }
  return sum;
}

TEST(FaceArea, AgreesWithAProductRuleOnASpline) {
  const SurfacePtr s = hills(12);
  FaceBuilder b(s);
  b.rectangle(0, 0, 1, 1);
  expect_area(b, product_rule(*s, 9, 16));
}

TEST(FaceArea, OfAFaceIsTheSumOfItsParts) {
  const SurfacePtr s = hills(12);
  FaceBuilder holed(s);
  holed.rectangle(0, 0, 1, 1).ellipse({0.45, 0.55}, 0.31, 0.22, true);
  FaceBuilder disc(s);
  disc.ellipse({0.45, 0.55}, 0.31, 0.22);
  const Area outside = face_area(holed.model(), holed.face()), inside = face_area(disc.model(), disc.face());
  EXPECT_NEAR(outside.value + inside.value, product_rule(*s, 9, 16), 2 * kPromised);
  EXPECT_LE(outside.error + inside.error, 2 * kPromised);
}

TEST(FaceArea, OfAHundredByHundredPolesIsStillExact) {
  const SurfacePtr s = hills(100);
  FaceBuilder b(s);
  // A hole, filled again: as much border as a face with a hole, and the area is that of the whole.
  b.rectangle(0, 0, 1, 1).ellipse({0.45, 0.55}, 0.31, 0.22, true).ellipse({0.45, 0.55}, 0.31, 0.22);
  const Area area = face_area(b.model(), b.face());
  const double expected = product_rule(*s, 97, 8);
  EXPECT_NEAR(area.value, expected, 1e-8 * expected);
}

TEST(FaceArea, SaysWhatIsWrongWithABrokenFace) {
  FaceBuilder no_surface(nullptr);
  EXPECT_THROW(face_area(no_surface.model(), no_surface.face()), Error);
  FaceBuilder no_pcurve(plane());
  no_pcurve.loop();
  no_pcurve.face().loops[0].coedges.push_back({0, nullptr, {0, 1}, false});
  EXPECT_THROW(face_area(no_pcurve.model(), no_pcurve.face()), Error);
  FaceBuilder not_finite(plane());
  not_finite.polygon({{0, 0}, {1, std::nan("")}, {1, 1}});
  EXPECT_THROW(face_area(not_finite.model(), not_finite.face()), Error);
}

}  // namespace
}  // namespace geovor::testing
