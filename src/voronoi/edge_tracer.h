// Follows a bisector from a point of it to where it stops being an edge of the diagram.
#pragma once

#include <optional>
#include <vector>

#include "voronoi/edge_on_border.h"
#include "voronoi/near_ties.h"
#include "voronoi/nearby_sites.h"

namespace geovor {

enum class TraceEnd {
  Vertex,   ///< another generator is as near: `generators`
  Border,   ///< the face ends: `place`
  Closed,   ///< back at the start
  FreeEnd,  ///< a cut locus ends in a conjugate point of its site, or a tip: both rays of the last point are one
  Stuck,    ///< the bisector can't be followed any further
};

/// An edge, or a piece of one from the start that was given. Every point fulfils kBisectorTolerance; there are few.
struct TracedEdge {
  std::vector<BisectorPoint> points;  ///< from the start to the end, both included
  TraceEnd end = TraceEnd::Stuck;
  std::vector<SiteRay> generators;  ///< Vertex, Border: as near to kTieWindow, counter-clockwise (sort_around)
  BorderPlace place;                ///< Border
};

/// Predictor and corrector along M(p,q): the system (13) in the half-angle form of bisector_slope() proposes a point, a
/// Newton step puts it on the bisector, and the empty-ball test (NearbySites) says whether it is an edge's: no
/// generator may be nearer to a point of an edge than its two own, nor to a vertex than its three. A generator that is
/// cuts the edge before; the vertex with it is solved and tested in turn. Where sites are dense the next vertex is
/// foreseen from the plane's geometry, so that an edge costs little more than its end.
///
/// Does not promise to notice a generator that is nearer only between two points that were tested: what then fits
/// together nowhere is found by the builder, and by the certificate.
class EdgeTracer {
 public:
  /// All outlive the tracer. `sag`: how far a chord may lie from the edge where the border of the face is near.
  EdgeTracer(const FaceBorder& border, const SiteRays& rays, const NearbySites& sites, double sag)
      : rays_(rays), sites_(sites), on_border_(border, rays, sag) {}

  /// Walks in the direction of start.tangent(). `on_border`: the start lies on the face's border and the walk goes in.
  TracedEdge trace(const BisectorPoint& start, bool on_border) const;

 private:
  struct Walk;
  struct Vertex {
    std::vector<SiteRay> generators;
    BisectorPoint point;  ///< the rays of the edge's own two generators
  };
  enum class Step { Going, Ended, Failed };
  Step advance(Walk& walk) const;
  Step take_vertex(Walk& walk, const Vertex& vertex) const;
  Step take_point(Walk& walk, const BisectorPoint& next) const;
  bool end_on_border(Walk& walk, double h, const EdgeOnBorder::Crossing& crossing) const;
  bool close(Walk& walk, double h) const;
  bool end_freely(Walk& walk) const;
  bool end_in_tip(Walk& walk, double reach) const;
  double longest_step(const BisectorPoint& m) const;
  std::optional<BisectorPoint> predict(const Walk& walk, double h) const;
  std::optional<Vertex> foreseen_vertex(const BisectorPoint& from, double reach) const;
  std::optional<Vertex> find_vertex(const BisectorPoint& from, const BisectorPoint& guess, SiteRay rival,
                                    double reach) const;

  const SiteRays& rays_;
  const NearbySites& sites_;
  EdgeOnBorder on_border_;
};

}  // namespace geovor
