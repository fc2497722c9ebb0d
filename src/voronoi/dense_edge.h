// The points of an edge between the few that were traced.
#pragma once

#include <vector>

#include "voronoi/bisector.h"
#include "voronoi/diagram.h"

namespace geovor {

/// The traced points with others between them, so many that no chord is farther from the edge than `sag`. An edge is
/// smooth where the surface is: between points that lie close enough it is the polynomial that has their places and
/// slopes (Hermite's interpolation over up to eight of them), which costs one evaluation of the surface a point. Where
/// the polynomials do not settle to kDensePoint, and on surfaces with knots, points come from correct_bisector(). uv
/// runs on over seams.
/// REQUIRES: at least two points, each a step of the tracer from the next
std::vector<EdgePoint> dense_edge(const SiteRays& rays, const std::vector<BisectorPoint>& traced, double sag);

/// What interpolation may miss an edge by, relative to its radius.
inline constexpr double kDensePoint = 5e-14;

}  // namespace geovor
