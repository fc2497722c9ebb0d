// Distances on faces against closed forms, and the curves that stand for their paths.
#include "pipeline/distance_face.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "pipeline/path_spline.h"
#include "surface/bspline_curve.h"
#include "surface/bspline_surface.h"
#include "voronoi/test_faces.h"

namespace geovor {
namespace {

using namespace testing;

SurfacePtr cylinder(double radius) { return std::make_shared<Cylinder>(Frame{}, radius); }

FaceDistance measure(const TestFace& face, Uv a, Uv b) {
  const FaceDistances distances(face.model, face.model.faces[0]);
  return distances.between(distances.place(a, false), distances.place(b, false));
}

/// The spline of the first path, and its own evaluation.
struct Curve {
  CadCurve cad;
  BSplineCurve<3> spline;
  explicit Curve(const CadCurve& c) : cad(c), spline(KnotVector(c.knots, c.multiplicities, c.degree), c.poles) {}

  /// By Simpson's rule on every piece.
  double length() const {
    double sum = 0.0;
    for (size_t i = 0; i + 1 < cad.knots.size(); ++i) {
      constexpr int kSteps = 8;
      const double h = (cad.knots[i + 1] - cad.knots[i]) / kSteps;
      const auto speed = [&](int k) {
        const double t = cad.knots[i] + h * k;
        return spline.jet(t, spline.piece(t, k == 0 ? 1.0 : -1.0)).d1.norm();
      };
      for (int k = 0; k < kSteps; k += 2) sum += h / 3.0 * (speed(k) + 4.0 * speed(k + 1) + speed(k + 2));
    }
    return sum;
  }
};

Curve curve_of(const TestFace& face, Uv a, Uv b) {
  const FaceDistances distances(face.model, face.model.faces[0]);
  const FaceDistance d = distances.between(distances.place(a, false), distances.place(b, false));
  EXPECT_EQ(d.paths.size(), 1u);
  return Curve(distances.spline(d.paths.front(), "path"));
}

TEST(DistanceOnFace, TellsTheWayThatStaysWhereTheShortestPathRunsThroughAGap) {
  // A wall of 270 degrees: the short way between its ends is through the gap.
  const TestFace wall = TestFace(cylinder(10.0)).rectangle({{0.0, 1.5 * kPi}, {0.0, 20.0}});
  const FaceDistance d = measure(wall, {0.25, 5.0}, {1.5 * kPi - 0.25, 5.0});
  EXPECT_NEAR(d.length(), 10.0 * (0.5 * kPi + 0.5), 1e-12);
  EXPECT_TRUE(d.leaves_face());
  ASSERT_TRUE(d.paths[0].exit);
  EXPECT_NEAR(d.paths[0].exit->out.s, 2.5, 1e-6);
  ASSERT_TRUE(d.paths[0].exit->back);
  EXPECT_NEAR(d.paths[0].exit->back->s, d.length() - 2.5, 1e-6);
  ASSERT_TRUE(d.stays_on_face);
  EXPECT_NEAR(*d.stays_on_face, 10.0 * (1.5 * kPi - 0.5), 1e-12);
}

TEST(DistanceOnFace, PathsEndWhereTheyWereSentThoughTheirNeighboursSpread) {
  // Through the hole of a torus, y at the end ten times the length. In the mirror x -> -x a path is its own return.
  const TestFace torus = whole(std::make_shared<Torus>(Frame{}, 20.0, 6.0));
  const FaceDistance d = measure(torus, {0.0, 0.0}, {kPi, 0.0});
  EXPECT_EQ(d.paths.size(), 4u);
  for (const FacePath& path : d.paths) {
    EXPECT_GT(path.connection.y, 5.0 * d.length());
    EXPECT_LT((path.points.back().xyz - Xyz(-26.0, 0.0, 0.0)).norm(), 2e-12);
    const Xyz start = path.points.front().tangent;
    EXPECT_LT((path.end_tangent - Xyz(start.x(), -start.y(), -start.z())).norm(), 2e-13);
  }
}

TEST(DistanceOnFace, StartsAtTheTipOfACone) {
  // Half-angle 45 degrees, tip at z = -10: from the tip the path is a straight line in space.
  const SurfacePtr cone = std::make_shared<Cone>(Frame{}, 10.0, 0.25 * kPi);
  const TestFace face = TestFace(cone).ring({{0.0, 2.0 * kPi}, {-10.0 * std::sqrt(2.0), 5.0}});
  const FaceDistance d = measure(face, {0.0, -10.0 * std::sqrt(2.0)}, {0.5 * kPi, 0.0});
  EXPECT_NEAR(d.length(), 10.0 * std::sqrt(2.0), 1e-13);
  ASSERT_EQ(d.paths.size(), 1u);
  EXPECT_LT((d.paths[0].points.back().xyz - Xyz(0.0, 10.0, 0.0)).norm(), 1e-13);
  EXPECT_LT((d.paths[0].end_tangent - Xyz(0.0, std::sqrt(0.5), std::sqrt(0.5))).norm(), 1e-14);
}

TEST(DistanceOnFace, StartsAtThePoleOfASphereUnderOtherParameters) {
  // No closed form is known of it: the path leaves the pole in the pole's chart.
  const SurfacePtr sphere = std::make_shared<Ellipsoid>(5.0, 5.0, 5.0);
  const TestFace face = whole(sphere);
  for (const double u : {0.0, 1.0, 4.0}) {
    const FaceDistance d = measure(face, {0.3, 0.5 * kPi}, {u, 0.2});
    EXPECT_NEAR(d.length(), 5.0 * (0.5 * kPi - 0.2), 1e-12);
    ASSERT_EQ(d.paths.size(), 1u);
    EXPECT_LT((d.paths[0].points.back().xyz - sphere->position({u, 0.2})).norm(), 1e-11);
    const Xyz south(-std::sin(0.2) * std::cos(u), -std::sin(0.2) * std::sin(u), std::cos(0.2));
    EXPECT_LT((d.paths[0].end_tangent + south).norm(), 1e-11);
  }
}

TEST(DistanceOnFace, IsSettledWhereOneOfTwoShortestPathsStays) {
  // The two half circles are equally long; one runs through the window.
  TestFace tube = TestFace(cylinder(10.0)).ring({{0.0, 2.0 * kPi}, {0.0, 20.0}});
  tube.polygon({{1.0, 8.0}, {1.0, 12.0}, {2.0, 12.0}, {2.0, 8.0}});
  const FaceDistance d = measure(tube, {0.0, 10.0}, {kPi, 10.0});
  ASSERT_EQ(d.paths.size(), 2u);
  EXPECT_NE(d.paths[0].exit.has_value(), d.paths[1].exit.has_value());
  EXPECT_FALSE(d.leaves_face());
  EXPECT_TRUE(d.warnings.empty());
}

TEST(DistanceOnFace, DoesNotLeaveAFaceAlongAnEdgeOrAtItsEnds) {
  const TestFace square = plane_square();
  for (const auto& [a, b] : {std::pair{Uv{-1, -1}, Uv{1, -1}}, {Uv{-1, 0.3}, Uv{1, -0.2}}, {Uv{-1, -1}, Uv{1, 1}}}) {
    const FaceDistance d = measure(square, a, b);
    EXPECT_FALSE(d.leaves_face());
    EXPECT_NEAR(d.length(), std::hypot(b.u - a.u, b.v - a.v), 1e-15);
  }
}

TEST(DistanceOnFace, RefusesPointsThatAreOffTheFaceInAClause) {
  const TestFace square = plane_square();
  const FaceDistances distances(square.model, square.model.faces[0]);
  const auto refusal = [&](const FacePoint& p) -> std::string {
    try {
      distances.place(p, false);
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ErrorCode::Usage);
      return e.what();
    }
    return "";
  };
  EXPECT_NE(refusal(Uv{1.5, 0.0}).find("outside the border"), std::string::npos);
  EXPECT_NE(refusal(Xyz(0.0, 0.0, 0.25)).find("off the face by 0.25"), std::string::npos);
  EXPECT_NE(refusal(Uv{std::nan(""), 0.0}).find("no finite point"), std::string::npos);
  EXPECT_NE(refusal(Xyz(0.0, std::nan(""), 0.0)).find("no finite point"), std::string::npos);
  EXPECT_EQ(refusal(Uv{1.0 + 1e-9, 0.0}), "");
}

TEST(DistanceOnFace, SnapsAPointOutsideToTheNearestPlaceOfTheBorder) {
  const TestFace square = plane_square();
  const FaceDistances distances(square.model, square.model.faces[0]);
  const FacePlace beside = distances.place(Xyz(3.0, 0.25, 0.0), true);
  EXPECT_NEAR((beside.xyz - Xyz(1.0, 0.25, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(beside.moved, 2.0, 1e-12);
  const FacePlace corner = distances.place(Uv{2.0, 2.0}, true);
  EXPECT_NEAR(corner.moved, std::sqrt(2.0), 1e-9);
}

TEST(PathSpline, IsAGreatCircleOnTheSphere) {
  const Curve c = curve_of(whole(std::make_shared<Sphere>(Frame{}, 10.0)), {0.3, -0.4}, {2.5, 0.9});
  const Xyz p = c.spline.position(0.0), q = c.spline.position(c.cad.knots.back());
  const Xyz across = p.cross(q).normalized();
  const double length = 20.0 * std::asin((q - p).norm() / 20.0);
  EXPECT_NEAR(c.cad.knots.back(), length, 1e-13 * length);
  for (int i = 0; i <= 1000; ++i) {
    const Xyz x = c.spline.position(length * i / 1000);
    EXPECT_NEAR(x.norm(), 10.0, 1e-9);
    EXPECT_NEAR(x.dot(across), 0.0, 1e-9);
    // The parameter is the arc length.
    EXPECT_NEAR(std::atan2(x.dot(across.cross(p) / 10.0), x.dot(p) / 10.0) * 10.0, length * i / 1000, 1e-9);
  }
  EXPECT_NEAR(c.length(), length, 1e-9 * length);
}

TEST(PathSpline, LiesOnAWaveAndIsAsLongAsThePath) {
  // The surface of the graph of sin u cos v; in space x = u and y = v.
  const UvBox box{{-3, 3}, {-3, 3}};
  const Curve c = curve_of(TestFace(std::make_shared<WaveSurface>(box)).rectangle(box), {-2, -1}, {2, 1.5});
  const double length = c.cad.knots.back();
  for (int i = 0; i <= 1000; ++i) {
    const Xyz x = c.spline.position(length * i / 1000);
    EXPECT_NEAR(x.z(), std::sin(x.x()) * std::cos(x.y()), 1e-9);
  }
  EXPECT_NEAR(c.length(), length, 1e-9 * length);
}

// The length is a part of 1e-11 of the coordinates: what is asked of the polyline and the curve lies below rounding.
TEST(PathSpline, OfAShortPathFarFromTheOriginEndsAtRounding) {
  Frame far;
  far.origin = Xyz(1e4, -2e4, 3e4);
  const TestFace torus = whole(std::make_shared<Torus>(far, 5.0, 2.0));
  const FaceDistances distances(torus.model, torus.model.faces[0]);
  const FaceDistance d =
      distances.between(distances.place(Uv{1.0, 1.0}, false), distances.place(Uv{1.0 + 1e-7, 1.0 + 1e-7}, false));
  ASSERT_EQ(d.paths.size(), 1u);
  EXPECT_LT(d.paths[0].points.size(), 100u);
  EXPECT_LT(distances.spline(d.paths[0], "short").knots.size(), 100u);
}

/// Two rectangles that meet at a right angle along the y axis: x from -2 to 0 on the floor, then up the wall.
SurfacePtr corner_of_a_room() {
  std::vector<Xyz> poles;
  for (const Xyz& p : {Xyz(-2, 0, 0), Xyz(0, 0, 0), Xyz(0, 0, 2)}) {
    for (const double y : {0.0, 4.0}) poles.push_back(p + Xyz(0, y, 0));
  }
  return std::make_shared<BSplineSurface>(KnotVector({0, 2, 4}, {2, 1, 2}, 1), KnotVector({0, 4}, {2, 2}, 1), poles);
}

TEST(PathSpline, HasACornerWhereThePathCrossesACrease) {
  const TestFace room = whole(corner_of_a_room());
  const Curve c = curve_of(room, {0.5, 0.5}, {3.0, 3.0});
  // Unfolded, the path is straight: 2.5 across, 2.5 along; it meets the crease 1.5 from its start's wall.
  EXPECT_NEAR(c.cad.knots.back(), std::hypot(2.5, 2.5), 1e-12);
  const double s = 1.5 * std::sqrt(2.0);
  const auto knot = std::min_element(c.cad.knots.begin(), c.cad.knots.end(),
                                     [s](double a, double b) { return std::abs(a - s) < std::abs(b - s); });
  EXPECT_NEAR(*knot, s, 1e-10);
  EXPECT_EQ(c.cad.multiplicities[knot - c.cad.knots.begin()], 5);
  EXPECT_NEAR((c.spline.position(*knot) - Xyz(0.0, 2.0, 0.0)).norm(), 0.0, 1e-10);
  EXPECT_NEAR(c.length(), std::hypot(2.5, 2.5), 1e-11);
}

}  // namespace
}  // namespace geovor
