#include "geodesic/trace.h"

#include <cmath>

#include "base/error.h"
#include "geodesic/closed_forms.h"
#include "geodesic/integrator.h"
#include "geodesic/path.h"

namespace geovor {
namespace {

// Sums of steps reach the length asked for to this.
constexpr double kRounding = 1e-14;

}  // namespace

void check_length(double length) {
  if (!(length >= 0.0) || !std::isfinite(length))
    throw Error(ErrorCode::Usage, "the length of a geodesic is negative or no number; give a length of zero or more");
}

TraceResult trace_geodesic(const Surface& surface, Uv start, UvVec direction, double length,
                           const TraceOptions& options) {
  check_length(length);
  if (auto closed = trace_closed_form(surface, start, direction, length)) return *closed;
  GeodesicIntegrator path(surface, start, direction, length, options);
  const TraceStatus status = path.advance(length);
  return {status, path.state(), path.covered(), path.steps(), path.evaluations()};
}

std::vector<GeodesicState> sample_geodesic(const Surface& surface, Uv start, UvVec direction, double length, int count,
                                           const TraceOptions& options) {
  check_length(length);
  PathOptions path_options;
  path_options.trace = options;
  const GeodesicPath path(surface, start, direction, length, path_options);
  std::vector<GeodesicState> samples;
  samples.reserve(count + 1);
  for (int i = 0; i <= count && (i == 0 || length * i / count <= path.length() * (1.0 + kRounding)); ++i)
    samples.push_back(path.state(length * i / count));
  return samples;
}

}  // namespace geovor
