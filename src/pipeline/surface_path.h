// A geodesic that can be asked for any of its points.
#pragma once

#include <functional>
#include <vector>

#include "geodesic/connect.h"
#include "geodesic/trace.h"

namespace geovor {

struct PathPoint {
  double s = 0.0;  ///< arc length from the start
  Uv uv;           ///< runs on across seams
  Xyz xyz = Xyz::Zero();
  Xyz tangent = Xyz::Zero();  ///< unit
};

/// A stretch of a path on which it is analytic.
struct PathPiece {
  double from = 0.0, to = 0.0;
  int ends_at = -1;  ///< index of the break at `to`, -1 where there is none
};

/// The geodesic of a connection, by arc length. REQUIRES: the surface outlives it; the connection has converged.
class SurfacePath {
 public:
  SurfacePath(const Surface& surface, Uv from, const Connection& connection);

  double length() const { return length_; }
  PathPoint at(double s) const;

  /// 0, the arc lengths between at which the path is not analytic (knot lines, creases), and the length.
  const std::vector<double>& breaks() const { return breaks_; }
  /// The tangent with which the path comes to breaks()[i]; at a crease it is not the one with which it goes on.
  Xyz tangent_before(int i) const;

  /// The path cut at its breaks, and into so many pieces that no bump of a tenth of its length is stepped over.
  std::vector<PathPiece> pieces() const;

 private:
  const Surface& surface_;
  double length_;
  std::vector<GeodesicState> milestones_;
  std::vector<double> breaks_;
};

/// Points of the path from its start to its end, its breaks among them, so close that `close(a, middle, b)` holds for
/// each two neighbours a, b and the point half way between them (or the two are a 2^-20th of the path apart).
using CloseEnough = std::function<bool(const PathPoint& a, const PathPoint& middle, const PathPoint& b)>;
std::vector<PathPoint> sample_path(const SurfacePath& path, const CloseEnough& close);

}  // namespace geovor
