// One analytic piece of the surface as the integrator sees it: where it ends, and when a path will get there.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "geodesic/geodesic_equation.h"

namespace geovor {

/// A border line of a piece: parameter `axis` (0 = u, 1 = v) equals `at`; `side` is +1 for the upper border, -1 for the
/// lower one.
struct Border {
  int axis = 0;
  int side = 1;
  double at = 0.0;
};

/// A path's next border, at arc length `s` from where it is; infinite if there is none in sight.
struct Exit {
  double s = std::numeric_limits<double>::infinity();
  Border border;
};

/// What counts as being on a border, and as running outwards there.
struct BorderSlack {
  double along[2] = {0.0, 0.0};  ///< how far beyond a border a point still lies on it, in u and in v
  double look = 0.0;             ///< the arc length ahead at which a path's direction on a border is told
};

/// A span of the surface with its borders, moved by whole periods to where the path is.
class Piece {
 public:
  /// The piece that a path at `p` runs into along `towards`. With `bounded` the domain's borders are borders of the
  /// piece; else the outermost pieces have no outer border.
  Piece(const Surface& surface, Uv p, UvVec towards, bool bounded);

  SurfaceJet jet(const Surface& surface, Uv p) const { return surface.jet({p.u - shift_.u, p.v - shift_.v}, span_); }

  Interval range(int axis) const { return axis == 0 ? box_.u : box_.v; }
  bool has_borders() const;

  /// The path at `x` is beyond a border of the domain, or on one and runs outwards. REQUIRES: bounded.
  bool blocks(const GeodesicVector& x, UvVec towards, const BorderSlack& slack) const;

  /// The border is also one of the domain, so that nothing lies behind it.
  bool ends_domain(const Border& border) const;

 private:
  Span span_;
  UvBox box_;     ///< of the span, shifted
  UvBox domain_;  ///< infinite in periodic directions
  UvVec shift_;   ///< whole periods
};

/// The first border that the parabola x + s x' + s^2 x''/2 meets for s > 0. A border on which the path starts counts
/// only if the parabola comes back to it.
Exit predict_exit(const Piece& piece, const GeodesicVector& x, const GeodesicVector& slope, const BorderSlack& slack);

/// The first s in (0, h) at which the cubic through both ends of a step (values and slopes) meets a border from inside;
/// infinite if it meets none. Finds paths that leave and come back within the step.
Exit find_exit(const Piece& piece, const GeodesicVector& x0, const GeodesicVector& x1, double h,
               const BorderSlack& slack);

/// Where inside a step a path turns so near to a border that the cubic of find_exit cannot tell whether it dips beyond:
/// the arc length of the cubic's extremum, 0 < s < h. `slope` is the state's derivative at the start: what the cubic
/// lacks of x'' there measures its error.
std::vector<Exit> doubtful_turns(const Piece& piece, const GeodesicVector& x0, const GeodesicVector& slope,
                                 const GeodesicVector& x1, double h, const BorderSlack& slack);

/// The range that the cubic with these ends and slopes sweeps over a step of size h.
Interval swept(double x0, double x1, double slope0, double slope1, double h);

/// The arc length, of either sign, from `x` to the border along the parabola; the smaller one if there are two, and
/// that of the linear path if the parabola does not reach the border.
double length_to_border(const Border& border, const GeodesicVector& x, const GeodesicVector& slope);

}  // namespace geovor
