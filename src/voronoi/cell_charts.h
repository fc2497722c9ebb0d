// The cells of a finished diagram in the polar charts of their sites, from geodesics traced anew.
#pragma once

#include <optional>
#include <vector>

#include "brep/face_domain.h"
#include "geodesic/offset.h"
#include "voronoi/edge_walk.h"

namespace geovor {

/// A cell's border in the polar chart of its site, all loops together.
struct CellChart {
  bool found = false;              ///< every ray to its border could be followed
  double area = 0.0;               ///< integral of y ds dt over what the loops enclose; NaN unless found
  std::vector<double> loop_areas;  ///< of which it is the sum: negative where a loop goes around a hole
  double turn = 0.0;               ///< of the loops around the site, counter-clockwise, corners included
  double back = 0.0;               ///< largest step clockwise along an edge (see ChartPiece)
  double corner_gap = 0.0;         ///< largest jump of the ray where one piece follows another, relative to the radius
  double hidden = 0.0;             ///< widest part of the face's border that the cell has from behind (see ChartPiece)
  double least_y = 1.0;            ///< smallest y / radius along the border
  double nearest = 0.0;            ///< of the border's places that were looked at, to the site
  std::optional<ConjugatePoint> antipode;  ///< where all rays meet again: of the only site of a closed surface
  double conjugate_at = 0.0;  ///< on one ray to the border: first conjugate point, part of the radius; 0: none
};

struct DiagramCharts {
  std::vector<EdgeWalk> edges;
  std::vector<CellChart> cells;
};

/// Each ray is traced from its polar coordinates alone, once for each site that it belongs to. The cell of the only
/// site of a closed surface is taken as far as the rays' first conjugate points, which must be one point, less its
/// holes: where none of its loops goes around the site.
DiagramCharts chart_cells(const FaceDomain& domain, const VoronoiDiagram& diagram);

}  // namespace geovor
