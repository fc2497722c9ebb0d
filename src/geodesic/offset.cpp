#include "geodesic/offset.h"

#include <Eigen/Geometry>

#include "geodesic/closed_form_path.h"
#include "geodesic/closed_forms.h"
#include "geodesic/integrator.h"
#include "geodesic/path.h"
#include "surface/forms.h"
#include "surface/tangent_frame.h"

namespace geovor {

// The erratum's (y/W) (-(F u' + G v'), E u' + F v') is y n x T in coordinates. Taken from the vectors it keeps the
// digits that F^2 - EG loses where parameter lines are sheared.
OffsetJet offset(const Surface& surface, Uv p, double s, double t, const TraceOptions& options) {
  check_length(s);
  const Xyz T = tangent_frame(surface, p).at_angle(t);
  OffsetJet o;
  SurfaceJet j;
  if (has_closed_form(surface)) {
    const UvVec direction = tangent_components(surface.jet(p), T);
    const TraceResult path = *trace_closed_form(surface, p, direction, s);
    o.status = path.status;
    o.at = closed_form_at(surface, p, direction, T, path.length);
    o.ds = path.end.d;
    j = surface.jet(path.end.p);
  } else {
    GeodesicIntegrator path(surface, p, T, s, options);
    o.status = path.advance(s);
    o.at = path.at();
    o.ds = path.state().d;
    j = path.jet();
  }
  o.uv = o.at.p;
  o.y = o.at.y;
  o.dt = o.y * tangent_components(j, o.at.normal.cross(o.at.tangent));
  return o;
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
