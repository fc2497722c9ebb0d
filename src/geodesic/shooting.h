// Shooting: Newton's method on the polar coordinates (s, t) of a geodesic's end, with the Jacobi field as derivative.
#pragma once

#include "geodesic/connect.h"
#include "surface/forms.h"

namespace geovor {

/// Both ends of a boundary-value problem, each evaluated once.
struct Ends {
  Uv from, to;
  SurfaceJet at_from, at_to;
  double curvature;  ///< the largest normal curvature at either end

  Ends(const Surface& surface, Uv from_point, Uv to_point);
};

/// The unit tangent at angle t of the surface at a jet (see direction_at_angle).
Xyz tangent_at_angle(const SurfaceJet& j, double t);

/// The angle of a tangent vector of any length.
double angle_of_tangent(const SurfaceJet& j, const Xyz& w);

/// The geodesic from `guess` on. The result's `evaluations` count this call alone.
Connection shoot(const Surface& surface, const Ends& ends, Polar guess, const ConnectOptions& options);

/// Start of the shooting for points close to each other, in curvature radii, from their chord and the curvatures at
/// both ends; its error falls as the fourth power of the distance. Nothing if the chord is no guide.
std::optional<Polar> guess_from_chord(const Ends& ends);

/// Direction and length of the straight line in the parameter plane.
Polar guess_from_parameters(const Surface& surface, const Ends& ends);

}  // namespace geovor
