#include "io/mesh_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "io/hidden_surfaces.h"
#include "io/picture_projection.h"

namespace geovor {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

constexpr PageFrame kFrame{100, 50, 800, 600};

/// A unit sphere by longitude and latitude, outward.
TriangleMesh sphere(int n) {
  const auto point = [n](int i, int j) {
    const double u = 2 * std::numbers::pi * (i % (2 * n)) / (2 * n), v = std::numbers::pi * j / n;
    return Xyz(std::sin(v) * std::cos(u), std::sin(v) * std::sin(u), std::cos(v));
  };
  TriangleMesh mesh;
  const auto add = [&mesh](const Xyz& a, const Xyz& b, const Xyz& c) {
    const int first = static_cast<int>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), {a, b, c});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.face_of.push_back(1);
  };
  for (int i = 0; i < 2 * n; ++i) {
    for (int j = 0; j < n; ++j) {
      if (j + 1 < n) add(point(i, j), point(i, j + 1), point(i + 1, j + 1));
      if (j > 0) add(point(i, j), point(i + 1, j + 1), point(i + 1, j));
    }
  }
  return mesh;
}

int count(const std::string& text, const std::string& word) {
  int n = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

TEST(PictureProjection, IsAnIsometryOfThePageAndFillsItsFrame) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> x(-3, 5);
  std::vector<Xyz> points;
  for (int i = 0; i < 200; ++i) points.push_back({x(random), x(random), 4 * x(random)});
  const auto view = PictureProjection::isometric(points, kFrame);
  Eigen::Matrix3d axes;
  axes << view.right(), view.up(), view.towards_viewer();
  EXPECT_TRUE((axes.transpose() * axes).isIdentity(1e-14));
  EXPECT_NEAR(axes.determinant(), 1.0, 1e-14);
  // All three axes of space look equally long from an isometric point of view, and z points up.
  const PagePoint o = view({0, 0, 0});
  for (const Xyz& e : {Xyz::UnitX().eval(), Xyz::UnitY().eval(), Xyz::UnitZ().eval()}) {
    const PagePoint p = view(e);
    EXPECT_NEAR(std::hypot(p.x - o.x, p.y - o.y), view.scale() * std::sqrt(2.0 / 3.0), 1e-9);
  }
  EXPECT_LT(view({0, 0, 1}).y, o.y);
  EXPECT_NEAR(view({0, 0, 1}).x, o.x, 1e-9);
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  for (const Xyz& p : points) {
    const PagePoint q = view(p);
    left = std::min(left, q.x), right = std::max(right, q.x), top = std::min(top, q.y), bottom = std::max(bottom, q.y);
  }
  EXPECT_GE(left, kFrame.left - 1e-9);
  EXPECT_LE(right, kFrame.left + kFrame.width + 1e-9);
  EXPECT_GE(top, kFrame.top - 1e-9);
  EXPECT_LE(bottom, kFrame.top + kFrame.height + 1e-9);
  EXPECT_NEAR(std::max((right - left) / kFrame.width, (bottom - top) / kFrame.height), 1.0, 1e-12);
}

TEST(PaintingOrder, ShowsOfASphereTheTrianglesThatFaceTheViewer) {
  const TriangleMesh mesh = sphere(12);
  const auto view = PictureProjection::isometric(mesh.points, kFrame);
  std::vector<PageTriangle> page;
  std::vector<int> facing;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Xyz n = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
    if (n.dot(view.towards_viewer()) > 0.02 * n.norm()) facing.push_back(static_cast<int>(page.size()));
    page.push_back({view(mesh.points[a]), view(mesh.points[b]), view(mesh.points[c])});
  }
  std::vector<int> seen = painting_order(page, 1000, 700);
  std::sort(seen.begin(), seen.end());
  EXPECT_TRUE(std::includes(seen.begin(), seen.end(), facing.begin(), facing.end()));
  EXPECT_LE(seen.size(), facing.size() + 24u) << "more than the rim's edge-on triangles besides";
}

