// Measurements on a mesh of a CAD model that use the CAD's surfaces and nothing of the mesher.
#pragma once

#include "brep/model.h"
#include "mesh/triangle_mesh.h"

namespace geovor::testing {

struct Fit {
  double worst_vertex = 0.0;    ///< largest distance from a mesh point to the surface of a face that uses it
  double worst_triangle = 0.0;  ///< largest distance from the middle of a triangle or of its edges to the surface
  double worst_bound = 0.0;     ///< largest ratio of such a distance to the bound of linear interpolation
  int inverted = 0;             ///< triangles whose normal makes more than a right angle with the face's
  int measured = 0;             ///< triangles looked at
};

/// Looks at every `stride`-th triangle.
Fit fit(const CadModel& model, const TriangleMesh& mesh, int stride);

/// The triangles of some faces, over the same points.
TriangleMesh part_of(const TriangleMesh& mesh, const std::vector<int>& face_numbers);

/// |Su x Sv| summed over a dense grid of each face's parameters, as far as it lies in the face: a second, cruder method
/// beside face_area, good to about 1e-3.
double area_by_dense_sum(const CadModel& model);

}  // namespace geovor::testing
