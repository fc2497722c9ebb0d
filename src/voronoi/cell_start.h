// One point of the border of each cell: enough to reach the whole of it.
#pragma once

#include <optional>

#include "brep/face_domain.h"
#include "voronoi/bisector.h"
#include "voronoi/nearby_sites.h"

namespace geovor {

/// Where a ray of the site stops being a shortest path to any site.
struct CellStart {
  enum Kind {
    OnBisector,  ///< at a point between the site and another generator, which may be its own
    AtPoint,     ///< where all rays of the site meet again: its cut locus is this one point
    OffFace,     ///< outside the face, or where the surface can't be followed: the cell's border meets the face's
    NotFound,    ///< the search did not settle
  } kind = NotFound;
  BisectorPoint point;  ///< OnBisector, with the site to the left; AtPoint: both rays are the one that arrives
};

/// The cell of a site is a star: on every ray there is exactly one such point, and all of them form one closed curve in
/// the site's polar chart, so that any of them will do. The ray to the nearest other site is taken: half way on the
/// shortest path between the two no third is nearer.
CellStart start_of_cell(const FaceDomain& domain, const SiteRays& rays, const NearbySites& sites, int site);

}  // namespace geovor
