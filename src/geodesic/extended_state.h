// A geodesic's state carried on a little by Taylor's formula: onto places where the parameters have no tangent plane.
#pragma once

#include "geodesic/trace.h"
#include "surface/forms.h"

namespace geovor {

/// A path onto a side where the parameters lose the tangent plane is traced up to this part of its length before the
/// side, where the jets still have thirteen digits, and extended from there: that leaves 1e-15 of the length.
inline constexpr double kBeforeSide = 1e-5;

/// The state h further on, j the jet at `at`. What is left out is h^3 / 6 times how fast the curvature changes.
inline SpaceState extended(const SpaceState& at, const SurfaceJet& j, double h) {
  const Xyz &T = at.tangent, &n = at.normal, N = n.cross(T);
  const SecondForm II = second_form(j);
  const UvVec d = tangent_components(j, T), e = tangent_components(j, N);
  const auto form = [&](UvVec a, UvVec b) {
    return II.L * a.u * b.u + II.M * (a.u * b.v + a.v * b.u) + II.N * a.v * b.v;
  };
  const double bend = form(d, d), twist = form(d, e), K = bend * form(e, e) - twist * twist;
  SpaceState on = at;
  on.S += h * T + 0.5 * h * h * bend * n;
  on.tangent = (T + h * bend * n).normalized();
  const Xyz normal = n - h * (bend * T + twist * N);
  on.normal = (normal - normal.dot(on.tangent) * on.tangent).normalized();
  on.y += h * at.dy - 0.5 * h * h * K * at.y;
  on.dy -= h * K * at.y;
  return on;
}

}  // namespace geovor
