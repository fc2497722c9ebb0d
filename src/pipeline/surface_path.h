// The geodesic between two points of a surface as a curve that can be cut into pieces.
#pragma once

#include <functional>
#include <vector>

#include "geodesic/connect.h"
#include "geodesic/path.h"

namespace geovor {

/// Tolerance of the connections and paths that are written out, of their length: rounding. One question does not notice
/// what the last digits cost.
inline constexpr double kAllDigits = 1e-14;

struct PathPoint {
  double s = 0.0;  ///< arc length from the start
  Uv uv;           ///< runs on across seams
  Xyz xyz = Xyz::Zero();
  Xyz tangent = Xyz::Zero();  ///< unit
};

/// A stretch of a path on which it is analytic.
struct PathPiece {
  double from = 0.0, to = 0.0;
  bool ends_at_break = false;
};

/// The geodesic of a connection that starts at `from`, by arc length. REQUIRES: the surface outlives it; the connection
/// has converged.
class SurfacePath {
 public:
  SurfacePath(const Surface& surface, Uv from, const Connection& connection);

  double length() const { return path_.length(); }
  /// At a crease: with the tangent with which the path goes on.
  PathPoint at(double s) const;
  /// The same, with the tangent with which the path comes to the place.
  PathPoint before(double s) const;

  /// The path cut where it is not analytic (knot lines, creases, seams), and into so many pieces that no bump of a
  /// tenth of its length is stepped over.
  std::vector<PathPiece> pieces() const;

 private:
  GeodesicPath path_;
};

/// Points of the path from its start to its end, the ends of its pieces among them, so close that `close(a, middle, b)`
/// holds for each two neighbours a, b and the point half way between them (or the two are a millionth of the path
/// apart).
using CloseEnough = std::function<bool(const PathPoint& a, const PathPoint& middle, const PathPoint& b)>;
std::vector<PathPoint> sample_path(const SurfacePath& path, const CloseEnough& close);

}  // namespace geovor
