// Where the nearest generator changes along the border of a face: the ends there of the diagram's edges.
#pragma once

#include <vector>

#include "voronoi/bisector.h"
#include "voronoi/face_border.h"
#include "voronoi/nearby_sites.h"

namespace geovor {

/// At the place, on the way along the border with the face to the left, the nearest generator changes from `before` to
/// `after`; both rays end there and are equally long.
struct LabelChange {
  BorderPlace place;
  SiteRay before, after;
};

/// A stretch of the border on which no geodesic from any site was found to end: the shortest paths there leave the
/// surface's domain. Its ends are where geodesics are found again, to less than a hundredth of the cycle; the
/// sites are those that own the border there, -1 where the scan began or ended in the stretch.
struct UnseenStretch {
  BorderPlace from, to;
  int before = -1, after = -1;
};

struct BorderScan {
  std::vector<LabelChange> changes;
  std::vector<UnseenStretch> unseen;
};

/// All changes on one cycle, in order. The border is labelled at places so near to each other that of the generators
/// which could own a piece in between (d is 1-Lipschitz: those that are nearer than the nearest by twice the step) none
/// seems to, by values and slopes at both ends. A change that is missed all the same is found from inside the face
/// where the cell behind it has other edges.
BorderScan scan_border(const FaceBorder& border, int cycle, const SiteRays& rays, const NearbySites& sites);

}  // namespace geovor
