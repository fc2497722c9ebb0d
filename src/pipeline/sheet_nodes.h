// The places of a face's outline where edges of a diagram end, in their order along it.
#pragma once

#include <map>
#include <vector>

#include "brep/model.h"
#include "pipeline/edge_runs.h"
#include "pipeline/face_outline.h"
#include "pipeline/merged_sets.h"

namespace geovor {

/// Vertices, of which several may turn out to be one.
class MergedVertices {
 public:
  int add(const Xyz& x);
  void merge(int a, int b) { sets_.merge(a, b); }
  int find(int a) const { return sets_.find(a); }
  const Xyz& at(int a) const { return points_[find(a)]; }
  int count() const { return static_cast<int>(points_.size()); }

 private:
  std::vector<Xyz> points_;
  MergedSets sets_;
};

/// A node is a place of the outline in the parameter plane; a vertex is a place in space. The two sides of a seam have
/// a node each for one vertex, and a pole has many.
class SheetNodes {
 public:
  /// Places nearer than `merge` in space are one, unless a pole lies between them.
  SheetNodes(const CadModel& model, const FaceOutline& outline, double merge);

  /// A vertex of the diagram, made when first asked for.
  int diagram_vertex(int index, const Xyz& x);
  /// A place on a side; `vertex`: -1 makes a new one. To be followed by settle().
  void add_place(int side, double t, int vertex);
  void settle();

  /// The parameters of the nodes of a side, ascending, both ends included.
  const std::vector<double>& places(int side) const { return places_[key(side)]; }
  int node(int side, double t) const;
  /// The node at places(side)[k]; nodes count from 0 to count() - 1.
  int node_at(int side, int k) const;
  int count() const { return node_count_; }
  int vertex_of(int node) const { return vertices_.find(node_vertex_[node]); }
  MergedVertices& vertices() { return vertices_; }
  const MergedVertices& vertices() const { return vertices_; }

 private:
  struct Place {
    double t;
    int vertex;
  };
  int key(int side) const;  ///< the same for both sides of a seam

  const FaceOutline& outline_;
  double merge_;
  MergedVertices vertices_;
  std::map<int, int> of_diagram_;
  std::vector<std::vector<Place>> raw_;      ///< by key
  std::vector<std::vector<double>> places_;  ///< by key
  std::vector<std::vector<int>> place_vertex_;
  std::vector<int> first_node_;  ///< of a side
  std::vector<int> node_vertex_;
  int node_count_ = 0;
};

}  // namespace geovor
