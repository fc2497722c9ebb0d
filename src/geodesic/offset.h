// The geodesic offset function O_p(s,t) of definition 3.4, with the derivatives of propositions 3.5 and 3.6.
#pragma once

#include <optional>

#include "geodesic/trace.h"

namespace geovor {

/// O_p(s,t): the point at distance s along the geodesic that leaves p at angle t (see tangent_frame, which also says
/// what an angle is at a pole).
struct OffsetJet {
  TraceStatus status = TraceStatus::StepLimit;
  Uv uv;           ///< O_p(s,t)
  UvVec ds;        ///< its derivative in s, unit length in the metric
  UvVec dt;        ///< its derivative in t, length |y|: y times the unit vector to the left of ds
  double y = 0.0;  ///< signed length of dt; zero at a conjugate point
  SpaceState at;   ///< the same in space, exact at poles too: O has the derivatives tangent and y normal x tangent
};

/// With status Converged within the error that trace.h promises.
OffsetJet offset(const Surface& surface, Uv p, double s, double t, const TraceOptions& options = {});

/// The first s in (0, max_length] at which O_p(s,t) is conjugate to p (y = 0), and the point.
struct ConjugatePoint {
  double s = 0.0;
  Uv uv;
};

/// Nothing if there is none that far, or if the geodesic ends before (at the border, or where the metric is lost).
std::optional<ConjugatePoint> first_conjugate_point(const Surface& surface, Uv p, double t, double max_length,
                                                    const TraceOptions& options = {});

}  // namespace geovor
