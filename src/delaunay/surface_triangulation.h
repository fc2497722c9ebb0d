// A triangulation that lives on a surface: its edges are geodesics, and every question about it is answered by lengths,
// angles and normals, never by the parameter plane.
#pragma once

#include <optional>
#include <vector>

#include "delaunay/half_edges.h"
#include "delaunay/mesh_vertex.h"
#include "delaunay/place_order.h"
#include "delaunay/size_rule.h"
#include "delaunay/surface_probe.h"

namespace geovor {

class SurfaceTriangulation {
 public:
  SurfaceTriangulation(HalfEdges triangles, std::vector<MeshVertex> vertices, const SurfaceProbe& probe,
                       const SizeRule& rule);

  /// Renumbers the triangles without the holes that removals left.
  void compact() { mesh_.compact(); }

  const HalfEdges& topology() const { return mesh_; }
  const std::vector<MeshVertex>& vertices() const { return vertices_; }
  const MeshVertex& vertex(int v) const { return vertices_[v]; }
  const SizeRule& rule() const { return rule_; }
  const SurfaceProbe& probe() const { return probe_; }

  /// The length of the geodesic between two near vertices, by solving the geodesic equation. Falls back on
  /// geodesic_estimate, and counts that, where the solver does not settle (a pole at both ends, a folded map).
  double geodesic_length(int a, int b) const;
  int estimates_used() const { return estimates_used_; }

  /// Whether close decisions are made with geodesic lengths (the default) or, while most vertices are still to be
  /// replaced, with estimates.
  void decide_by_geodesics(bool yes) { decide_by_geodesics_ = yes; }

  /// Radius of the circle through the three corners.
  double circumradius(int t) const;
  Xyz circumcentre(int t) const;

  /// Whether the edge may stay: fixed, or the angles that face it sum to at most pi, measured with geodesic lengths (or
  /// the other diagonal is no better, which happens across creases alone). Of two that are equally good the one at the
  /// corner that comes first in space.
  bool is_delaunay(int e) const;
  /// Flips edges, beginning with `edges`, until every one that may be flipped is_delaunay.
  void flip_to_delaunay(std::vector<int> edges);
  void flip_all();

  /// The triangle below the point, walking over the surface from triangle t; kNone where a fixed edge stops the way.
  int locate(const Xyz& point, int t) const;
  /// The point of the surface nearest to `point`, which lies near triangle t; nothing where there is none close by.
  std::optional<MeshVertex> drop(const Xyz& point, int t) const;
  /// The same for a point near an inner vertex, from the vertex' own parameters; its size is that of the vertex.
  std::optional<MeshVertex> drop_from(int v, const Xyz& point) const;
  /// The same without a limit on its distance and without a size: for measuring.
  std::optional<SurfaceSample> foot(const Xyz& point, int t) const;
  /// Somewhere in the middle of the triangle, where the surface is looked at cheaply.
  std::optional<SurfaceSample> middle(int t) const;
  /// Puts the vertex into triangle t, or on its edge where it lies there, and restores the Delaunay property around it.
  /// Nothing is done, and false returned, where a triangle would turn over.
  bool insert(const MeshVertex& vertex, int t);
  /// Removes the origin of e by moving it into its target, likewise.
  bool collapse(int e);
  void set_size(int v, double h) { vertices_[v].h = h; }
  /// Moves an inner vertex, likewise; does not flip.
  bool move(int v, const MeshVertex& to);

 private:
  template <typename Length>
  static double facing_cotangents(int a, int b, int c, int d, const Length& length);
  Uv reference_parameters(int t, const Xyz& point) const;
  UvVec weight() const { return {probe_.u_speed(), probe_.v_speed()}; }
  bool flip_allowed(int e) const;

  HalfEdges mesh_;
  std::vector<MeshVertex> vertices_;
  const SurfaceProbe& probe_;
  const SizeRule& rule_;
  PlaceOrder order_;
  bool decide_by_geodesics_ = true;
  mutable int estimates_used_ = 0;
};

}  // namespace geovor
