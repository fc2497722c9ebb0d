// The points on the edges of a CAD model: made once, used by every face at the edge, so that the mesh is watertight.
#pragma once

#include <vector>

#include "brep/model.h"
#include "delaunay/size_rule.h"

namespace geovor {

/// The border points of a model. A point has one number for the whole model.
struct BorderPoints {
  std::vector<Xyz> points;
  std::vector<double> size;  ///< the size wanted at the point

  /// An edge's points from range.lo to range.hi, both ends included, and their parameters on the edge's curve.
  struct Edge {
    std::vector<int> points;
    std::vector<double> t;
  };
  std::vector<Edge> edges;  ///< as CadModel::edges; a degenerated edge has its vertex alone
};

/// Places points on every edge at equal steps of the integral of ds / h(s), with h the rule's size for the larger of
/// the curvatures of the edge and of the faces at it, graded over the whole net of edges. `finer[e]` >= 1 divides h on
/// edge e. Where one face alone uses an edge the points lie on its surface, elsewhere on the edge's space curve.
BorderPoints sample_border(const CadModel& model, const SizeRule& rule, const std::vector<double>& finer);

}  // namespace geovor
