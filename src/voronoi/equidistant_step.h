// The linear step that the correctors of bisector points and Voronoi vertices share. Private to the room.
#pragma once

#include <Eigen/LU>
#include <array>

#include "voronoi/site_ray.h"

namespace geovor {

/// Where three conditions put the point: space point m and common radius.
struct EquidistantTarget {
  Xyz m;
  double radius = 0.0;
  bool solvable = false;
};

/// Linear conditions on (m, rho) in the tangent plane of the first ray, m = x_0 + a T_0 + b N_0.
class EquidistantStep {
 public:
  explicit EquidistantStep(const SiteRay& frame) : frame_(frame) {}

  /// rho = s_i + <T_i, m - x_i>: the distance to the ray's site, to first order.
  void add_ray(const SiteRay& ray) {
    rows_.row(count_) << ray.T.dot(frame_.T), ray.T.dot(frame_.N), -1.0;
    right_(count_++) = ray.T.dot(ray.x - frame_.x) - ray.polar.s;
  }

  /// <normal, m> = offset.
  void add_plane(const Xyz& normal, double offset) {
    rows_.row(count_) << normal.dot(frame_.T), normal.dot(frame_.N), 0.0;
    right_(count_++) = offset - normal.dot(frame_.x);
  }

  EquidistantTarget solve() const {
    const Eigen::PartialPivLU<Eigen::Matrix3d> lu(rows_);
    const Eigen::Vector3d z = lu.solve(right_);
    return {frame_.x + z(0) * frame_.T + z(1) * frame_.N, z(2), z.allFinite()};
  }

 private:
  const SiteRay& frame_;
  Eigen::Matrix3d rows_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_ = Eigen::Vector3d::Zero();
  int count_ = 0;
};

}  // namespace geovor
