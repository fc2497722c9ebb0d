// The region of the parameter plane that a face covers, and what can be asked of it.
#pragma once

#include <vector>

#include "brep/model.h"

namespace geovor {

/// The trimmed region of a face, with its border flattened to polylines in the parameter plane.
class FaceDomain {
 public:
  /// `deflection`: how far, in space, the flattened border may lie from the true one.
  FaceDomain(const CadModel& model, const CadFace& face, double deflection);

  /// Whether p lies in the face. In a periodic direction every copy of p counts.
  bool contains(Uv p) const;

  /// The copy of p (shifted by whole periods) that lies in the face, or p itself where none does.
  Uv to_principal(Uv p) const;

  /// Distance in space, to first order, from p to the flattened border; 0 where there is no border.
  double distance_to_border(Uv p) const;

  const UvBox& box() const { return box_; }
  /// Closed polylines, first point not repeated; outer loops counter-clockwise, holes clockwise.
  const std::vector<std::vector<Uv>>& loops() const { return loops_; }
  const Surface& surface() const { return *surface_; }

 private:
  SurfacePtr surface_;
  UvBox box_;
  std::vector<std::vector<Uv>> loops_;
};

/// Area of the face: the integral of W = sqrt(EG - F^2) over its region, by Gauss-Legendre rules between the p-curves and
/// knot lines, refined until two orders agree.
struct Area {
  double value = 0.0;
  double error = 0.0;  ///< estimate, absolute
};
Area face_area(const CadModel& model, const CadFace& face);

/// How unequal the parameterization is: the largest ratio of the singular values of (Su, Sv) inside the face, after one
/// global scale a direction, and the smallest angle between Su and Sv (radians).
struct Stretch {
  double anisotropy = 1.0;
  double smallest_angle = 0.0;
};
Stretch parameter_stretch(const FaceDomain& domain);

}  // namespace geovor
