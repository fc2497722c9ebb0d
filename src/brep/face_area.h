// The area of a trimmed face by quadrature on the surface itself.
#pragma once

#include "brep/model.h"

namespace geovor {

/// An integral and what is known of its error.
struct Area {
  double value = 0.0;
  double error = 0.0;  ///< estimate, absolute
};

/// Area of the face: the integral of W = sqrt(EG - F^2) over its region, as an integral around its true p-curves
/// (Green's theorem) by Gauss-Legendre rules between knots, refined until two orders agree to `relative` of the area or
/// the budget of evaluations is spent; `error` says which. A face without loops covers its surface's domain.
/// Throws Error(FaceRejected) where the face has no surface, a p-curve is missing or the region is unbounded.
Area face_area(const CadModel& model, const CadFace& face, double relative = 1e-9);

}  // namespace geovor
