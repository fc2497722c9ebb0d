// Geodesics by a second method of other make, over 113 bits: the equation in Hamilton's form, with momenta instead of
// velocities and without Christoffel symbols, by Gragg-Bulirsch-Stoer extrapolation, in steps that end on knot lines.
#pragma once

#include "geodesic/trace.h"
#include "support/quad_surfaces.h"

namespace geovor::testing {

struct QuadEnd {
  Float128 u, v;
  QuadVec x, tangent;  ///< in space; the tangent is of unit length
  QuadVec across;      ///< the unit normal to the path in the surface, to its left
  Float128 y, dy;      ///< the Jacobi field. Not carried over creases: see neighbours_spread
  int lines_crossed = 0;
};

/// The geodesic that leaves `start` along `direction` (of any length). On a crease it goes on with the same tangential
/// momentum, as a shortest path does. A start on a knot line belongs to the piece that `direction` points into.
QuadEnd quad_geodesic(const QuadSurface& surface, Uv start, UvVec direction, const Float128& length);
QuadEnd quad_geodesic(const QuadSurface& surface, const std::array<Float128, 2>& start,
                      const std::array<Float128, 2>& direction, const Float128& length);

/// The Jacobi field by its meaning: how fast geodesics from `start` spread with the angle, by differences (to 1e-20).
Float128 neighbours_spread(const QuadSurface& surface, Uv start, UvVec direction, const Float128& length);

/// The jet of the piece that holds p.
QuadJet quad_jet(const QuadSurface& surface, Uv p);

/// How far a result of trace_geodesic is from the truth.
struct TraceErrors {
  double place;      ///< in space
  double direction;  ///< of the unit tangents
  double y;
};
TraceErrors errors_of(const QuadSurface& surface, const QuadEnd& truth, const GeodesicState& state);

}  // namespace geovor::testing
