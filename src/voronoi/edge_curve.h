// An edge of a diagram as a curve: any point of it, its length, and polylines as near to it as one likes.
#pragma once

#include <optional>
#include <vector>

#include "voronoi/bisector.h"
#include "voronoi/diagram.h"

namespace geovor {

/// Between two stored points radius and angles are guessed by the cubics that have the slopes stored there, and
/// corrected in the plane that divides the chord in the ratio asked for. Edges may be closed, and cross seams.
///
/// Does not promise the points of a cut locus right before its free end: there two geodesics become one, and their
/// angles, which go as the square root of the distance from the end, can't be told apart from about 0.003 on. The
/// place asked for is then not found; lengths and polylines go straight over it.
class EdgeCurve {
 public:
  /// Both outlive the curve. REQUIRES: edge.points holds at least two points
  EdgeCurve(const SiteRays& rays, const DiagramEdge& edge);

  /// The point at the fraction x, 0 to 1, of the stored points' cumulated chords: a stored point itself, or one whose
  /// two distances agree to kBisectorTolerance. uv is the copy nearest to the stored points on both sides.
  std::optional<EdgePoint> at(double x) const;

  /// Arc length in space, to kLengthError of itself.
  double length() const;

  /// Points from the first stored one to the last, so dense that no chord is farther than `tolerance` from the edge;
  /// all stored points are among them. Measured in the middle of each chord.
  std::vector<EdgePoint> polyline(double tolerance) const;

 private:
  /// A corrected point between two others, with the direction in which the edge runs there.
  struct Between {
    EdgePoint point;
    Xyz tangent;
  };
  std::optional<Between> between(const EdgePoint& a, const EdgePoint& b, double k) const;
  double length_between(const EdgePoint& a, const EdgePoint& b, int halvings) const;
  std::optional<double> length_by_rule(const EdgePoint& a, const EdgePoint& b, int nodes) const;
  void fill(const EdgePoint& b, double tolerance, int halvings, std::vector<EdgePoint>& line) const;

  const SiteRays& rays_;
  const DiagramEdge& edge_;
  std::vector<double> chords_;  ///< cumulated
};

inline constexpr double kLengthError = 1e-10;

}  // namespace geovor
