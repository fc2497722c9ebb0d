// The points of a face that lie far from the sites of a diagram: where the next sites go. Private to the room.
#pragma once

#include <optional>
#include <vector>

#include "voronoi/border_distance.h"
#include "voronoi/diagram.h"
#include "voronoi/nearby_sites.h"
#include "voronoi/site_ray.h"

namespace geovor {

/// A point of the face. Its `reach` is its distance to the sites, or, where that is less, twice its distance to the
/// border; where no point thereabouts is as far from the border, the distance to the sites alone.
struct FarPoint {
  Uv uv;
  Xyz x;
  double reach = 0.0;
};

/// All points of the face (up to the few that a narrow face hides) at which the reach may be largest, found from the
/// diagram's vertices, edges and stretches of border, each to 1e-9 of its distance or better (as exact as the diagram
/// and the border are), the same for every parameterization. In order of falling reach; reaches that agree to
/// kSameReach count as equal, and are put in order by the places in space.
class FarPoints {
 public:
  /// REQUIRES: all arguments outlive the object; `tie` is any direction that is none of the shape's own: where a whole
  /// line is equally far, its extreme point in that direction is taken.
  FarPoints(const SiteRays& rays, const VoronoiDiagram& diagram, const BorderDistance& border, const Xyz& tie);

  const std::vector<FarPoint>& points() const { return points_; }

  static constexpr double kSameReach = 1e-6;

 private:
  void add(Uv uv, const Xyz& x, double distance);
  void add_vertices();
  void add_edge_tops(const DiagramEdge& e);
  void add_edge_near_border(const DiagramEdge& e, bool from_end);
  void add_middle(const DiagramEdge& e);
  void add_stretch(const DiagramCell& cell, const CellPiece& piece);
  void add_top(BorderPlace from, BorderPlace to, const SiteRay& between, const SiteRay& at_to);
  void add_behind_border(const SiteRay& ray);
  /// For the ray to a place on the border: where, on its way back, the face ends at a hole; zero where it leads to the
  /// site through the face. Nothing where the ray comes to the border from outside.
  std::optional<double> behind_hole(const SiteRay& ray) const;
  bool is_shortest(const SiteRay& ray);
  void add_opposite_point();
  void put_in_order();
  std::vector<BorderPlace> stretch_places(const CellPiece& piece) const;
  std::vector<std::optional<SiteRay>> stretch_rays(int site, const CellPiece& piece,
                                                   const std::vector<BorderPlace>& places) const;

  const SiteRays& rays_;
  const VoronoiDiagram& diagram_;
  const BorderDistance& border_;
  Xyz tie_;
  std::optional<NearbySites> nearby_;  ///< made when first needed
  std::vector<FarPoint> points_;
};

}  // namespace geovor
