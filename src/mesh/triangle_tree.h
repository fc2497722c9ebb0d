// The point of a triangle mesh nearest to a point of space.
#pragma once

#include "mesh/nearest_boxes.h"
#include "mesh/triangle_mesh.h"

namespace geovor {

/// The point of the triangle a b c (which may be a segment or a point) nearest to x.
Xyz nearest_on_triangle(const Xyz& a, const Xyz& b, const Xyz& c, const Xyz& x);

class TriangleTree {
 public:
  /// The mesh must outlive the tree. REQUIRES: indices in range (first_fault).
  explicit TriangleTree(const TriangleMesh& mesh);

  struct Nearest {
    int triangle = -1;  ///< -1: the mesh has none
    Xyz foot = Xyz::Zero();
    double distance = 0.0;
  };
  Nearest nearest(const Xyz& x) const;

 private:
  const TriangleMesh& mesh_;
  NearestBoxes boxes_;
};

}  // namespace geovor
