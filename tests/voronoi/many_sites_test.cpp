// A diagram of 100,000 sites, on a plane, where distances need no geodesics.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "diagram_laws.h"
#include "numeric/worst_of.h"
#include "test_faces.h"
#include "voronoi/diagram_builder.h"

namespace geovor::testing {
namespace {

constexpr int kSites = 100000;

// Relative to the radius. Places are doubles of size 1, so that distances between them are rounded by some 1e-16
// whatever the radius, the smallest of which is 1e-5.
constexpr double kEqual = 1e-12;
constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();

/// Sites of kSquare by squares of a grid, to be asked for all about a place.
class Buckets {
 public:
  explicit Buckets(const std::vector<DiagramSite>& sites) : sites_(sites), of_(kAcross * kAcross) {
    for (int i = 0; i < static_cast<int>(sites.size()); ++i)
      of_[index(sites[i].xyz.x()) * kAcross + index(sites[i].xyz.y())].push_back(i);
  }
  /// The distance to the nearest site, if that is at most r; else any that is longer.
  double nearest(const Xyz& x, double r) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = index(x.x() - r); i <= index(x.x() + r); ++i)
      for (int j = index(x.y() - r); j <= index(x.y() + r); ++j)
        for (const int site : of_[i * kAcross + j]) nearest = std::min(nearest, (sites_[site].xyz - x).norm());
    return nearest;
  }

 private:
  static constexpr int kAcross = 300;
  static int index(double x) { return std::clamp(static_cast<int>(0.5 * (x + 1.0) * kAcross), 0, kAcross - 1); }
  const std::vector<DiagramSite>& sites_;
  std::vector<std::vector<int>> of_;
};

TEST(ManySites, AHundredThousandOnAPlaneHaveTheirDiagram) {
  const TestFace face = plane_square();
  const FaceDomain domain = face.domain();
  const VoronoiDiagram d = build_diagram(domain, random_sites(domain, kSites, 3));
  EXPECT_TRUE(d.warnings.empty());
  ASSERT_EQ(d.cells.size(), kSites);
  EXPECT_EQ(broken_topology(d), "");
  EXPECT_EQ(euler_number(domain, d), 1);
  double area = 0.0;
  for (const DiagramCell& cell : d.cells) area += cell.area;
  EXPECT_NEAR(area, 4.0, 4.0 * kEqual);

  double worst = 0.0, said = 0.0;
  for (const DiagramEdge& e : d.edges) {
    double least = std::numeric_limits<double>::infinity();
    for (const EdgePoint& p : e.points) {
      const double a = (p.xyz - d.sites[e.left].xyz).norm(), b = (p.xyz - d.sites[e.right].xyz).norm();
      const double off = larger_of(std::abs(a - p.radius), std::abs(b - p.radius));
      worst = larger_of(worst, off / (kEqual * a + kRounding));
      least = std::min(least, p.radius);
    }
    said = larger_of(said, e.residual / (kEqual + kRounding / least));
  }
  EXPECT_LE(worst, 1.0) << "distances from points of edges to their sites, in parts of what they may differ by";
  EXPECT_LE(said, 1.0) << "residuals of edges, in parts of the same";

  const Buckets buckets(d.sites);
  double off = 0.0;
  for (const DiagramVertex& v : d.vertices) {
    if (v.sites.empty()) continue;
    const double nearest = buckets.nearest(v.xyz, 1.001 * v.radius);
    off = larger_of(off, std::abs(nearest - v.radius) / (kEqual * v.radius + kRounding));
  }
  EXPECT_LE(off, 1.0) << "the nearest of all sites to a vertex, in parts of the same";
}

}  // namespace
}  // namespace geovor::testing
