// Steps along a surface, given as lengths in space, turned into steps of its parameters.
#pragma once

#include "base/interval.h"

namespace geovor {

/// How fast a line of one parameter, say u, runs: h = |Su|, and the derivatives of ln h by u itself (`own`) and by v
/// (`across`).
struct LineSpeed {
  double h = 0.0;
  double own = 0.0;
  double across = 0.0;
};

/// Where a step arrives, and which of its parts had to stop short of an end of the box that the speed falls to zero at.
struct Retraction {
  Uv uv;
  bool u_blocked = false;
  bool v_blocked = false;
};

/// p moved by the lengths `u_way` along Su/|Su| and `v_way` along Sv/|Sv|; right to first order, and where a parameter
/// degenerates, for steps beyond its reach too:
/// - Su falls to zero at an end of the box, as a power of the distance t from it. |Su| ~ t^(m-1) with
///   m - 1 = t d ln|Su| / dt makes the length from the end h t / m ~ t^m. That end is only approached, by kApproach of
///   the length at most, since on it nothing says which way to go on.
/// - |Su| falls to zero along v: at a pole, |Sv| / (d ln|Su| / dv) away in space. There the step is one in polar
///   coordinates.
/// Parameters stay inside the box; no step is more than a quarter of `turn`, the periods (infinite where there are
/// none).
inline constexpr double kApproach = 1e-3;
Retraction retract(Uv p, double u_way, double v_way, const LineSpeed& u, const LineSpeed& v, const UvBox& box,
                   UvVec turn);

/// How long the line is from x to the end of the box at which its speed falls to zero; infinite where it does at none.
double length_from_stop(double x, const LineSpeed& s, const Interval& box);

}  // namespace geovor
