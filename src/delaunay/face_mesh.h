// One face, from its border points to its finished triangles.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "brep/model.h"
#include "delaunay/border.h"
#include "delaunay/size_rule.h"

namespace geovor {

struct FaceMesh {
  bool ok = false;
  std::string why;         ///< if not ok: what is wrong with the face
  std::vector<Xyz> inner;  ///< points inside the face
  /// Corners, counter-clockwise about Su x Sv: i >= 0 is border point i, i < 0 is inner[-1 - i].
  std::vector<std::array<int, 3>> triangles;
  int inverted = 0;               ///< triangles whose normal points against the surface's below their centroid
  int too_large = 0;              ///< triangles with an inner edge longer than 2.5 times the size wanted
  double largest_distance = 0.0;  ///< from the middles of triangles and edges to the surface
  int estimated_lengths = 0;      ///< geodesic lengths that had to be estimated
};

/// REQUIRES: face.surface != nullptr.
FaceMesh mesh_face(const CadFace& face, const BorderPoints& border, const SizeRule& rule);

/// The border points that stand in the way of a triangulation because they lie too far apart (the polygon through them
/// crosses itself); empty where there are none, or where finer points could not mend it.
std::vector<int> points_to_refine(const CadFace& face, const BorderPoints& border);

}  // namespace geovor
