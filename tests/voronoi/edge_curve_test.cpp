// Edges as curves: points between the stored ones against connect() and closed forms.
#include "voronoi/edge_curve.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "edge_patches.h"
#include "geodesic/connect.h"
#include "support/splines.h"
#include "surface/forms.h"
#include "test_faces.h"

namespace geovor::testing {
namespace {

constexpr double kEquidistance = 1e-12;

EdgePoint stored(const BisectorPoint& m) {
  const BisectorSlope d = bisector_slope(m);
  return {m.left.uv, m.position(), m.radius(), m.left.polar.t, m.right.polar.t, d.radius, d.left_angle, d.right_angle};
}

/// A stretch of the bisector of sites 0 (left) and 1 from near `place` on, in `pieces` steps of length h.
DiagramEdge stretch(const SiteRays& rays, Uv place, double h, int pieces) {
  DiagramEdge edge;
  edge.left = 0;
  edge.right = 1;
  const auto p = rays.to(0, place), q = rays.to(1, place);
  BisectorPoint m{*p, *q};
  for (int i = 0; i <= pieces; ++i) {
    const Xyz t = m.tangent();
    const double step = i == 0 ? 0.0 : h;
    const auto next = correct_bisector(rays, 0, 1, coordinates(m), {t, t.dot(m.position()) + step}, 0.1);
    if (!next) break;
    m = *next;
    edge.points.push_back(stored(m));
  }
  return edge;
}

double anew(const SiteRays& rays, int site, Uv m, Polar guess) {
  ConnectOptions options;
  options.tolerance = 1e-14;
  const Connection c = connect(rays.surface(), rays.site(site), m, guess, options);
  EXPECT_EQ(c.status, ConnectStatus::Converged);
  return c.length;
}

void expect_equidistant(const SiteRays& rays, const DiagramEdge& edge, const EdgePoint& m, const std::string& where) {
  const double left = anew(rays, edge.left, m.uv, {m.radius, m.left_angle}),
               right = anew(rays, edge.right, m.uv, {m.radius, m.right_angle});
  EXPECT_NEAR(left, m.radius, kEquidistance * m.radius) << where;
  EXPECT_NEAR(right, m.radius, kEquidistance * m.radius) << where;
  EXPECT_LE((rays.surface().position(m.uv) - m.xyz).norm(), kEquidistance * m.radius) << where;
}

double distance_to(const std::vector<EdgePoint>& line, const Xyz& x) {
  double least = 1e300;
  for (size_t i = 1; i < line.size(); ++i) {
    const Xyz &a = line[i - 1].xyz, way = line[i].xyz - a;
    const double k = std::clamp(way.dot(x - a) / way.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (x - a - k * way).norm());
  }
  return least;
}

TEST(EdgeCurve, IsEquallyFarFromBothSitesAnywhere) {
  Uniform random(3);
  for (const Patch& patch : patches()) {
    const std::vector<Uv> sites = {patch.p, patch.q};
    const SiteRays rays(*patch.surface, sites);
    const DiagramEdge edge = stretch(rays, lerp(patch.p, patch.q, 0.5), 0.15, 5);
    ASSERT_EQ(edge.points.size(), 6u) << patch.name;
    const EdgeCurve curve(rays, edge);
    for (int i = 0; i < 30; ++i) {
      const auto m = curve.at(random());
      ASSERT_TRUE(m) << patch.name;
      expect_equidistant(rays, edge, *m, patch.name);
    }
  }
}

TEST(EdgeCurve, PolylineStaysWithinItsTolerance) {
  for (const Patch& patch : patches()) {
    const std::vector<Uv> sites = {patch.p, patch.q};
    const SiteRays rays(*patch.surface, sites);
    const DiagramEdge edge = stretch(rays, lerp(patch.p, patch.q, 0.5), 0.15, 5);
    const EdgeCurve curve(rays, edge);
    for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
      const auto line = curve.polyline(tolerance);
      EXPECT_EQ(line.front().xyz, edge.points.front().xyz);
      EXPECT_EQ(line.back().xyz, edge.points.back().xyz);
      for (int i = 1; i < 100; ++i) EXPECT_LE(distance_to(line, curve.at(0.01 * i)->xyz), tolerance) << patch.name;
      EXPECT_LT(line.size(), 1000u);
    }
  }
}

TEST(EdgeCurve, IsTheGreatCircleBetweenTwoSitesOfASphere) {
  const Sphere sphere(Frame{}, 2.0);
  const std::vector<Uv> sites = {{0.2, 0.1}, {1.1, -0.4}};
  const SiteRays rays(sphere, sites);
  const DiagramEdge edge = stretch(rays, lerp(sites[0], sites[1], 0.5), 0.25, 8);
  const EdgeCurve curve(rays, edge);
  const Xyz pole = (sphere.position(sites[1]) - sphere.position(sites[0])).normalized();
  for (int i = 0; i <= 20; ++i) EXPECT_NEAR(curve.at(0.05 * i)->xyz.dot(pole), 0.0, 1e-13);
  const Xyz a = edge.points.front().xyz, b = edge.points.back().xyz;
  const double arc = 2.0 * std::atan2(a.cross(b).norm(), a.dot(b));
  EXPECT_NEAR(curve.length(), arc, kLengthError * arc);
}

TEST(EdgeCurve, LengthOfAPlaneEdgeIsThatOfTheSegment) {
  const Plane plane(Frame{});
  const std::vector<Uv> sites = {{0, 0}, {0.3, 0.4}};
  const SiteRays rays(plane, sites);
  const DiagramEdge edge = stretch(rays, {0.2, 0.1}, 0.5, 3);
  EXPECT_NEAR(EdgeCurve(rays, edge).length(), (edge.points.back().xyz - edge.points.front().xyz).norm(), 1e-13);
}

// The limit of inscribed polylines, extrapolated: their error falls by four with each halving.
TEST(EdgeCurve, LengthIsTheLimitOfChordsOnAWave) {
  const WaveSurface wave({{-9, 9}, {-9, 9}});
  const std::vector<Uv> sites = {{0.1, 0.2}, {0.9, 0.5}};
  const SiteRays rays(wave, sites);
  const DiagramEdge edge = stretch(rays, lerp(sites[0], sites[1], 0.5), 0.2, 4);
  const EdgeCurve curve(rays, edge);
  const auto chords = [&](int pieces) {
    double sum = 0.0;
    for (size_t i = 1; i < edge.points.size(); ++i) {
      DiagramEdge piece = edge;
      piece.points = {edge.points[i - 1], edge.points[i]};
      const EdgeCurve one(rays, piece);
      for (int k = 1; k <= pieces; ++k) {
        sum += (one.at(1.0 * k / pieces)->xyz - one.at((k - 1.0) / pieces)->xyz).norm();
      }
    }
    return sum;
  };
  const double a = chords(8), b = chords(16), c = chords(32);
  const double ab = b + (b - a) / 3.0, bc = c + (c - b) / 3.0;
  EXPECT_NEAR(curve.length(), bc + (bc - ab) / 15.0, kLengthError * c);
}

/// The cut locus of (1.2, 0) behind the bump of E1, which by symmetry lies on the axis, from near its corner to its
/// free end.
struct BehindABump {
  GaussianBumps bump{{{{0.0, 0.0}, 3.0, 0.3}}, {{-4, 4}, {-4, 4}}};
  std::vector<Uv> sites = {{1.2, 0.0}};
  SiteRays rays{bump, sites};

