// What is kept of a path on its way, so that every point of it can be had again.
#pragma once

#include <vector>

#include "geodesic/piece.h"
#include "surface/pole_chart.h"

namespace geovor {

/// A step of a path, on one analytic piece of the surface or in the chart of a pole.
struct PathLeg {
  double s = 0.0;  ///< arc length at its start
  double h = 0.0;
  GeodesicVector x, slope;           ///< at its start, in the coordinates of the piece
  GeodesicVector end;                ///< the state at its end, in the same coordinates
  Piece piece;                       ///< of the surface, or of the chart
  const PoleChart* chart = nullptr;  ///< of which x are coordinates; none: they are parameters of the surface
  Uv start;                          ///< the surface's parameters at its start
  double slowed_time = 0.0;          ///< of a step in the slowed time; zero: a step by arc length
};

/// A path went over a line between two pieces.
struct PathCrossing {
  double s = 0.0;
  Uv p;
  Border border;
  double bend = 0.0;  ///< angle between the two tangent planes
};

struct PathRecord {
  std::vector<PathLeg> legs;
  std::vector<PathCrossing> crossings;
};

}  // namespace geovor
