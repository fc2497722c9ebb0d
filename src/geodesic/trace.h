// Initial-value geodesics: the curve that leaves a point in a direction, with its Jacobi field.
#pragma once

#include <vector>

#include "surface/surface.h"

namespace geovor {

/// A point of a unit-speed geodesic x(s) together with the Jacobi field y along it (proposition 3.6 of the paper):
/// y'' = -K y, y(0) = 0, y'(0) = 1. |y| is how fast neighbouring geodesics from the start spread.
struct GeodesicState {
  Uv p;
  UvVec d;         ///< dx/ds in the parameter plane; unit length in the surface's metric
  double y = 0.0;  ///< model units per radian
  double dy = 1.0;
};

/// The same point in space.
struct SpaceState {
  Xyz S;
  Xyz tangent;  ///< unit
  Xyz normal;   ///< unit, along Su x Sv
  double y = 0.0;
  double dy = 1.0;
  Uv p;  ///< run on over seams
};

enum class TraceStatus {
  Converged,         ///< the whole length was covered
  LeftDomain,        ///< the geodesic met the border of the surface's domain; the state is the last point inside
  AtConjugatePoint,  ///< a path that was to stop at the first conjugate point did (geodesic/path.h)
  StepLimit,         ///< too many steps (see TraceOptions::max_steps): the state is the last accepted one
  /// The tangent plane is lost ahead: a side that is one point but no pole, a fold, a tip (or the path runs into a
  /// crease along its line). The state is the last good one, within 1e-12 of the length of the bad place; within 1e-6
  /// where the jets do not tell the metric any nearer, as at tips of splines.
  DegenerateMetric,
};

struct TraceOptions {
  /// Error allowed in the end point, relative to the length of the path.
  double tolerance = 1e-12;
  /// Accepted and rejected steps together.
  int max_steps = 10000;
  /// Stop at the border of Surface::domain() (never in a periodic direction). If false the outermost analytic piece is
  /// continued, which is what a boundary-value solver wants while it is still on its way.
  bool stop_at_domain = true;
};

struct TraceResult {
  TraceStatus status = TraceStatus::StepLimit;
  GeodesicState end;
  double length = 0.0;  ///< arc length really covered, model units
  int steps = 0;
  int evaluations = 0;  ///< surface jets
};

/// Throws Error(Usage) where `length` is none that a geodesic may have: negative, infinite or NaN.
void check_length(double length);

/// Follows the geodesic from `start` along `direction` (of any length but zero; it is normalized in the metric).
/// Promises: with status Converged the end lies, as a rule, within 5 * options.tolerance * length of the true one,
/// knots, creases and poles and all (on the wave at 1e-13 the worst of 1000 random paths of length 0.1, 0.5 and 2
/// has 3.8, 3.1 and 0.6 tolerances; one in several thousand short ones has 6): the integrator (Dormand-Prince 8(5,3))
/// works on one analytic piece at a time, restarts on the line between two, and passes poles in their charts. y is as
/// exact, with one exception that is no fault of the steps: where the curvature jumps (a C1 line) y' changes by the
/// jump times y times the arc length beyond the line, and a path that dips beyond it by d stays there for sqrt(8 d /
/// k), k its curvature against the line. So an error e of the place, rounding at least, is one of sqrt(8 (d + e) / k) -
/// sqrt(8 d / k) of that length, and a dip below e need not be seen at all. In the same way y behind a crease met at
/// the angle a knows what the path's direction knows, times 1 / sin a. Does not promise that the path is shortest; see
/// geodesic/distance.h.
TraceResult trace_geodesic(const Surface& surface, Uv start, UvVec direction, double length,
                           const TraceOptions& options = {});

/// Points of the same geodesic at `count` + 1 equal arc lengths from 0 to `length`, both ends included; shorter where
/// the geodesic stops early.
std::vector<GeodesicState> sample_geodesic(const Surface& surface, Uv start, UvVec direction, double length, int count,
                                           const TraceOptions& options = {});

}  // namespace geovor