  /// Where the ray at this angle to the axis meets it again behind the top.
  BisectorPoint on_axis(double angle) const {
    double s = 1.0;
    while (rays.at(0, {s, kPi - angle})->x.y() > 0.0) s += 0.01;
    for (int i = 0; i < 8; ++i) {
      const auto ray = rays.at(0, {s, kPi - angle});
      s -= ray->x.y() / ray->T.y();
    }
    return {*rays.at(0, {s, kPi + angle}), *rays.at(0, {s, kPi - angle})};
  }
};

TEST(EdgeCurve, FollowsACutLocusAlongItsAxis) {
  const BehindABump e1;
  DiagramEdge edge;
  edge.left = edge.right = 0;
  edge.kind = EdgeKind::CutLocus;
  for (const double angle : {0.4, 0.33, 0.27, 0.22, 0.18, 0.14, 0.11, 0.08, 0.06, 0.045, 0.03, 0.02, 0.012}) {
    BisectorPoint m = e1.on_axis(angle);
    if (!(m.tangent().x() > 0.0)) std::swap(m.left, m.right);
    edge.points.push_back(stored(m));
  }
  const EdgeCurve curve(e1.rays, edge);
  Uniform random(5);
  for (int i = 0; i < 40; ++i) {
    const double x = random();
    const auto m = curve.at(x);
    ASSERT_TRUE(m) << x;
    EXPECT_NEAR(m->xyz.y(), 0.0, 1e-12);
    EXPECT_NEAR(wrap_angle(m->left_angle + m->right_angle), 0.0, 1e-9);  // the mirror image of each other
    expect_equidistant(e1.rays, edge, *m, "cut locus");
  }
}

TEST(EdgeCurve, GoesOnTowardsTheFreeEndOfACutLocus) {
  const BehindABump e1;
  BisectorPoint from = e1.on_axis(0.02);
  if (!(from.tangent().x() > 0.0)) std::swap(from.left, from.right);
  DiagramEdge edge;
  edge.left = edge.right = 0;
  edge.kind = EdgeKind::CutLocus;
  edge.points.push_back(stored(from));
  // The limit of the points on the axis: u = u0 + c angle^2 + ..., extrapolated from two angles.
  const BisectorPoint a = e1.on_axis(2e-3), b = e1.on_axis(1e-3);
  EdgePoint end = stored(b);
  end.xyz = b.position() + (b.position() - a.position()) / 3.0;
  end.uv = {end.xyz.x(), 0.0};
  end.radius = b.radius() + (b.radius() - a.radius()) / 3.0;
  end.left_angle = end.right_angle = kPi;
  end.radius_slope = -1.0;
  end.left_slope = end.right_slope = 0.0;
  edge.points.push_back(end);
  const EdgeCurve curve(e1.rays, edge);
  for (const double x : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    const auto m = curve.at(x);
    ASSERT_TRUE(m) << x;
    EXPECT_NEAR(m->xyz.y(), 0.0, 1e-12) << x;
    expect_equidistant(e1.rays, edge, *m, "near the free end");
  }
  EXPECT_GT(curve.length(), 0.0);
  EXPECT_FALSE(curve.polyline(1e-6).empty());
}

TEST(EdgeCurve, ClosesWhereItStarted) {
  // The equator, between two sites next to the poles.
  const Sphere sphere(Frame{}, 1.0);
  const std::vector<Uv> sites = {{0.0, 0.5 * kPi - 1e-9}, {0.0, -0.5 * kPi + 1e-9}};  // next to the poles
  const SiteRays rays(sphere, sites);
  DiagramEdge edge;
  edge.left = 0;
  edge.right = 1;
  for (int i = 0; i <= 8; ++i) {
    const Uv m = {0.25 * kPi * (i % 8), 0.0};
    BisectorPoint at{*rays.to(0, m), *rays.to(1, m)};
    if (at.tangent().dot(sphere.jet(m).Su) < 0.0) std::swap(at.left, at.right);
    edge.points.push_back(stored(at));
    edge.left = at.left.site;
    edge.right = at.right.site;
  }
  const EdgeCurve curve(rays, edge);
  EXPECT_EQ(curve.at(0.0)->xyz, curve.at(1.0)->xyz);
  for (int i = 0; i < 16; ++i) EXPECT_NEAR(curve.at((i + 0.5) / 16)->xyz.head<2>().norm(), 1.0, 1e-12);
  EXPECT_NEAR(curve.length(), 2.0 * kPi, 2.0 * kPi * kLengthError);
}

}  // namespace
}  // namespace geovor::testing
