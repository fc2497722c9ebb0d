#include "geodesic/offset.h"

#include <Eigen/Geometry>

#include "geodesic/path.h"
#include "geodesic/ray_source.h"
#include "surface/forms.h"
#include "surface/tangent_frame.h"

namespace geovor {

// The erratum's (y/W) (-(F u' + G v'), E u' + F v') is y n x T in coordinates. Taken from the vectors it keeps the
// digits that F^2 - EG loses where parameter lines are sheared.
OffsetJet offset(const Surface& surface, Uv p, double s, double t, const TraceOptions& options) {
  check_length(s);
  const TracedRay end = RaySource(surface, p).end(s, t, options);
  const UvVec left = tangent_components(end.jet, end.at.normal.cross(end.at.tangent));
  return {end.status, end.at.p, end.d, end.at.y * left, end.at.y, end.at};
}

std::optional<ConjugatePoint> first_conjugate_point(const Surface& surface, Uv p, double t, double max_length,
                                                    const TraceOptions& options) {
  PathOptions path_options;
  path_options.trace = options;
  path_options.stop_at_conjugate_point = true;
  const GeodesicPath path(surface, p, tangent_frame(surface, p).at_angle(t), max_length, path_options);
  if (path.result().status != TraceStatus::AtConjugatePoint) return std::nullopt;
  return ConjugatePoint{path.length(), path.result().end.p};
}

}  // namespace geovor
