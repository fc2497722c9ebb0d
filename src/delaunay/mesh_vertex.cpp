#include "delaunay/mesh_vertex.h"

#include <cmath>
#include <limits>

namespace geovor {
namespace {

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

}  // namespace geovor
