#include "geodesic/trace.h"

#include <cmath>

#include "base/error.h"
#include "geodesic/closed_forms.h"
#include "geodesic/integrator.h"

namespace geovor {
namespace {

void check_length(double length) {
  if (!(length >= 0.0) || !std::isfinite(length))
    throw Error(ErrorCode::Usage, "the length of a geodesic is negative or no number; give a length of zero or more");
}

}  // namespace

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
  std::vector<GeodesicState> samples;
  samples.reserve(count + 1);
  if (has_closed_form(surface)) {
    for (int i = 0; i <= count; ++i)
      samples.push_back(trace_closed_form(surface, start, direction, length * i / count)->end);
    return samples;
  }
  GeodesicIntegrator path(surface, start, direction, length, options);
  samples.push_back(path.state());
  for (int i = 1; i <= count; ++i) {
    if (path.advance(length * i / count) != TraceStatus::Converged) break;
    samples.push_back(path.state());
  }
  return samples;
}

}  // namespace geovor
