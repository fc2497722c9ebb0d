// Boundary-value geodesics: a geodesic from one point to another, found near a guess.
#pragma once

#include <optional>

#include "geodesic/trace.h"

namespace geovor {

/// Where a point lies in geodesic polar coordinates about another: O_p(s,t).
struct Polar {
  double s = 0.0;  ///< model units
  double t = 0.0;  ///< radians, in the frame of direction_at_angle
};

enum class ConnectStatus {
  Converged,
  NotConverged,      ///< the iteration did not settle; the rest of the result is its last state
  DegenerateMetric,  ///< a place without tangent plane stood in the way, or is an end
};

struct ConnectOptions {
  double tolerance = 1e-12;  ///< of the end point, relative to the length
  int max_iterations = 30;
  /// Integrator steps of one shot; a short path that needs many runs through a bad parameterization.
  int max_steps = 10000;
  /// Where the first guess fails: try other starts, in the end the energy method. Without it a failure is told at once.
  bool persist = true;
};

/// A geodesic between two points.
struct Connection {
  ConnectStatus status = ConnectStatus::NotConverged;
  double length = 0.0;
  double angle = 0.0;          ///< t of the geodesic at the start
  UvVec start_direction;       ///< unit, at the start, pointing along the path
  UvVec end_direction;         ///< unit, at the end, pointing on along the path
  double y = 0.0;              ///< Jacobi field at the end (y = 0 at the start)
  double residual = 0.0;       ///< estimate of the distance in space between the path's end and the point asked for
  bool leaves_domain = false;  ///< the path runs outside Surface::domain() on its way
  int iterations = 0;
  int evaluations = 0;
  /// With DegenerateMetric: where the tangent plane is missing, the start itself or where the last shot lost it.
  std::optional<Uv> degenerate_at;
};

/// The log map: the geodesic from `from` that ends at `to`, by shooting with the Jacobi field as Newton's derivative
/// (the residual is measured in space, so a `to` given one period away is the same point). Without a guess near points
/// are joined by collocation, others by shooting from what the chord and the straight line in the parameter plane
/// suggest, in the end by the energy method. Finds a geodesic, not always the shortest; see geodesic/distance.h.
Connection connect(const Surface& surface, Uv from, Uv to, std::optional<Polar> guess = std::nullopt,
                   const ConnectOptions& options = {});

}  // namespace geovor
