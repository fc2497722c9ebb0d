// How a path runs through the chart of a pole: how far it may step there, and which parameters of the surface it has.
#pragma once

#include "geodesic/geodesic_equation.h"
#include "surface/pole_chart.h"

namespace geovor {

/// A path changes to the chart within this part of its radius, and back to the surface's own parameters beyond the
/// other.
inline constexpr double kEnterChart = 0.85;
inline constexpr double kLeaveChart = 0.95;

/// Whether the point S = r(p) of the surface is so near to the pole that a path goes on in the chart.
bool enters_chart(const PoleChart& chart, Uv p, const Xyz& S);

/// Whether a path on the chart goes on in the surface's own parameters.
bool leaves_chart(const PoleChart& chart, const GeodesicVector& x);

/// The longest step from the point S along the unit tangent T that does not reach the pole unseen; infinite for a path
/// that runs away from it.
double room_before_pole(const PoleChart& chart, const Xyz& S, const Xyz& T);

/// The longest step on the chart: to its border, and not past the point nearest to the pole.
double room_on_chart(const PoleChart& chart, const GeodesicVector& x);

/// The surface's parameters of the point `to` of the chart, at the end of a piece of a path that starts at the state x
/// with the surface's parameters `from`. The parameter along the collapsed side runs on over the seam. At the pole
/// itself it is that of the line on which the path comes in.
Uv unwound(const Surface& surface, const PoleChart& chart, const GeodesicVector& x, Uv from, const GeodesicVector& to);

/// Positive where a point of the chart of a side that is not closed (a pole at a patch's corner) lies beyond the ends
/// of the side; grows with the angle to them. Negative inside, and where the side is closed.
double beyond_wedge(const Surface& surface, const PoleChart& chart, Uv ab);

/// The direction in the surface's parameters of the unit tangent T at p. The part along the side grows without bound
/// towards the pole; at the pole itself it is zero.
UvVec direction_near_pole(const Surface& surface, const PoleChart& chart, Uv p, const Xyz& T);

}  // namespace geovor
