// Shooting: Newton's method on the polar coordinates (s, t) of a geodesic's end, with the Jacobi field as derivative.
#pragma once

#include "geodesic/connect.h"
#include "surface/forms.h"
#include "surface/tangent_frame.h"

namespace geovor {

/// Both ends of a boundary-value problem, each evaluated once.
struct Ends {
  Uv from, to;
  SurfaceJet at_from, at_to;
  TangentFrame start, finish;  ///< exist at poles too; NaN where there is no tangent plane
  double curvature;            ///< the largest normal curvature at either end; zero where neither tells

  Ends(const Surface& surface, Uv from_point, Uv to_point);
  double chord() const { return (at_to.S - at_from.S).norm(); }
};

/// The geodesic from `guess` on. The result's `evaluations` count this call alone.
Connection shoot(const Surface& surface, const Ends& ends, Polar guess, const ConnectOptions& options);

/// What the chord of points close to each other, in curvature radii, and the curvatures at both ends tell of the
/// geodesic: vectors along it at both ends, as long as the geodesic. The error falls as the fourth power of the
/// distance.
struct ChordGuess {
  Xyz first, last;
};

/// Nothing if the chord is no guide.
std::optional<ChordGuess> guess_from_chord(const Ends& ends);

/// The start of the shooting in that direction.
Polar polar_of(const Ends& ends, const ChordGuess& guess);

/// Direction and length of the chord: the start where parameters are no guide, as around poles.
Polar guess_across(const Ends& ends);

/// Direction and length of the straight line in the parameter plane.
Polar guess_from_parameters(const Surface& surface, const Ends& ends);

}  // namespace geovor
