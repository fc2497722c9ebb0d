// Places on a face as a user gives them: in parameters or in space.
#pragma once

#include <variant>

#include "brep/face_domain.h"

namespace geovor {

using FacePoint = std::variant<Uv, Xyz>;

/// A point of the face.
struct FacePlace {
  Uv uv;
  Xyz xyz = Xyz::Zero();
  double moved = 0.0;  ///< how far, in space, it lies from what was given
};

/// OpenCASCADE's Precision::Confusion, model units: what a file without tolerances means.
inline constexpr double kConfusion = 1e-7;

/// What the CAD promises of the face's border: nearer to it than this is on it.
double face_tolerance(const CadFace& face);

/// How far a point that is given in space may lie off the face: the face's tolerance, and the rounding of printed
/// coordinates. Lengths, model units.
double printed_tolerance(const FaceDomain& domain, const CadFace& face);

/// The place on the face that a point of space means: its foot on the surface. Throws Error(Usage) where it is not
/// finite or farther from the surface than `tolerance`, unless `snap`. The foot may lie outside the trims.
FacePlace project_on_face(const FaceDomain& domain, const Xyz& x, double tolerance, bool snap);

/// The place on the face, its border included (to `tolerance`), that a point means. Throws Error(Usage) where it is not
/// finite, off the surface or outside the trims, unless `snap`: then it is moved to the nearest point of the face, or
/// of its border.
FacePlace place_on_face(const FaceDomain& domain, const FacePoint& point, double tolerance, bool snap);

}  // namespace geovor
