#include "geodesic/offset.h"

#include <cmath>

#include "surface/forms.h"

namespace geovor {

OffsetJet offset(const Surface& surface, Uv p, double s, double t, const TraceOptions& options) {
  const UvVec direction = direction_at_angle(first_form(surface.jet(p)), t);
  const TraceResult path = trace_geodesic(surface, p, direction, s, options);
  const UvVec d = path.end.d;
  const FirstForm I = first_form(surface.jet(path.end.p));
  const double k = path.end.y / std::sqrt(I.W2());
  return {path.status, path.end.p, d, {-k * (I.F * d.u + I.G * d.v), k * (I.E * d.u + I.F * d.v)}, path.end.y};
}

}  // namespace geovor
