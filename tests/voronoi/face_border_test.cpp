// The border as it is, not as the polyline that stands for it. Expected values are closed forms.
#include "voronoi/face_border.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "surface/bspline_curve.h"
#include "surface/elementary_curves.h"
#include "test_faces.h"
#include "voronoi/diagram_builder.h"

namespace geovor::testing {
namespace {

constexpr Uv kCentre = {0.15, -0.2};
constexpr double kRadius = 0.35;

Curve2Ptr circle(Uv c, double r) { return std::make_shared<Circle<2>>(ConicFrame<2>{{c.u, c.v}, {1, 0}, {0, 1}}, r); }

/// A loop of one closed curve; a hole runs clockwise.
void add_ring(TestFace& face, Curve2Ptr curve, Interval range, bool hole) {
  const int edge = face.edge();
  face.model.faces[0].loops.push_back({{{edge, std::move(curve), range, hole}}});
}

TestFace square_with_circular_hole() {
  TestFace face = plane_square();
  add_ring(face, circle(kCentre, kRadius), {0.0, 2.0 * kPi}, true);
  return face;
}

double off_circle(const Xyz& x) { return std::hypot(x.x() - kCentre.u, x.y() - kCentre.v) - kRadius; }

TEST(FaceBorder, PlacesLieOnTheTrueCircleAndTheDirectionIsTheirDerivative) {
  const TestFace face = square_with_circular_hole();
  const FaceDomain domain = face.domain();
  const FaceBorder border(domain);
  ASSERT_EQ(border.cycle_count(), 2);
  Uniform random(5);
  for (int i = 0; i < 1000; ++i) {
    const double at = random() * border.segment_count(1);
    ASSERT_LT(std::abs(off_circle(border.xyz({1, at}))), 1e-15);
    const double h = 1e-3;
    if (std::floor(at - h) != std::floor(at + h) || at < h) continue;
    const Uv a = border.uv({1, at - h}), b = border.uv({1, at + h});
    const UvVec d = border.direction({1, at});
    ASSERT_NEAR(d.u, (b.u - a.u) / (2 * h), 1e-10);
    ASSERT_NEAR(d.v, (b.v - a.v) / (2 * h), 1e-10);
    // The face is to the left: the centre of the hole to the right.
    ASSERT_LT(cross(d, kCentre - border.uv({1, at})), 0.0);
  }
  for (Uv p : border.stretch({1, 0.3}, {1, 0.2})) EXPECT_LT(std::abs(off_circle(border.xyz_of(p))), 1e-15);
}

TEST(FaceBorder, AChordMeetsTheTrueCircle) {
  const TestFace face = square_with_circular_hole();
  const FaceDomain domain = face.domain();
  const FaceBorder border(domain);
  Uniform random(6);
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    const Uv a = random.in(kSquare), b = random.in(kSquare);
    const double r = std::hypot(a.u - kCentre.u, a.v - kCentre.v);
    const auto crossing = border.first_crossing(a, b, 0.0);
    // |a + k (b - a) - c| = r: the smaller root, or the larger one from inside the hole.
    const UvVec d = b - a, w = a - kCentre;
    const double dd = d.u * d.u + d.v * d.v, dw = d.u * w.u + d.v * w.v, ww = w.u * w.u + w.v * w.v;
    const double root2 = dw * dw - dd * (ww - kRadius * kRadius);
    if (std::abs(root2) < 1e-3 || std::abs(r - kRadius) < 1e-5) continue;  // grazes the circle
    double k = root2 > 0.0 ? (-dw + (r < kRadius ? 1 : -1) * std::sqrt(root2)) / dd : -1.0;
    if (!(k > 0.0 && k < 1.0)) {
      ASSERT_FALSE(crossing) << i;
      continue;
    }
    if (std::abs(k - 1.0) < 1e-5) continue;
    ++met;
    ASSERT_TRUE(crossing) << i;
    EXPECT_NEAR(crossing->fraction, k, 1e-14 / std::sqrt(root2));
    EXPECT_LT((border.xyz(crossing->place) - Xyz(a.u + k * d.u, a.v + k * d.v, 0)).norm(), 1e-12);
  }
  EXPECT_GT(met, 300);
}

// From a place on the border inwards: the circle bulges beyond its polyline there, which is no crossing.
TEST(FaceBorder, AChordThatStartsOnTheTrueBorderDoesNotMeetItThere) {
  const TestFace face = square_with_circular_hole();
  const FaceDomain domain = face.domain();
  const FaceBorder border(domain);
  TestFace disk(std::make_shared<Plane>(Frame{}));
  add_ring(disk, circle(kCentre, kRadius), {0.0, 2.0 * kPi}, false);
  const FaceDomain disk_domain = disk.domain();
  const FaceBorder rim(disk_domain);
  constexpr double kStart = 1e-3;
  for (int i = 0; i < 500; ++i) {
    const double t = 0.01 + 2 * kPi * i / 500;
    const UvVec out = {std::cos(t), std::sin(t)};
    const Uv on = kCentre + kRadius * out;
    for (const double way : {1e-5, 1e-3, 1e-1}) {
      EXPECT_FALSE(border.first_crossing(on, on + way * out, kStart));
      EXPECT_FALSE(rim.first_crossing(on, on + (-way) * out, kStart));
    }
    // Through the disk and out on the other side: a diameter of a chord 0.8 long.
    const auto far_side = rim.first_crossing(on, on + (-0.8) * out, kStart);
    ASSERT_TRUE(far_side);
    EXPECT_NEAR(far_side->fraction, 2 * kRadius / 0.8, 1e-13);
  }
}

TEST(FaceBorder, TheNearestPlaceIsTheFootOnTheTrueCircle) {
  const TestFace face = square_with_circular_hole();
  const FaceDomain domain = face.domain();
  const FaceBorder border(domain);
  Uniform random(7);
  for (int i = 0; i < 1000; ++i) {
    const Uv p = random.in(kSquare);
    const double r = std::hypot(p.u - kCentre.u, p.v - kCentre.v);
    const double to_side = 1.0 - std::max(std::abs(p.u), std::abs(p.v));
    const auto place = border.nearest(p);
    ASSERT_TRUE(place);
    const Uv q = border.uv(*place);
    EXPECT_NEAR(std::hypot(q.u - p.u, q.v - p.v), std::min(to_side, std::abs(r - kRadius)), 1e-9);
    if (std::abs(r - kRadius) > to_side - 1e-5) continue;
    ASSERT_EQ(place->cycle, 1);
    EXPECT_NEAR(q.u, kCentre.u + kRadius * (p.u - kCentre.u) / r, 1e-9);
    EXPECT_NEAR(q.v, kCentre.v + kRadius * (p.v - kCentre.v) / r, 1e-9);
  }
}

TEST(FaceBorder, NearBorderErrsOnTheSafeSideAndByLittle) {
  const TestFace face = square_with_circular_hole();
  const FaceDomain domain = face.domain();
  const FaceBorder border(domain);
  Uniform random(8);
  for (int i = 0; i < 1000; ++i) {
    const Uv p = random.in(kSquare);
    const double true_distance = std::min(1.0 - std::max(std::abs(p.u), std::abs(p.v)),
                                          std::abs(std::hypot(p.u - kCentre.u, p.v - kCentre.v) - kRadius));
    const Xyz x(p.u, p.v, 0.0);
    EXPECT_TRUE(border.near_border(x, true_distance * (1 + 1e-12)));
    EXPECT_FALSE(border.near_border(x, true_distance - 1e-3));
  }
  EXPECT_TRUE(border.near_border({std::numeric_limits<double>::quiet_NaN(), 0, 0}, 0.1));
}

// A cubic arch over the square's upper side: on the true border v = 1 + a (1 - u^2) exactly.
TEST(FaceBorder, PlacesLieOnASpline) {
  constexpr double kRise = 0.3;
  // v = 1 + a (1 - u^2), u = 1 - 2 t: Bernstein coefficients of degree 2 are 0, 2a, 0 over 1.
  const auto arch = std::make_shared<BSplineCurve<2>>(
      KnotVector({0.0, 1.0}, {3, 3}, 2), std::vector<Eigen::Vector2d>{{1, 1}, {0, 1 + 2 * kRise}, {-1, 1}});
  TestFace face(std::make_shared<Plane>(Frame{}));
  face.model.faces[0].loops.emplace_back();
  face.side(face.edge(), {-1, 1}, {-1, -1});
  face.side(face.edge(), {-1, -1}, {1, -1});
  face.side(face.edge(), {1, -1}, {1, 1});
  face.model.faces[0].loops[0].coedges.push_back({face.edge(), arch, {0, 1}, false});
  const FaceDomain domain = face.domain();
  const FaceBorder border(domain);
  ASSERT_EQ(border.cycle_count(), 1);
  int on_arch = 0;
  Uniform random(9);
  for (int i = 0; i < 1000; ++i) {
    const Xyz x = border.xyz({0, random() * border.segment_count(0)});
    if (!(x.y() > 1.0)) continue;
    ++on_arch;
    ASSERT_NEAR(x.y(), 1 + kRise * (1 - x.x() * x.x()), 1e-15);
  }
  EXPECT_GT(on_arch, 100);
}

TEST(FaceBorder, BisectorsEndOnTheTrueCircle) {
  const TestFace face = square_with_circular_hole();
  const FaceDomain domain = face.domain();
  const Uv p = {-0.6, 0.3}, q = {0.55, 0.62};
  const VoronoiDiagram d = build_diagram(domain, {p, q, {0.5, -0.7}, {-0.5, -0.6}});
  int on_hole = 0;
  for (const DiagramVertex& v : d.vertices) {
    if (!v.on_boundary || v.border_cycle != 1) continue;
    ++on_hole;
    EXPECT_LT(std::abs(off_circle(v.xyz)), 1e-12);
    ASSERT_EQ(v.sites.size(), 2u);
    const Uv a = d.sites[v.sites[0]].uv, b = d.sites[v.sites[1]].uv;
    const double to_a = std::hypot(v.xyz.x() - a.u, v.xyz.y() - a.v),
                 to_b = std::hypot(v.xyz.x() - b.u, v.xyz.y() - b.v);
    EXPECT_NEAR(to_a, to_b, 1e-12);
    EXPECT_NEAR(to_a, v.radius, 1e-12);
  }
  EXPECT_GE(on_hole, 3);
}

/// The median time of a call, microseconds.
template <typename Call>
double microseconds(Call&& call) {
  std::vector<double> times;
  for (int round = 0; round < 9; ++round) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 1000; ++i) call(i);
    times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() * 1e3);
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

