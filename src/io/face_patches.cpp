#include "io/face_patches.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace geovor {

const FacePatch& FacePatches::patch(const FaceGroup& group) {
  patch_.points.clear(), patch_.normals.clear(), patch_.triangles.clear(), sums_.clear();
  for (const int t : group.triangles) {
    const std::array<int, 3>& corners = mesh_.triangles[t];
    const Xyz& p = mesh_.points[corners[0]];
    const Xyz normal = (mesh_.points[corners[1]] - p).cross(mesh_.points[corners[2]] - p);
    std::array<std::uint32_t, 3> local{};
    for (int k = 0; k < 3; ++k) {
      int& place = place_[corners[k]];
      if (place < 0) {
        place = static_cast<int>(patch_.points.size());
        patch_.points.push_back(corners[k]);
        sums_.push_back(Xyz::Zero());
      }
      sums_[place] += normal;
      local[k] = static_cast<std::uint32_t>(place);
    }
    patch_.triangles.push_back(local);
  }
  for (const Xyz& sum : sums_) {
    const Xyz unit = sum.isZero(0.0) ? Xyz(Xyz::UnitZ()) : sum.stableNormalized();
    patch_.normals.emplace_back(unit.cast<float>());
  }
  for (const int p : patch_.points) place_[p] = -1;
  return patch_;
}

MeshFrame::MeshFrame(const TriangleMesh& mesh) {
  Xyz lower = Xyz::Constant(std::numeric_limits<double>::max()), upper = -lower;
  for (const auto& corners : mesh.triangles) {
    for (const int c : corners) lower = lower.cwiseMin(mesh.points[c]), upper = upper.cwiseMax(mesh.points[c]);
  }
  if (mesh.triangles.empty()) return;
  // Halves first: the sum of two large coordinates may overflow.
  middle = 0.5 * lower + 0.5 * upper;
  size = std::max((0.5 * upper - 0.5 * lower).stableNorm(), std::numeric_limits<double>::min());
}

}  // namespace geovor
