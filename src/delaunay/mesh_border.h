// The border of a face as its mesh sees it: closed rows of points with the face on their left. Seams are no border.
#pragma once

#include <string>
#include <vector>

#include "brep/model.h"
#include "delaunay/border.h"
#include "delaunay/mesh_vertex.h"
#include "delaunay/surface_probe.h"

namespace geovor {

/// A sphere has none, a tube has two circles: where a face meets itself smoothly, and at a smooth pole, nothing ends. A
/// place that the border passes more than once, such as one on a crease at which the face meets itself, is one point
/// each time.
struct MeshBorder {
  /// Empty, or why there is no such border.
  std::string why;
  std::vector<MeshVertex> points;
  std::vector<int> next, before;  ///< along the border, numbers in `points`; -1 for a tip, which stands alone
  std::vector<char> is_tip;       ///< the surface has no tangent plane there; the normal is a mean
  std::vector<char> is_one_of_many;

  bool on_border(int i) const { return i < static_cast<int>(points.size()) && next[i] >= 0; }
  /// Whether x, near by, is on the side of border point i on which the face is.
  bool sees(int i, const Xyz& x) const;
};

MeshBorder mesh_border(const CadFace& face, const SurfaceProbe& probe, const BorderPoints& border);

}  // namespace geovor