TEST(PaintingOrder, PaintsALongTriangleOverAShortOneThatItReachesPast) {
  // Where they overlap the long one is at depths from 0 to -40; its mean depth is -263.
  const PageTriangle reaching{{{10, 50, 10}, {190, 10, -400}, {190, 90, -400}}};
  const PageTriangle behind{{{10, 40, -60}, {30, 40, -60}, {20, 70, -60}}};
  EXPECT_THAT(painting_order({reaching, behind}, 200, 100), ElementsAre(1, 0));
  const PageTriangle in_front{{{10, 40, 20}, {30, 40, 20}, {20, 70, 20}}};
  EXPECT_THAT(painting_order({reaching, in_front}, 200, 100), ElementsAre(0, 1));
}

TEST(PaintingOrder, LeavesOutWhatIsHiddenAndWhatIsSeenEdgeOn) {
  const PageTriangle near{{{0, 0, 5}, {100, 0, 5}, {0, 100, 5}}};
  const PageTriangle behind{{{10, 10, 0}, {40, 10, 0}, {10, 40, 0}}};
  const PageTriangle edge_on{{{0, 0, 9}, {50, 50, 9}, {100, 100, 20}}};
  EXPECT_THAT(painting_order({behind, near, edge_on}, 100, 100), ElementsAre(1));
}

TEST(PaintingOrder, DrawsAllOfARing) {
  // Three bars, each over the next: no order is right, none may be lost.
  const auto bar = [](double angle) {
    const auto at = [angle](double x, double y, double depth) {
      return PagePoint{50 + x * std::cos(angle) - y * std::sin(angle), 50 + x * std::sin(angle) + y * std::cos(angle),
                       depth};
    };
    return PageTriangle{at(-45, 12, -30), at(45, 8, 30), at(45, 20, 30)};
  };
  EXPECT_THAT(painting_order({bar(0), bar(2 * std::numbers::pi / 3), bar(4 * std::numbers::pi / 3)}, 100, 100),
              UnorderedElementsAre(0, 1, 2));
}

TEST(PaintingOrder, KeepsSeenTrianglesTooSmallForASquare) {
  const PageTriangle speck{{{20.1, 20.1, 8}, {20.3, 20.1, 8}, {20.1, 20.3, 8}}};
  const PageTriangle sheet{{{0, 0, 0}, {100, 0, 0}, {0, 100, 0}}};
  EXPECT_THAT(painting_order({speck, sheet}, 100, 100), UnorderedElementsAre(0, 1));
  PageTriangle below = speck;
  for (PagePoint& p : below) p.depth = -8;
  EXPECT_THAT(painting_order({below, sheet}, 100, 100), ElementsAre(1));
}

TEST(MeshPicture, IsTheSameTwiceAndHasAPathASeenTriangle) {
  const TriangleMesh mesh = sphere(10);
  const std::string svg = mesh_picture(mesh);
  EXPECT_EQ(svg, mesh_picture(mesh));
  EXPECT_THAT(svg, HasSubstr("<svg xmlns="));
  EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
  EXPECT_EQ(count(svg, "nan"), 0);
  const int fills = count(svg, "Z\" fill=\"#");
  EXPECT_GE(fills, static_cast<int>(mesh.triangles.size()) / 2 - 20);
  EXPECT_LE(fills, static_cast<int>(mesh.triangles.size()) / 2 + 20);
}

TEST(MeshPicture, DrawsTheBorderOfAFaceStrong) {
  // Two triangles of one face over a square: four sides are border, the diagonal is not.
  TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}, {1, 1}};
  const auto strong_lines = [&mesh] {
    const std::string svg = mesh_picture(mesh);
    int lines = 0;
    for (auto at = svg.find("class=\"s\" d=\""); at != std::string::npos; at = svg.find("class=\"s\" d=\"", at + 1)) {
      const std::string path = svg.substr(at + 13, svg.find("\"/>", at) - at - 13);
      lines += count(path, "M");
    }
    return lines;
  };
  EXPECT_EQ(strong_lines(), 4);
  mesh.face_of[1] = 2;  // now the diagonal is the limit of both
  EXPECT_EQ(strong_lines(), 6);
}

TEST(MeshPicture, OfNothingIsAnEmptyPage) {
  EXPECT_THAT(mesh_picture({}), HasSubstr("</svg>"));
  const TriangleMesh flat{{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}}, {1}};
  EXPECT_EQ(count(mesh_picture(flat), "nan"), 0);
}

}  // namespace
}  // namespace geovor
