// One edge of the CAD, looked at along its length: what size it asks for where.
#pragma once

#include <vector>

#include "brep/model.h"
#include "delaunay/arc_length.h"
#include "delaunay/size_rule.h"
#include "delaunay/surface_probe.h"

namespace geovor {

/// One use of the edge by a face, and the rule of that face.
struct FaceUse {
  int face = -1;
  const Coedge* coedge = nullptr;
  const SurfaceProbe* probe = nullptr;  ///< null where the face has no surface
  const SizeRule* rule = nullptr;
};

/// Places at arc lengths that the curve's shape alone decides: equal steps, halved where the size changes fast.
struct EdgeStations {
  ArcLength way;
  std::vector<double> s;  ///< arc length from the start, ascending, both ends included
  std::vector<double> h;  ///< the size that the edge asks for there, graded by nothing yet
  std::vector<Xyz> x;     ///< the places themselves
  double turn = 0.0;      ///< of the tangent, in all, radians
};

/// `h` is the smallest of the sizes that the faces' rules give for the larger of two curvatures, the edge's and the
/// face's beside it. REQUIRES: an edge that is not degenerated and has a use.
EdgeStations look_along(const CadEdge& edge, const std::vector<FaceUse>& uses);

/// h, where it is below the size, lowered to the next of 512 steps an octave, far above the noise of second
/// derivatives: the same under every parameterization. Values that agree with the size to rounding are the size.
double in_steps(double h, double size);

}  // namespace geovor
