// Follows a geodesic of the unit sphere for a quarter of a great circle: it ends a right angle away from its start.
#include <cmath>
#include <cstdio>

#include "geodesic/trace.h"
#include "surface/elementary_surfaces.h"

int main() {
  const geovor::Sphere sphere(geovor::Frame{}, 1.0);
  const geovor::Uv start{0.3, 0.2};
  const geovor::TraceResult quarter = geovor::trace_geodesic(sphere, start, {0.7, 0.4}, std::acos(0.0));
  const double cosine = sphere.position(start).dot(sphere.position(quarter.end.p));
  std::printf("cosine %g\n", cosine);
  return quarter.status == geovor::TraceStatus::Converged && std::abs(cosine) < 1e-10 ? 0 : 1;
}
