#include "voronoi/lost_geodesics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/worst_of.h"

namespace geovor {
namespace {

/// The largest distance from the site to the border of its cell. Along the face's border it may grow from vertex to
/// vertex: no bound is given there.
double farthest_border(const VoronoiDiagram& d, const DiagramCell& cell) {
  double farthest = 0.0;
  if (cell.loops.empty()) return std::numeric_limits<double>::infinity();
  for (const auto& loop : cell.loops) {
    for (const CellPiece& piece : loop) {
      if (piece.edge < 0) return std::numeric_limits<double>::infinity();
      for (const EdgePoint& p : d.edges[piece.edge].points) farthest = larger_of(farthest, p.radius);
    }
  }
  return farthest;
}

}  // namespace

// A geodesic of a site that no query has seen is missing where it would be shortest: in what is now the site's cell or
// one beside it. (A site that has lost its neighbours with its geodesics has lost the shorter ones too.)
void warn_of_lost_geodesics(const NearbySites& sites, VoronoiDiagram& diagram) {
  std::vector<double> own, reach;
  for (const DiagramCell& cell : diagram.cells) own.push_back(farthest_border(diagram, cell));
  reach = own;
  for (const DiagramEdge& e : diagram.edges) {
    reach[e.left] = larger_of(reach[e.left], own[e.right]);
    reach[e.right] = larger_of(reach[e.right], own[e.left]);
  }
  for (std::size_t i = 0; i < reach.size(); ++i) {
    if (sites.complete_as_asked(static_cast<int>(i), reach[i])) continue;
    diagram.warnings.push_back({"unresolved",
                                {static_cast<int>(i)},
                                diagram.sites[i].uv,
                                "some geodesics from this site could not be followed: where they are shortest, cells "
                                "may lack a part"});
  }
}

void warn_of_what_has_no_measure(VoronoiDiagram& diagram) {
  const auto warn = [&](std::vector<int> sites, Uv uv, const char* text) {
    diagram.warnings.push_back({"unresolved", std::move(sites), uv, text});
  };
  for (const DiagramCell& cell : diagram.cells)
    if (!std::isfinite(cell.area))
      warn({cell.site}, diagram.sites[cell.site].uv, "the area of this cell could not be computed");
  for (const DiagramEdge& e : diagram.edges)
    if (!std::isfinite(e.residual))
      warn({e.left, e.right}, e.points.front().uv,
           "the distances to the edge that begins here could not be computed again");
  for (const DiagramVertex& v : diagram.vertices)
    if (!std::isfinite(v.residual)) warn(v.sites, v.uv, "the distances to this vertex could not be computed again");
}

}  // namespace geovor
