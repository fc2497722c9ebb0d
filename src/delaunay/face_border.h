// The border of a face as its mesh sees it: closed rows of points with the face on their left. Seams are no border.
#pragma once

#include <string>
#include <vector>

#include "brep/model.h"
#include "delaunay/border.h"
#include "delaunay/mesh_vertex.h"
#include "delaunay/surface_probe.h"

namespace geovor {

/// A sphere has none, a tube has two circles: where a face meets itself smoothly, and at a smooth pole, nothing ends.
struct FaceBorder {
  /// Empty, or why the border is not of this kind: it passes a point twice, has a tip, or meets itself at a crease.
  std::string why;
  std::vector<MeshVertex> points;
  std::vector<int> next, before;  ///< along the border, numbers in `points`
};

FaceBorder face_border(const CadFace& face, const SurfaceProbe& probe, const BorderPoints& border);

}  // namespace geovor
