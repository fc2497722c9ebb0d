// What is known of the sizes on a face before its points are placed.
#pragma once

#include <limits>
#include <vector>

#include "delaunay/size_rule.h"
#include "delaunay/surface_triangulation.h"

namespace geovor {

/// The largest size that is nowhere above the rule's and grows by the gradation at most: h(x) = min over the places p
/// that are known of h(p) + gradation |x - p|. A front sees what lies behind it, not what lies before it: that it
/// learns here, from the border and from earlier points of the same face.
class SizeField {
 public:
  SizeField(const SizeRule& rule, const std::vector<MeshVertex>& border);

  /// At x on the face, where the rule asks for `wanted`.
  double at(const Xyz& x, double wanted) const;

  /// Looks at the points of a front, of which the first are those of the border. Returns whether some stand too near to
  /// others with a smaller size, so that the face should be filled anew.
  bool learn(const std::vector<MeshVertex>& points);
  /// The same within the triangles of a mesh, where the rule may ask for less than at their corners.
  bool learn(const SurfaceTriangulation& mesh);

 private:
  struct Source {
    Xyz x;
    double h;
  };
  /// A binary tree of the sources, in an array: node i has the children 2i + 1 and 2i + 2.
  struct Node {
    Xyz lower = Xyz::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
    double least = std::numeric_limits<double>::infinity();
    int begin = 0, end = 0;
  };

  void build();
  void build(size_t node, int begin, int end);
  void lower(size_t node, const Xyz& x, double& h) const;
  double bound(size_t node, const Xyz& x) const;

  SizeRule rule_;
  size_t border_points_;
  std::vector<Source> sources_;
  std::vector<Node> tree_;
};

}  // namespace geovor
