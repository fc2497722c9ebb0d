// A geodesic as a whole: a point at every arc length, and what it meets on its way.
#pragma once

#include <vector>

#include "geodesic/path_leg.h"
#include "geodesic/trace.h"

namespace geovor {

enum class PathEventKind {
  KnotLine,        ///< a line between two analytic pieces is crossed
  KnotLineGrazed,  ///< such a line is touched, within the tolerance, but not crossed
  Crease,          ///< a line where the tangent plane turns is crossed: the path is refracted
  Seam,            ///< the line where a closed surface's parameter begins anew is crossed
  Pole,            ///< the place nearest to a pole, inside of the pole's chart
  ConjugatePoint,  ///< y = 0: neighbouring geodesics from the start meet
  Border,          ///< the border of the domain; the path ends
};

struct PathEvent {
  PathEventKind kind = PathEventKind::KnotLine;
  double s = 0.0;
  Uv p;                   ///< run on over seams
  double distance = 0.0;  ///< of a Pole: from the path to it, in space
};

struct PathOptions {
  TraceOptions trace;
  /// End at the first conjugate point after the start (status AtConjugatePoint).
  bool stop_at_conjugate_point = false;
};

/// The geodesic that leaves `start`, as trace_geodesic follows it, kept in memory. Every point of it, not only the end,
/// is as exact as trace.h promises for the whole length: it comes from the step that holds it, run again as far as the
/// point: 11 jets and no error of interpolation (the method's own dense output is of one order less).
class GeodesicPath {
 public:
  /// The direction in the parameter plane, or in space, of any length but zero. REQUIRES: the surface outlives the
  /// path.
  GeodesicPath(const Surface& surface, Uv start, UvVec direction, double length, const PathOptions& options = {});
  GeodesicPath(const Surface& surface, Uv start, const Xyz& tangent, double length, const PathOptions& options = {});

  /// Why and where the path ended; `length` is what it covers.
  const TraceResult& result() const { return result_; }
  double length() const { return result_.length; }

  /// At arc length s; one outside [0, length()] is moved to the nearer end. On a crease: behind it.
  GeodesicState state(double s) const;
  SpaceState at(double s) const;

  /// By ascending s. Events of a path on a closed form (plane, cylinder, cone, sphere) are the same.
  const std::vector<PathEvent>& events() const { return events_; }

 private:
  void follow_closed_form(UvVec direction, double length);
  void follow(class GeodesicIntegrator& integrator, double length, const PathOptions& options);
  void find_end(const PathOptions& options);
  void stop_at(double s);
  const PathLeg& leg_at(double s) const;

  const Surface* surface_;
  Uv start_;
  UvVec direction_;   ///< on a closed form
  SpaceState first_;  ///< at the start
  GeodesicState first_state_;
  PathRecord record_;  ///< empty on a closed form
  TraceResult result_;
  std::vector<PathEvent> events_;
};

}  // namespace geovor
