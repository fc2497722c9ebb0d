// The points on the edges of a CAD model: made once, used by every face at the edge, so that the mesh is watertight.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "brep/model.h"
#include "delaunay/edge_stations.h"
#include "delaunay/narrow_sizes.h"
#include "delaunay/size_rule.h"
#include "delaunay/surface_probe.h"

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

/// Places points on every edge at equal steps of the integral of ds / h(s), with h the smallest of the sizes that the
/// rules of the faces at the edge give for the larger of the curvatures of edge and face, graded over the whole net of
/// edges; where a face is narrow or has a sharp corner h follows its width (NarrowSizes). Where one face alone uses an
/// edge the points lie on its surface, elsewhere on the edge's space curve. An edge that no face uses gets none.
class BorderSampler {
 public:
  /// Runs body(0) … body(n-1) in any order, perhaps at once; the points do not depend on it.
  using ForEach = std::function<void(int n, const std::function<void(int)>& body)>;

  /// Looks along all edges. `rules[f]` is that of faces[f]; all have the same gradation. The model outlives it.
  BorderSampler(const CadModel& model, std::vector<SizeRule> rules, const ForEach& for_each);

  BorderSampler(const BorderSampler&) = delete;
  BorderSampler& operator=(const BorderSampler&) = delete;

  /// `finer[e]` >= 1 divides h on edge e.
  BorderPoints sample(const std::vector<double>& finer) const;

  /// The corners of faces that are sharper than 41 degrees.
  const std::vector<FaceCorner>& sharp_corners() const { return narrow_.corners(); }

 private:
  struct Sizes;
  Sizes graded_sizes(const std::vector<double>& finer) const;
  void look_across();

  const CadModel& model_;
  std::vector<SizeRule> rules_;
  ForEach for_each_;
  std::vector<std::optional<SurfaceProbe>> probes_;  // of the faces
  std::vector<std::vector<FaceUse>> uses_;           // of the edges
  std::vector<std::optional<EdgeStations>> stations_;
  NarrowSizes narrow_;
};

/// With one rule for all faces.
BorderPoints sample_border(const CadModel& model, const SizeRule& rule, const std::vector<double>& finer);

}  // namespace geovor
