// A vertex of a triangulation that lives on a surface.
#pragma once

#include <optional>
#include <vector>

#include "base/uv.h"
#include "base/xyz.h"
#include "surface/surface.h"

namespace geovor {

/// A point of the surface with all the parameters it has: two on a seam, a whole line of them at a pole.
struct MeshVertex {
  Xyz x;
  Xyz n;            ///< unit normal
  double h = 0.0;   ///< the edge length wanted here
  int border = -1;  ///< number among BorderPoints, -1 inside the face
  std::vector<Uv> uv;
  bool free_u = false;  ///< a pole: any u names this point
  bool free_v = false;

  bool regular() const { return !free_u && !free_v && uv.size() == 1; }
};

/// The parameters of `vertex` that lie nearest to `reference` (a pole: at its u), counting copies by whole periods.
/// `weight` scales the two parameters to lengths.
Uv parameters_near(const MeshVertex& vertex, const Surface& surface, Uv reference, UvVec weight);

/// The length of the geodesic between two near vertices, from their chord and normals: a cubic through both, exact to
/// the fifth order of the chord.
double geodesic_estimate(const MeshVertex& a, const MeshVertex& b);

/// Whether the triangle faces the side of its corners' normals.
bool upright(const MeshVertex& a, const MeshVertex& b, const MeshVertex& c);

}  // namespace geovor
