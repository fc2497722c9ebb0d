// The combinatorics of diagrams on sphere and plane against convex hull and Delaunay triangulation, whose predicates
// are determinants over 113 bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <set>

#include "support/quad.h"
#include "test_faces.h"
#include "voronoi/diagram_builder.h"

namespace geovor::testing {
namespace {

using Triple = std::array<int, 3>;

Triple sorted(Triple t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// Of determinants of coordinates about 1: far above what 113 bits leave open, far below those of random points.
const Float128 kDecided = 1e-24;

/// The sign of the volume of four points.
int side_of_plane(const Xyz& a, const Xyz& b, const Xyz& c, const Xyz& d) {
  std::array<std::array<Float128, 3>, 3> m;
  for (int i = 0; i < 3; ++i) {
    m[0][i] = Float128(b[i]) - Float128(a[i]);
    m[1][i] = Float128(c[i]) - Float128(a[i]);
    m[2][i] = Float128(d[i]) - Float128(a[i]);
  }
  const Float128 volume = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                          m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                          m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  EXPECT_TRUE(volume > kDecided || volume < -kDecided) << "four points in a plane: take another seed";
  return volume > 0 ? 1 : -1;
}

/// The point k with which (i, j, k) is a facet that has all others on its negative side.
int wrap(const std::vector<Xyz>& x, int i, int j) {
  int best = -1;
  for (int k = 0; k < static_cast<int>(x.size()); ++k) {
    if (k == i || k == j) continue;
    if (best < 0 || side_of_plane(x[i], x[j], x[best], x[k]) > 0) best = k;
  }
  return best;
}

/// The facets of the convex hull of points that are all its corners, by gift wrapping.
std::set<Triple> hull_facets(const std::vector<Xyz>& x) {
  // A first edge: point 0 and the one with which some plane through both has all others on one side.
  std::set<Triple> facets;
  std::deque<std::array<int, 2>> open;
  for (int j = 1; j < static_cast<int>(x.size()) && open.empty(); ++j) {
    const int k = wrap(x, 0, j);
    const auto outside = [&](int m) { return m != 0 && m != j && m != k && side_of_plane(x[0], x[j], x[k], x[m]) > 0; };
    bool facet = true;
    for (int m = 0; m < static_cast<int>(x.size()); ++m) facet = facet && !outside(m);
    if (facet) open.push_back({0, j});
  }
  std::set<std::array<int, 2>> done;
  while (!open.empty()) {
    const auto [i, j] = open.front();
    open.pop_front();
    if (!done.insert({i, j}).second) continue;
    const int k = wrap(x, i, j);
    facets.insert(sorted({i, j, k}));
    done.insert({j, k}), done.insert({k, i});
    for (const auto& e : {std::array{j, i}, std::array{k, j}, std::array{i, k}})
      if (done.count(e) == 0) open.push_back(e);
  }
  return facets;
}

std::set<Triple> triples_inside(const VoronoiDiagram& d) {
  std::set<Triple> triples;
  for (const DiagramVertex& v : d.vertices) {
    if (v.on_boundary) continue;
    EXPECT_EQ(v.sites.size(), 3u);
    if (v.sites.size() == 3) triples.insert(sorted({v.sites[0], v.sites[1], v.sites[2]}));
  }
  return triples;
}

class OnSphere : public ::testing::TestWithParam<int> {};

TEST_P(OnSphere, VerticesAreTheFacetsOfTheConvexHull) {
  const TestFace face = whole(std::make_shared<Sphere>(Frame{}, 1.0));
  Uniform random(static_cast<unsigned>(GetParam()));
  std::vector<Uv> sites;
  for (int i = 0; i < GetParam(); ++i) {
    const double u = 2.0 * kPi * random(), z = 2.0 * random() - 1.0;
    sites.push_back({u, std::asin(z)});
  }
  const VoronoiDiagram d = build_diagram(face.domain(), sites);
  std::vector<Xyz> x;
  for (const DiagramSite& s : d.sites) x.push_back(s.xyz);
  const std::set<Triple> facets = hull_facets(x);
  EXPECT_EQ(facets.size(), 2u * sites.size() - 4u);
  EXPECT_EQ(triples_inside(d), facets);
  EXPECT_EQ(d.vertices.size(), facets.size());
  EXPECT_EQ(d.edges.size(), 3u * sites.size() - 6u);
}

INSTANTIATE_TEST_SUITE_P(Counts, OnSphere, ::testing::Values(5, 12, 40, 150));

/// Positive where p lies inside the circle through a, b, c (counter-clockwise), by the determinant of their lifts.
int in_circle(Uv a, Uv b, Uv c, Uv p) {
  const std::array<Uv, 3> corners = {a, b, c};
  std::array<std::array<Float128, 3>, 3> m;
  for (int i = 0; i < 3; ++i) {
    const Float128 x = Float128(corners[i].u) - Float128(p.u), y = Float128(corners[i].v) - Float128(p.v);
    m[i] = {x, y, x * x + y * y};
  }
  const Float128 det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                       m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                       m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  EXPECT_TRUE(det > kDecided || det < -kDecided) << "four points on a circle: take another seed";
  return det > 0 ? 1 : -1;
}

/// The Delaunay triangles whose circumcentre lies in the square (-1, 1)^2.
std::set<Triple> delaunay_triangles(const std::vector<Uv>& p) {
  std::set<Triple> out;
  const int n = static_cast<int>(p.size());
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      for (int k = j + 1; k < n; ++k) {
        Triple t = {i, j, k};
        if (cross(p[j] - p[i], p[k] - p[i]) < 0.0) std::swap(t[1], t[2]);
        bool empty = true;
        for (int m = 0; m < n && empty; ++m)
          empty = m == i || m == j || m == k || in_circle(p[t[0]], p[t[1]], p[t[2]], p[m]) < 0;
        if (!empty) continue;
        const UvVec a = p[j] - p[i], b = p[k] - p[i];
        const double d = 2.0 * cross(a, b), a2 = a.u * a.u + a.v * a.v, b2 = b.u * b.u + b.v * b.v;
        const Uv centre = {p[i].u + (b.v * a2 - a.v * b2) / d, p[i].v + (a.u * b2 - b.u * a2) / d};
        if (std::abs(centre.u) < 1.0 && std::abs(centre.v) < 1.0) out.insert(sorted(t));
      }
    }
  }
  return out;
}

class OnPlane : public ::testing::TestWithParam<int> {};

TEST_P(OnPlane, VerticesAreTheDelaunayTriangles) {
  const TestFace face = plane_square();
  const auto sites = random_sites(face.domain(), GetParam(), static_cast<unsigned>(GetParam()));
  EXPECT_EQ(triples_inside(build_diagram(face.domain(), sites)), delaunay_triangles(sites));
}

INSTANTIATE_TEST_SUITE_P(Counts, OnPlane, ::testing::Values(3, 10, 30, 60));

// Cells of a grid meet four by four, but for the noise: what decides is far below the way between the sites, and above
// what a diagram takes for a tie.
constexpr double kNoise = 1e-9;

TEST(NoisyGrid, HasTheDelaunayTrianglesOnThePlane) {
  const TestFace face = plane_square();
  Uniform random(3);
  std::vector<Uv> sites;
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k < 6; ++k) {
      sites.push_back({-0.8 + 0.32 * i + kNoise * (random() - 0.5), -0.8 + 0.32 * k + kNoise * (random() - 0.5)});
    }
  }
  EXPECT_EQ(triples_inside(build_diagram(face.domain(), sites)), delaunay_triangles(sites));
}

TEST(NoisyGrid, HasTheFacetsOfTheConvexHullOnTheSphere) {
  const TestFace face = whole(std::make_shared<Sphere>(Frame{}, 1.0));
  Uniform random(3);
  std::vector<Uv> sites;
  for (int i = 0; i < 8; ++i) {
    for (int k = -2; k < 3; ++k) {
      sites.push_back({2.0 * kPi * i / 8 + kNoise * (random() - 0.5), 0.5 * k + kNoise * (random() - 0.5)});
    }
  }
  const VoronoiDiagram d = build_diagram(face.domain(), sites);
  std::vector<Xyz> x;
  for (const DiagramSite& s : d.sites) x.push_back(s.xyz);
  EXPECT_EQ(triples_inside(d), hull_facets(x));
}

}  // namespace
}  // namespace geovor::testing
