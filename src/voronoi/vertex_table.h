// The vertices of a diagram while it is being built, and which of their edges are still to be traced.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "voronoi/bisector.h"
#include "voronoi/diagram.h"
#include "voronoi/face_border.h"

namespace geovor {

/// A spoke of a vertex: see DiagramVertex.
struct SpokeRef {
  int vertex = -1;
  int spoke = -1;
  bool operator==(const SpokeRef& other) const { return vertex == other.vertex && spoke == other.spoke; }
  bool operator<(const SpokeRef& other) const {
    return vertex != other.vertex ? vertex < other.vertex : spoke < other.spoke;
  }
};

/// Private to the room. Vertices with the rays of their generators; each spoke is open until an edge takes it.
class VertexTable {
 public:
  /// `merge`: edges that arrive at places nearer to each other than this, between the same generators and from the same
  /// side, have the same vertex; model units.
  VertexTable(const FaceDomain& domain, double merge) : domain_(domain), merge_(merge) {}

  /// The open or taken spoke by which an edge arrives whose last point has these rays to its left and right.
  std::optional<SpokeRef> arriving(const BisectorPoint& last) const;

  /// The number of the vertex inside the face with these generators, counter-clockwise; a new one if there is none yet.
  int put_inside(const std::vector<SiteRay>& generators);

  /// The same for a vertex on the border, whose spokes lead into the face: one between each two that follow each other.
  int put_on_border(BorderPlace place, const std::vector<SiteRay>& generators);

  /// The spoke of a vertex between two generators that are neighbours there, as seen from it.
  std::optional<SpokeRef> spoke_between(int vertex, const SiteRay& right, const SiteRay& left) const;

  SpokeRef arrive_at_free_end(const BisectorPoint& last);

  /// A cut locus that is one point: a vertex without edges.
  void add_point(const SiteRay& ray) { add({ray}, 0); }

  /// The start of the edge that leaves by the spoke.
  BisectorPoint departure(SpokeRef s) const;

  Spoke holder(SpokeRef s) const { return vertices_[s.vertex].data.spokes[s.spoke]; }
  bool taken(SpokeRef s) const { return holder(s).edge >= 0; }
  void take(SpokeRef s, Spoke by) { vertices_[s.vertex].data.spokes[s.spoke] = by; }
  void release(SpokeRef s) { take(s, {}); }

  int count() const { return static_cast<int>(vertices_.size()); }
  const DiagramVertex& vertex(int i) const { return vertices_[i].data; }

 private:
  struct Vertex {
    DiagramVertex data;
    std::vector<SiteRay> rays;
  };
  using Cell = std::array<long, 3>;
  int add(const std::vector<SiteRay>& rays, int spokes);
  Cell cell_of(const Xyz& x) const;
  std::vector<int> near(const Xyz& x) const;
  std::optional<int> find(const std::vector<SiteRay>& generators, bool on_border) const;

  const FaceDomain& domain_;
  double merge_;
  std::vector<Vertex> vertices_;
  std::map<Cell, std::vector<int>> cells_;  ///< of width merge_
};

}  // namespace geovor
