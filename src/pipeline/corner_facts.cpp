#include "pipeline/corner_facts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

namespace geovor {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

double angle_at(const std::array<Xyz, 3>& x, int i) {
  const Xyz a = x[(i + 1) % 3] - x[i], b = x[(i + 2) % 3] - x[i];
  return std::atan2(a.cross(b).norm(), a.dot(b)) / kDegree;
}

}  // namespace

std::vector<SharpCorner> small_corners(const CadModel& model, const std::vector<FaceCorner>& corners,
                                       const BorderPoints& border) {
  std::vector<SharpCorner> small;
  for (const FaceCorner& c : corners) {
    const std::vector<int>& points = border.edges[c.out.edge].points;
    if (!(c.angle < kSmallAngle * kDegree) || points.empty()) continue;
    const int point = c.out.at_start ? points.front() : points.back();
    small.push_back({model.faces[c.face].number, border.points[point], c.angle / kDegree, point});
  }
  return small;
}

SmallAngles small_angles(const FaceMesh& mesh, const BorderPoints& border, const std::vector<SharpCorner>& corners) {
  std::set<int> sharp;
  for (const SharpCorner& c : corners) sharp.insert(c.border_point);
  SmallAngles count;
  for (const std::array<int, 3>& t : mesh.triangles) {
    std::array<Xyz, 3> x;
    std::transform(t.begin(), t.end(), x.begin(), [&](int v) { return v < 0 ? mesh.inner[-1 - v] : border.points[v]; });
    const std::array<double, 3> angles{angle_at(x, 0), angle_at(x, 1), angle_at(x, 2)};
    const int i = static_cast<int>(std::min_element(angles.begin(), angles.end()) - angles.begin());
    if (!(angles[i] < kSmallAngle)) continue;
    ++count.all;
    if (sharp.count(t[i]) == 0) ++count.away_from_corners;
  }
  return count;
}

}  // namespace geovor
