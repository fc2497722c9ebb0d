// Distances between a mesh and the CAD, both ways, by samples; and the CAD face under each triangle.
#pragma once

#include <vector>

#include "mesh/triangle_mesh.h"
#include "pipeline/nearest_on_cad.h"

namespace geovor {

/// Distances from one shape to the other. Samples bound the true largest one from below; the place found by them is
/// then improved by a search around it.
struct DistanceFigures {
  double largest = 0.0, mean = 0.0, rms = 0.0;  ///< the last two over the area
  Xyz from = Xyz::Zero(), to = Xyz::Zero();     ///< ends of the largest
  int face = -1;                                ///< index into CadModel::faces, there
  int triangle = -1;                            ///< there
  long samples = 0;
};

/// What the CAD is beside each vertex and each triangle.
struct MeshOnCad {
  std::vector<CadPlace> vertices;  ///< nearest places; face -1 for points that no triangle uses
  std::vector<CadPlace> middles;   ///< of the triangles' centroids
  std::vector<double> largest;     ///< distance of a triangle's samples from the CAD
  DistanceFigures distance;        ///< of the mesh from the CAD
};

/// Samples: the vertices, points on the edges, and points inside the triangles, the centroid among them, about as far
/// apart as the triangles are large (closer in a mesh of few triangles). REQUIRES: some face can be used.
MeshOnCad measure_to_cad(const TriangleMesh& mesh, const NearestOnCad& cad, const NearestOnCad::ForEach& for_each);

/// From the CAD to the mesh: samples all over the faces and along their edges, at half that step. Beside the figures,
/// the largest distance of each face of the model.
struct CadOnMesh {
  DistanceFigures distance;
  std::vector<double> largest_of_face;
};
CadOnMesh measure_to_mesh(const TriangleMesh& mesh, const NearestOnCad& cad, const NearestOnCad::ForEach& for_each);

}  // namespace geovor
