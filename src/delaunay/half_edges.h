// The combinatorial side of a triangulation: who is next to whom, and the moves that change it. No coordinates.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace geovor {

/// An oriented triangulated surface, with or without border, as half-edges. Triangle t owns the half-edges 3t, 3t+1 and
/// 3t+2, in counter-clockwise order; half-edge e runs from origin(e) to target(e) with its triangle on the left.
/// Removed triangles stay as holes in the numbering until compact().
///
/// Promises: every move keeps the laws that first_fault() checks. Does not promise that two vertices share one edge at
/// most; the moves that could make a second one say so.
class HalfEdges {
 public:
  static constexpr int kNone = -1;

  HalfEdges() = default;
  /// REQUIRES: a directed edge occurs at most once in `triangles`.
  HalfEdges(int vertices, const std::vector<std::array<int, 3>>& triangles);

  int vertex_count() const { return static_cast<int>(out_.size()); }
  int triangle_count() const { return static_cast<int>(origin_.size() / 3); }
  bool alive(int t) const { return origin_[3 * t] != kNone; }

  static int triangle(int e) { return e / 3; }
  static int next(int e) { return e % 3 == 2 ? e - 2 : e + 1; }
  static int prev(int e) { return e % 3 == 0 ? e + 2 : e - 1; }
  int origin(int e) const { return origin_[e]; }
  int target(int e) const { return origin_[next(e)]; }
  int apex(int e) const { return origin_[prev(e)]; }
  /// The same edge seen from the other triangle; kNone on the border.
  int twin(int e) const { return twin_[e]; }
  std::array<int, 3> corners(int t) const { return {origin_[3 * t], origin_[3 * t + 1], origin_[3 * t + 2]}; }

  /// A fixed edge is never flipped or collapsed: the border, a crease, a CAD edge.
  bool fixed(int e) const { return fixed_[e] || twin_[e] == kNone; }
  void set_fixed(int e);

  /// Some half-edge that leaves v; kNone for a vertex without triangles.
  int outgoing(int v) const { return out_[v]; }
  /// The half-edges that leave v, counter-clockwise; on a border vertex from the first to the last.
  std::vector<int> star(int v) const;
  bool on_border(int v) const;
  /// The half-edge from a to b, or kNone.
  int find(int a, int b) const;

  int add_vertex();
  /// Turns the edge inside its two triangles. Afterwards e runs from the old apex of its twin to the old apex of e.
  /// REQUIRES: not fixed(e). May make a second edge between two vertices: see find().
  void flip(int e);
  /// Puts v into triangle t. The three triangles around v are t and two new ones.
  void split_triangle(int t, int v);
  /// Puts v on the edge e. Both halves keep e's fixedness.
  void split_edge(int e, int v);
  /// Whether collapse(e) keeps the surface a surface: origin(e) is inside, not the end of a fixed edge, and the two
  /// ends of e have no common neighbour but the two apexes.
  bool can_collapse(int e) const;
  /// Removes origin(e) by moving it into target(e). REQUIRES: can_collapse(e).
  void collapse(int e);

  /// Sews two border half-edges together. REQUIRES: both on the border, with each other's ends.
  void sew(int e, int f);

  /// Renumbers the triangles without holes, in their old order. Vertices keep their numbers.
  void compact();

  /// The first law that is broken, with its numbers; nothing if all hold.
  std::optional<std::string> first_fault() const;

 private:
  void set_triangle(int t, int a, int b, int c);
  void link(int e, int f);
  int add_triangle();

  std::vector<int> origin_;
  std::vector<int> twin_;
  std::vector<char> fixed_;
  std::vector<int> out_;
};

}  // namespace geovor
