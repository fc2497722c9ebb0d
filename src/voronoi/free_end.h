// Where a cut locus ends: the conjugate point, or the tip, in which its two geodesics become one.
#pragma once

#include <optional>

#include "voronoi/site_ray.h"

namespace geovor {

/// The end of the cut locus of a site that runs between two rays of it which almost agree. Along the ray that the two
/// approach the first conjugate distance c(t) is least among its neighbours (a cusp of the conjugate locus: Myers,
/// Duke Math. J. 1 (1935) 376), and since dO/dt = y N vanishes there, an error e of the angle moves the point by e^3
/// only. The result has y = 0: its angle can't be told from its end, but its end is exact. Nothing where there is no
/// conjugate point within reach.
std::optional<SiteRay> free_end(const SiteRays& rays, const SiteRay& one, const SiteRay& other);

/// The same where the two rays meet in a tip: a cone's, or a side of the domain that is one point but no pole. Nothing
/// where there is none within `reach` of their end. A tip turns the directions about it by less than 2 pi, so that the
/// rays that pass it on both sides meet behind it: it is the end of a cut locus of every site that sees it. The result
/// has y = 0 as well: there is no direction in which the end moves with the angle.
std::optional<SiteRay> end_at_tip(const SiteRays& rays, const SiteRay& one, const SiteRay& other, double reach);

}  // namespace geovor
