// The end of a geodesic from a site, traced anew from nothing but its polar coordinates: what a finished diagram is
// checked and measured with.
#pragma once

#include "geodesic/connect.h"
#include "geodesic/curvature_map.h"
#include "surface/surface.h"

namespace geovor {

/// O_site(s,t) with its frame. In polar coordinates the element of area is y ds dt, so that `sector` is the area under
/// the ray for each radian.
struct RayEnd {
  bool found = false;  ///< the geodesic could be followed all the way
  Polar polar;
  Xyz x = Xyz::Zero();  ///< the end in space
  Xyz T = Xyz::Zero();  ///< unit tangent there, pointing on
  Xyz N = Xyz::Zero();  ///< n x T: where x moves as polar.t grows
  double y = 0.0;       ///< Jacobi field there
  double dy = 1.0;      ///< its derivative in s
  double sector = 0.0;  ///< integral of y from the site to the end, to about 1e-9 of it; NaN where it was not asked for
};

enum class RayParts { EndAlone, WithSector };

/// Beyond the surface's domain the outermost piece is continued. The ray is traced in legs as `curvature` tells
/// them.
RayEnd trace_ray(const Surface& surface, Uv site, Polar to, const CurvatureMap& curvature,
                 RayParts parts = RayParts::EndAlone);

/// Of the trace, relative to the length: with what an integrator may add to it, and on two sides, still well below the
/// 1e-12 that diagrams are held to.
inline constexpr double kRetraceTolerance = 2e-14;

/// The distance from the ray's site to a place of space next to the ray's end. The error is of the second order in what
/// lies between the two.
inline double distance_beside(const RayEnd& ray, const Xyz& place) { return ray.polar.s + ray.T.dot(place - ray.x); }

}  // namespace geovor
