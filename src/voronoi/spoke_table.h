// The vertices of a diagram while it is being built, and which of their edges are still to be traced.
#pragma once

#include <optional>
#include <vector>

#include "voronoi/chain_tracer.h"
#include "voronoi/diagram.h"

namespace geovor {

/// A spoke of a vertex: see DiagramVertex.
struct SpokeRef {
  int vertex = -1;
  int spoke = -1;
};

/// Private to the room. Vertices with the rays of their generators; each spoke is open until an edge takes it.
class SpokeTable {
 public:
  /// `merge`: vertices with a pair of generators in common are one if they are nearer than this.
  SpokeTable(const FaceDomain& domain, const FaceBorder& border, double merge)
      : domain_(domain), border_(border), merge_(merge) {}

  /// Makes a vertex inside the face where these generators, counter-clockwise, have none yet.
  void ensure_inside(const std::vector<SiteRay>& generators);

  /// The spoke by which a chain arrives whose last point has these rays to its left and right. Makes the vertex where
  /// there is none yet. Nothing if the vertex has no such spoke.
  std::optional<SpokeRef> arrive_inside(const std::vector<SiteRay>& generators, const BisectorPoint& last);
  std::optional<SpokeRef> arrive_on_border(BorderPlace place, const BisectorPoint& last);
  SpokeRef arrive_at_free_end(const BisectorPoint& last);

  /// An edge that is to leave the border at this place.
  SpokeRef start_on_border(BorderPlace place, const BisectorPoint& first);

  /// The start of the edge that leaves by the spoke.
  BisectorPoint departure(SpokeRef s) const;

  bool taken(SpokeRef s) const { return vertices_[s.vertex].data.spokes[s.spoke].edge >= 0; }
  void take(SpokeRef s, Spoke by) { vertices_[s.vertex].data.spokes[s.spoke] = by; }

  int count() const { return static_cast<int>(vertices_.size()); }
  const DiagramVertex& vertex(int i) const { return vertices_[i].data; }

 private:
  struct Vertex {
    DiagramVertex data;
    std::vector<SiteRay> rays;
  };
  int add(const std::vector<SiteRay>& rays, int spokes);
  std::optional<int> spoke_between(const Vertex& vertex, const SiteRay& right, const SiteRay& left) const;
  std::optional<SpokeRef> extend_border_vertex(int vertex, const BisectorPoint& outwards);

  const FaceDomain& domain_;
  const FaceBorder& border_;
  double merge_;
  std::vector<Vertex> vertices_;
};

}  // namespace geovor
