// First and second fundamental form, curvatures and Christoffel symbols of a jet, in the textbook's letters:
// E F G, L M N, W = sqrt(EG - F^2), K and H, Gamma^k_ij (do Carmo, Differential Geometry, ch. 3 and 4).
#pragma once

#include "surface/surface.h"

namespace geovor {

/// First fundamental form: ds^2 = E du^2 + 2 F du dv + G dv^2.
struct FirstForm {
  double E, F, G;
  double W2() const { return E * G - F * F; }
};

/// Second fundamental form with respect to the normal Su x Sv / |Su x Sv|.
struct SecondForm {
  double L, M, N;
};

/// Gamma^1_11, Gamma^1_12, Gamma^1_22 and Gamma^2_… of equations (2) and (3) of the paper.
struct Christoffel {
  double u_uu, u_uv, u_vv;
  double v_uu, v_uv, v_vv;
};

/// Principal curvatures, k1 >= k2, and what follows from them.
struct Curvatures {
  double gauss = 0.0;
  double mean = 0.0;
  double k1 = 0.0;
  double k2 = 0.0;
  double largest() const;  ///< max(|k1|, |k2|)
};

FirstForm first_form(const SurfaceJet& j);

/// Su x Sv / |Su x Sv|; NaN where the two are parallel or zero.
Xyz unit_normal(const SurfaceJet& j);

SecondForm second_form(const SurfaceJet& j);
Curvatures curvatures(const SurfaceJet& j);
Christoffel christoffel(const SurfaceJet& j);

/// W = |Su x Sv|, the area that a unit square of parameters covers. With the three functions after it: taken from the
/// jet's vectors, because EG - F^2 loses the square of what the angle between Su and Sv costs. Where parameter lines
/// meet at an angle of 1/k these keep their digits but for a factor k, which is in the parameters themselves.
double area_ratio(const SurfaceJet& j);

/// Length of a parameter direction measured on the surface.
double norm(const SurfaceJet& j, UvVec d);

/// The unit direction at angle t in the frame e1 = Su/|Su|, e2 = n x e1 (erratum to definition 3.2):
/// u' = (cos t - F sin t / W) / sqrt(E), v' = sqrt(E) sin t / W.
UvVec direction_at_angle(const SurfaceJet& j, double t);

/// The inverse of direction_at_angle, in (-pi, pi], for a direction of any length.
double angle_of_direction(const SurfaceJet& j, UvVec d);

/// Length of a parameter direction measured on the surface.
double norm(const FirstForm& I, UvVec d);
double dot(const FirstForm& I, UvVec a, UvVec b);

/// The unit direction at angle t in the frame e1 = Su/|Su|, e2 = n x e1 (erratum to definition 3.2):
/// u' = (cos t - F sin t / W) / sqrt(E), v' = sqrt(E) sin t / W.
UvVec direction_at_angle(const FirstForm& I, double t);

/// The inverse of direction_at_angle, in (-pi, pi], for a direction of any length.
double angle_of_direction(const FirstForm& I, UvVec d);

/// The parameter direction whose image under (Su, Sv) is nearest to the space vector w.
UvVec tangent_components(const SurfaceJet& j, const Xyz& w);

/// The space vector Su d.u + Sv d.v.
inline Xyz push_forward(const SurfaceJet& j, UvVec d) { return j.Su * d.u + j.Sv * d.v; }

}  // namespace geovor
