// Unit normal and curvature of a surface wherever it is smooth, also where its parameters are not.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "surface/surface.h"

namespace geovor {

/// What a surface is to second order, apart from its parameters: a unit normal n, and the second form as a tensor of
/// space, B(a, b) = sum of (n.S_ij) (a.d^i) (b.d^j) with d^u, d^v the dual basis of Su, Sv. Both are smooth fields
/// wherever the surface is.
struct Shape {
  Xyz n = Xyz::Zero();
  Eigen::Matrix3d B = Eigen::Matrix3d::Zero();

  double largest_curvature() const;  ///< the largest |normal curvature|
};

/// REQUIRES: Su and Sv are not parallel
Shape shape(const SurfaceJet& j);

/// The shapes of a surface over a box, also on the sides of its domain along which Su or Sv vanishes (or nearly does).
/// A side that is one point has them from the surface's pole charts; at one that is a curve the field is continued to
/// it from places inside, as a function of the distance in space: so it does not matter how the parameters run.
/// Accuracy, for surfaces given to 13 digits: normals about 1e-10, curvatures 1e-6 of the largest one nearby.
class ShapeField {
 public:
  ShapeField(const Surface& surface, const UvBox& box);

  /// Nothing where Su and Sv do not span the tangent plane, no matter from where one looks: at the tip of a cone.
  /// `j` is the jet at p.
  std::optional<Shape> at(Uv p, const SurfaceJet& j) const;

  /// Mean |Su| and |Sv| over the box.
  double u_speed() const { return speed_[0]; }
  double v_speed() const { return speed_[1]; }

 private:
  /// A side u = at (k = 0) or v = at (k = 1) at which the lines of this parameter stop.
  struct Stop {
    int k;
    double at;
    double inwards;  ///< 1 at the low end, -1 at the high one
  };
  struct Continued {
    Shape shape;
    double error;  ///< of n, estimated
  };
  bool stops_at(const Stop& side, const UvBox& box) const;
  const Stop* near_stop(int k, Uv p, const SurfaceJet& j) const;
  Continued continued(const Stop& side, Uv p, double noise) const;
  Continued continued(const Stop& side, Uv p, const Span& span, double depth, double power) const;
  Shape inner(const Stop& side, Uv q, const SurfaceJet& j) const;
  bool spanning(const SurfaceJet& j) const;

  const Surface& surface_;
  double speed_[2] = {1.0, 1.0};
  std::vector<Stop> stops_;
};

}  // namespace geovor
