// The geodesic equation with its Jacobi field as a first-order system, from one surface jet.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "geodesic/trace.h"

namespace geovor {

/// (u, v, u', v', y, y').
using GeodesicVector = Eigen::Matrix<double, 6, 1>;

inline GeodesicVector to_vector(const GeodesicState& s) {
  return (GeodesicVector() << s.p.u, s.p.v, s.d.u, s.d.v, s.y, s.dy).finished();
}

inline GeodesicState to_state(const GeodesicVector& x) { return {{x[0], x[1]}, {x[2], x[3]}, x[4], x[5]}; }

/// d/ds of the state. The second derivative of the curve in space, q = Suu u'^2 + 2 Suv u'v' + Svv v'^2 + Su u'' + Sv
/// v'', has no tangential part (this is (2) of the paper without spelling out the Christoffel symbols), and y'' = -K y.
/// With m = Su x Sv all quotients have |m|^2 = W^2 below, formed without the cancellation of EG - F^2, so that sheared
/// parameterizations keep their digits. NaN or infinite where the metric vanishes. `m` comes back for the caller.
inline GeodesicVector geodesic_slope(const SurfaceJet& j, const GeodesicVector& x, Xyz& m) {
  const double du = x[2], dv = x[3];
  const Xyz q = (du * du) * j.Suu + (2.0 * du * dv) * j.Suv + (dv * dv) * j.Svv;
  m = j.Su.cross(j.Sv);
  const double inverse_W2 = 1.0 / m.squaredNorm();
  const double Muv = j.Suv.dot(m);
  const double K = (j.Suu.dot(m) * j.Svv.dot(m) - Muv * Muv) * inverse_W2 * inverse_W2;
  const double ddu = j.Sv.cross(q).dot(m) * inverse_W2;
  const double ddv = q.cross(j.Su).dot(m) * inverse_W2;
  return (GeodesicVector() << du, dv, ddu, ddv, x[5], -K * x[4]).finished();
}

}  // namespace geovor
