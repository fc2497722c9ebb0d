// A stretch of the face's border as the site sees it to whose cell it belongs.
#pragma once

#include <vector>

#include "voronoi/diagram.h"
#include "voronoi/site_ray.h"

namespace geovor {

struct BorderView {
  struct Place {
    Uv uv;
    Polar polar;  ///< of the ray from the site, to kRoughly
    double y = 0.0;
  };
  std::vector<Place> places;  ///< of the piece's polyline, in order; where the site itself lies on it there is none
  bool complete = true;       ///< false: to some place no ray was found
};

/// The rays to the points of piece.border_uv, each carried on from the one before: from the vertex at the start or,
/// around a whole cycle, from the shortest one.
BorderView view_of_border(const SiteRays& rays, const VoronoiDiagram& diagram, int site, const CellPiece& piece);

/// A run of places on the back of a piece of border: it turns away from the site, so that the site's rays reach it from
/// beyond the face. [first, last] are indices into the view's places.
struct HiddenRun {
  int first = 0, last = 0;
};

/// The runs along which the angle falls, each by more than `width` to the side, seen from the site. Around a whole
/// cycle the first place must not lie on a back: see begin_in_front().
std::vector<HiddenRun> hidden_runs(const BorderView& view, double width);

/// Turns the view of a whole cycle round so that it begins where the border faces the site, if it does anywhere.
void begin_in_front(BorderView& view);

}  // namespace geovor