// A microsecond is what geodesics cost; the bound leaves room for slow machines and debug builds.
TEST(FaceBorder, AChordFarFromABorderOfThousandsOfSegmentsCostsLittle) {
  TestFace face(std::make_shared<Plane>(Frame{}));
  face.rectangle({{0, 10}, {0, 10}});
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 9; ++j) add_ring(face, circle({i + 1.0, j + 1.0}, 0.3), {0.0, 2.0 * kPi}, true);
  }
  const FaceDomain domain = face.domain();
  const FaceBorder border(domain);
  int segments = 0;
  for (int c = 0; c < border.cycle_count(); ++c) segments += border.segment_count(c);
  EXPECT_GT(segments, 5000);
  std::vector<Uv> from;
  for (int i = 0; i < 1000; ++i) from.push_back({1.45 + i % 8, 1.45 + i / 8 % 8});
  int met = 0;
  const double chord = microseconds([&](int i) {
    met += border.first_crossing(from[i], from[i] + UvVec{0.07, 0.05}, 0.0) ? 1 : 0;
  });
  const double near = microseconds([&](int i) { met += border.near_border({from[i].u, from[i].v, 0}, 0.05) ? 1 : 0; });
  EXPECT_EQ(met, 0);
  RecordProperty("nanoseconds_chord", static_cast<int>(1e3 * chord));
  RecordProperty("nanoseconds_near", static_cast<int>(1e3 * near));
  EXPECT_LT(chord, 20.0);
  EXPECT_LT(near, 20.0);
}

}  // namespace
}  // namespace geovor::testing
