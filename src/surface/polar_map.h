// A B-spline surface around a side that is one point, in polar fashion: relative to that point and its tangent plane.
#pragma once

#include <optional>
#include <vector>

#include "surface/bspline_surface.h"
#include "surface/height_jet.h"
#include "surface/pole_chart.h"

namespace geovor {

/// (w, t), the parameter along the collapsed side and the depth inside of it, to coordinates (a, b, height) in the
/// frame of the tangent plane. The side and its tangents are exact zeros here, so that near it all values keep their
/// relative accuracy: a, b = O(t), height = O(t^2).
class PolarMap {
 public:
  /// Nothing if the side is no single point to rounding, or the surface has no tangent plane there, or its rays from
  /// the pole overlap, or they turn once round though the surface is not closed: the slit is a border then.
  static std::optional<PolarMap> make(const BSplineSurface& surface, const PoleSide& side);

  const Frame& frame() const { return frame_; }
  SurfaceJet jet(double w, double t) const { return map_.jet({w, t}); }

  /// Where (w, t) lies over (a, b).
  struct Foot {
    double w = 0.0, t = 0.0;
    SurfaceJet j;
  };
  /// By Newton's method, to relative rounding; nothing where it doesn't settle, or (a, b) is too far outside the wedge
  /// that the side covers. REQUIRES: (a, b) != (0, 0)
  std::optional<Foot> foot(Uv ab) const;

  /// The graph over (a, b) that the map is near the foot.
  static HeightJet graph(const Foot& foot, Uv ab);

  /// Whether the second derivatives at the pole are the same from all directions; these are then `h`.
  bool second_form(HeightJet& h) const;

  /// At most how far apart, in height, the pieces on the two sides of a line w = const (a knot, the seam) are at the
  /// distance r, each taken as the continuation of the other; infinite where that can't be told. The rounding of the
  /// poles' coordinates is `rounding()`.
  double mismatch(double r) const;
  double rounding() const { return rounding_; }

  /// The domain of w, and the depth up to the first knot line.
  Interval along() const { return map_.domain().u; }
  double depth() const { return depth_; }
  /// The length of the longest and the shortest ray a unit of t long.
  Interval speed() const { return speed_; }

 private:
  struct Ray {
    double angle, w, speed;
  };
  PolarMap(BSplineSurface map, const Frame& frame, double rounding);
  bool tabulate_rays();
  std::optional<Ray> ray(double angle) const;

  BSplineSurface map_;
  Frame frame_;
  double rounding_;  // of coordinates
  double depth_ = 0.0;
  bool full_turn_ = false;
  Interval speed_;
  std::vector<Ray> rays_;  // ascending angles
  Interval wedge_;         // angles of the ends of the side
};

}  // namespace geovor
