// The parts of geovor_bench; each prints its table.
#pragma once

#include <random>
#include <vector>

#include "splines.h"
#include "timing.h"

namespace geovor::bench {

void bench_jets();
void bench_geodesics();
void bench_distances();
void bench_bisectors();
void bench_diagrams();

/// OpenCASCADE's D2 of a surface at `points`: of the Geom_BSplineSurface, and of a GeomAdaptor_Surface, which
/// remembers the span of its last call. None in a build without OpenCASCADE.
std::vector<Contender> occ_contenders(const Spline& spline, const std::vector<Uv>& points);

/// `count` seeded random points of a rectangle.
inline std::vector<Uv> random_points(const UvBox& box, int count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(box.u.lo, box.u.hi), v(box.v.lo, box.v.hi);
  std::vector<Uv> points;
  for (int i = 0; i < count; ++i) {
    const double first = u(random);
    points.push_back({first, v(random)});
  }
  return points;
}

}  // namespace geovor::bench
