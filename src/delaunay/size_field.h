// What is known of the sizes on a face before its points are placed.
#pragma once

#include <limits>
#include <vector>

#include "delaunay/size_rule.h"
#include "delaunay/surface_triangulation.h"

namespace geovor {

/// The largest size that is nowhere above the rule's and grows by the gradation at most: h(x) = min over the places p
/// that are known of h(p) + gradation |x - p|. A front sees what lies behind it, not what lies before it: that it
/// learns here, from an earlier mesh of the same face.
class SizeField {
 public:
  explicit SizeField(const SizeRule& rule) : rule_(rule) {}

  /// At x on the face, where the rule asks for `wanted`.
  double at(const Xyz& x, double wanted) const;

  /// Looks at a mesh: what the rule asks for at its vertices and within its triangles. Returns whether it is too coarse
  /// somewhere, so that another one should be made.
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

  void build(size_t node, int begin, int end);
  void lower(size_t node, const Xyz& x, double& h) const;
  double bound(size_t node, const Xyz& x) const;

  SizeRule rule_;
  std::vector<Source> sources_;
  std::vector<Node> tree_;
};

}  // namespace geovor
