// Charts of poles: where a side of the parameter rectangle is one point of space, u and v are no coordinates, but a
// smooth surface is still the graph of a height over its tangent plane.
#pragma once

#include "surface/frame.h"
#include "surface/height_jet.h"
#include "surface/surface.h"

namespace geovor {

/// A side of a surface's domain: v = at (along_u) or u = at, at the low or the high end of the interval. A line inside
/// the domain that is one point (a whole circle revolved about its diameter) is two sides, `low` of the part above it.
struct PoleSide {
  bool along_u = true;
  double at = 0.0;
  bool low = true;

  /// The parameter along the side.
  double along(Uv p) const { return along_u ? p.u : p.v; }
  /// How far p lies inside of the side, in the parameter; negative beyond it.
  double depth(Uv p) const {
    const double x = along_u ? p.v : p.u;
    return low ? x - at : at - x;
  }
  Uv point(double along, double depth) const {
    const double x = low ? at + depth : at - depth;
    return along_u ? Uv{along, x} : Uv{x, along};
  }
};

/// The surface around a pole P as the Monge graph P + a e1 + b e2 + h(a,b) n over its tangent plane. n is the limit of
/// the base surface's own normal Su x Sv / |Su x Sv|, and e1, e2, n are right-handed, so that angles turn the same way
/// on both. Jets come from geometry, not from the base's parameters: they are smooth across the pole whatever the
/// parameterization, and exact to rounding at any distance from it, 0 included.
///
/// Where the side covers less than a full turn (a pole at the corner of a patch), the chart holds the wedge; a little
/// beyond it continues the base's map, farther out only the osculating paraboloid.
class PoleChart : public Surface {
 public:
  SurfaceKind kind() const override { return SurfaceKind::Function; }
  /// The square around the disk of radius().
  UvBox domain() const override { return {{-radius_, radius_}, {-radius_, radius_}}; }
  SurfaceJet jet(Uv ab) const final;
  using Surface::jet;

  /// The chart is meant for |(a,b)| <= radius(), a fraction of the radius of curvature at the pole.
  double radius() const { return radius_; }
  Xyz pole() const { return frame_.origin; }
  /// Origin P, axes e1, e2, n.
  const Frame& frame() const { return frame_; }
  const PoleSide& side() const { return side_; }

  /// Parameters on the base surface; along the side in the base's principal period. At the pole itself some point of
  /// the side.
  virtual Uv to_base(Uv ab) const = 0;
  /// The inverse; relatively exact down to the pole. Also for a p up to some way outside the disk.
  virtual Uv from_base(Uv p) const = 0;
  /// Whether p, a point of the base's domain on this side of the pole, lies in the disk of the chart; cheap for the
  /// points far away. On the pole itself it is true for both charts of a line inside the domain.
  virtual bool holds(Uv p) const;

  /// The unit direction in space in which the base's lines "depth = const" run through p (that of Su where the side is
  /// v = const), exact down to the pole, where it is the limit along the other parameter line.
  virtual Xyz side_direction(Uv p) const = 0;

  /// h and its derivatives.
  virtual HeightJet height(Uv ab) const = 0;

 protected:
  /// `reach`: a depth that no point of the disk exceeds, small enough for from_base to be one-to-one up to it.
  PoleChart(const Frame& frame, const PoleSide& side, double radius, double reach)
      : frame_(frame), side_(side), radius_(radius), reach_(reach) {}

 private:
  Frame frame_;
  PoleSide side_;
  double radius_, reach_;
};

}  // namespace geovor
