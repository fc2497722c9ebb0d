// The rays of one point: geodesics that leave it at any angle, with what they have in common computed once.
#pragma once

#include <limits>

#include "geodesic/curvature_map.h"
#include "geodesic/piece.h"
#include "geodesic/trace.h"
#include "surface/tangent_frame.h"

namespace geovor {

/// Where a ray ends.
struct TracedRay {
  TraceStatus status = TraceStatus::StepLimit;
  SpaceState at;
  UvVec d;         ///< its direction in the parameter plane; zero at a pole
  SurfaceJet jet;  ///< of the surface at at.p
  /// The tolerance that was met, as far as that is known: often far below the one asked.
  double tolerance = std::numeric_limits<double>::infinity();
  int evaluations = 0;
};

class RaySource {
 public:
  /// `map`: what is known of the surface elsewhere; it outlives the source.
  explicit RaySource(const Surface& surface, Uv p, const CurvatureMap* map = nullptr);

  /// O_p(s,t) within what trace.h promises; a path that gets far beyond the domain (CurvatureMap::near_domain) has left
  /// it, where a map is given. From options.tolerance = kLoosest on a short ray is one Runge-Kutta step of
  /// order 4 without an estimate of its error, meant for the first steps of an iteration whose last one is exact.
  /// REQUIRES: s is finite and not negative
  TracedRay end(double s, double t, const TraceOptions& options) const;

  const TangentFrame& frame() const { return frame_; }
  /// The largest normal curvature at the point, or what rays no longer than its inverse may meet on their way.
  double curvature() const { return curvature_; }

 private:
  TracedRay in_closed_form(const Xyz& T, double s) const;
  bool near_pole(double s) const;
  bool stays_on_piece(const GeodesicVector& x, const GeodesicVector& end, double h) const;
  TracedRay one_step(const Xyz& T, double s, double tolerance) const;
  TracedRay finish(const GeodesicVector& x, double tolerance, int evaluations) const;

  const Surface* surface_;
  Uv p_;
  SurfaceJet jet_;
  TangentFrame frame_;
  Piece piece_;
  const CurvatureMap* map_;
  double curvature_;
  bool closed_form_;
};

/// From this tolerance on a ray's error need not be estimated.
inline constexpr double kLoosest = 1e-9;

}  // namespace geovor
