// The geodesic offset function O_p(s,t) of definition 3.4, with the derivatives of propositions 3.5 and 3.6.
#pragma once

#include "geodesic/trace.h"

namespace geovor {

/// O_p(s,t): the point at distance s along the geodesic that leaves p at angle t (see direction_at_angle).
struct OffsetJet {
  TraceStatus status = TraceStatus::StepLimit;
  Uv uv;           ///< O_p(s,t)
  UvVec ds;        ///< its derivative in s, unit length in the metric
  UvVec dt;        ///< its derivative in t: (y/W) (-(F u' + G v'), E u' + F v'), length |y|
  double y = 0.0;  ///< signed length of dt; zero at a conjugate point
};

OffsetJet offset(const Surface& surface, Uv p, double s, double t, const TraceOptions& options = {});

}  // namespace geovor
