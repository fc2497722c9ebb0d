#include "delaunay/mesh_vertex.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace geovor {
namespace {

// A triangle is upright if its normal makes less than about 78 degrees with the mean of its corners' normals.
constexpr double kUprightCosine = 0.2;

double nearest_copy(double x, std::optional<double> period, double reference) {
  return period ? x + *period * std::round((reference - x) / *period) : x;
}

}  // namespace

Uv parameters_near(const MeshVertex& vertex, const Surface& surface, Uv reference, UvVec weight) {
  Uv best = vertex.uv.front();
  double best_distance = std::numeric_limits<double>::infinity();
  for (Uv p : vertex.uv) {
    p.u = vertex.free_u ? reference.u : nearest_copy(p.u, surface.u_period(), reference.u);
    p.v = vertex.free_v ? reference.v : nearest_copy(p.v, surface.v_period(), reference.v);
    const double d = std::hypot(weight.u * (p.u - reference.u), weight.v * (p.v - reference.v));
    if (d < best_distance) {
      best_distance = d;
      best = p;
    }
  }
  return best;
}

double geodesic_estimate(const MeshVertex& a, const MeshVertex& b) {
  const Xyz chord = b.x - a.x;
  const double c = chord.norm();
  if (c == 0.0) return 0.0;
  // Slopes of the curve against the chord at both ends; int sqrt(1 + y'^2) for the cubic with these slopes.
  const double alpha = std::asin(std::clamp(a.n.dot(chord) / c, -1.0, 1.0));
  const double beta = -std::asin(std::clamp(b.n.dot(chord) / c, -1.0, 1.0));
  return c * (1.0 + (2.0 * alpha * alpha + 2.0 * beta * beta + alpha * beta) / 30.0);
}

bool upright(const MeshVertex& a, const MeshVertex& b, const MeshVertex& c) {
  const Xyz n = (b.x - a.x).cross(c.x - a.x);
  const Xyz m = a.n + b.n + c.n;
  return n.dot(m) > kUprightCosine * n.norm() * m.norm();
}

}  // namespace geovor
