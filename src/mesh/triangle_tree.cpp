#include "mesh/triangle_tree.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace geovor {
namespace {

Xyz nearest_on_segment(const Xyz& a, const Xyz& b, const Xyz& x) {
  const Xyz d = b - a;
  const double length2 = d.squaredNorm();
  if (!(length2 > 0.0)) return a;
  return a + std::clamp((x - a).dot(d) / length2, 0.0, 1.0) * d;
}

std::vector<SpaceBox> boxes_of(const TriangleMesh& mesh) {
  std::vector<SpaceBox> boxes;
  boxes.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    SpaceBox box{mesh.points[t[0]], mesh.points[t[0]]};
    box.include(mesh.points[t[1]]);
    box.include(mesh.points[t[2]]);
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace

// The foot on the plane where that lies inside, seen from each side; else the nearest point of the three sides. A
// triangle without area has no inside.
Xyz nearest_on_triangle(const Xyz& a, const Xyz& b, const Xyz& c, const Xyz& x) {
  const Xyz n = (b - a).cross(c - a);
  const double n2 = n.squaredNorm();
  const bool inside = n2 > 0.0 && n.dot((b - a).cross(x - a)) >= 0.0 && n.dot((c - b).cross(x - b)) >= 0.0 &&
                      n.dot((a - c).cross(x - c)) >= 0.0;
  if (inside) return x - (x - a).dot(n) / n2 * n;
  Xyz best = nearest_on_segment(a, b, x);
  for (const Xyz& q : {nearest_on_segment(b, c, x), nearest_on_segment(c, a, x)}) {
    if ((q - x).squaredNorm() < (best - x).squaredNorm()) best = q;
  }
  return best;
}

TriangleTree::TriangleTree(const TriangleMesh& mesh) : mesh_(mesh), boxes_(boxes_of(mesh)) {}

TriangleTree::Nearest TriangleTree::nearest(const Xyz& x) const {
  Nearest found;
  double best2 = std::numeric_limits<double>::infinity();
  boxes_.near(x, best2, [&](int t, double) {
    const auto& [a, b, c] = mesh_.triangles[t];
    const Xyz foot = nearest_on_triangle(mesh_.points[a], mesh_.points[b], mesh_.points[c], x);
    const double d2 = (foot - x).squaredNorm();
    if (!(d2 < best2)) return;
    best2 = d2;
    found = {t, foot, std::sqrt(d2)};
  });
  return found;
}

}  // namespace geovor
