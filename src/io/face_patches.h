// Each face's triangles over points of their own, with normals: what screens draw.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "io/face_groups.h"

namespace geovor {

struct FacePatch {
  std::vector<int> points;                              ///< of the mesh, in the order of their first use
  std::vector<Eigen::Vector3f> normals;                 ///< a point, of unit length
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< over `points`
};

/// Makes one patch after the other; only the last one needs memory.
class FacePatches {
 public:
  explicit FacePatches(const TriangleMesh& mesh) : mesh_(mesh), place_(mesh.points.size(), -1) {}

  /// The patch of a group: normals are the means of those of the triangles around, weighted by area, so that a face
  /// looks smooth and the edge between two faces sharp. Valid until the next call.
  const FacePatch& patch(const FaceGroup& group);

 private:
  const TriangleMesh& mesh_;
  std::vector<int> place_;  ///< of a point of the mesh in the patch; -1: not there
  std::vector<Xyz> sums_;
  FacePatch patch_;
};

/// The middle of the box around the triangles' corners, and half its diagonal (never 0): single precision is enough for
/// places relative to these.
struct MeshFrame {
  explicit MeshFrame(const TriangleMesh& mesh);
  Xyz middle = Xyz::Zero();
  double size = 1.0;
};

}  // namespace geovor
