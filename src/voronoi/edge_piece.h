// A piece of an edge, from one of its points to another a step away.
#pragma once

#include <optional>

#include "voronoi/bisector.h"

namespace geovor {

/// The distance of the two points in space.
double chord(const BisectorPoint& a, const BisectorPoint& b);

/// The angle between the edge's directions at both, in [0, pi].
double turn(const BisectorPoint& a, const BisectorPoint& b);

/// How far the chord is from the edge: that of a circle. None at a free end, where the edge has no direction.
double sag_of(const BisectorPoint& a, const BisectorPoint& b);

/// Whether the rays at b are those of a, moved: between the two the angles change by what system (13) says at both.
bool goes_on(const BisectorPoint& a, const BisectorPoint& b);

/// The point of the edge half way between the two; nothing where Newton's method does not settle between them.
std::optional<BisectorPoint> halfway(const SiteRays& rays, const BisectorPoint& a, const BisectorPoint& b);

}  // namespace geovor
