#include "surface/forms.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace geovor {
namespace {

// The reciprocal basis of the tangent plane: u.Su = v.Sv = 1, u.Sv = v.Su = 0. W^2 is taken as |Su x Sv|^2, which keeps
// its digits where Su and Sv are nearly parallel and EG - F^2 cancels.
struct Reciprocal {
  Xyz u, v;
  explicit Reciprocal(const SurfaceJet& j) {
    const Xyz n = j.Su.cross(j.Sv);
    const double W2 = n.squaredNorm();
    u = j.Sv.cross(n) / W2;
    v = n.cross(j.Su) / W2;
  }
};

}  // namespace

double Curvatures::largest() const { return std::max(std::abs(k1), std::abs(k2)); }

FirstForm first_form(const SurfaceJet& j) { return {j.Su.squaredNorm(), j.Su.dot(j.Sv), j.Sv.squaredNorm()}; }

Xyz unit_normal(const SurfaceJet& j) {
  const Xyz n = j.Su.cross(j.Sv);
  return n / n.norm();  // not normalized(): a zero vector has to become NaN, not stay zero
}

SecondForm second_form(const SurfaceJet& j) {
  const Xyz n = unit_normal(j);
  return {n.dot(j.Suu), n.dot(j.Suv), n.dot(j.Svv)};
}

// The shape operator is taken in the orthonormal frame e1 = Su/|Su|, e2 = n x e1, where it is symmetric:
// the half-difference of its eigenvalues is then a hypot and does not cancel at umbilics, as H^2 - K would.
Curvatures curvatures(const SurfaceJet& j) {
  const auto [E, F, G] = first_form(j);
  const auto [L, M, N] = second_form(j);
  const double W2 = j.Su.cross(j.Sv).squaredNorm();
  const double W = std::sqrt(W2);
  const double a = L / E;
  const double b = (M - F * a) / W;
  const double c = (E * N - 2.0 * F * M + F * F * a) / W2;
  Curvatures k;
  k.mean = 0.5 * (a + c);
  k.gauss = (L * N - M * M) / W2;
  const double r = std::hypot(0.5 * (a - c), b);
  k.k1 = k.mean + r;
  k.k2 = k.mean - r;
  return k;
}

// Suu = Gamma^u_uu Su + Gamma^v_uu Sv + L n: its products with the reciprocal basis give the symbols.
Christoffel christoffel(const SurfaceJet& j) {
  const Reciprocal r(j);
  return {r.u.dot(j.Suu), r.u.dot(j.Suv), r.u.dot(j.Svv), r.v.dot(j.Suu), r.v.dot(j.Suv), r.v.dot(j.Svv)};
}

double area_ratio(const SurfaceJet& j) { return j.Su.cross(j.Sv).norm(); }

double norm(const SurfaceJet& j, UvVec d) { return push_forward(j, d).norm(); }

UvVec direction_at_angle(const SurfaceJet& j, double t) {
  const double W = area_ratio(j), root_E = j.Su.norm(), s = std::sin(t);
  return {(std::cos(t) - j.Su.dot(j.Sv) * s / W) / root_E, root_E * s / W};
}

// With d = cos t e1 + sin t e2 (times its length): d . Su = |Su| cos t, and W d.v = |Su| sin t.
double angle_of_direction(const SurfaceJet& j, UvVec d) {
  return std::atan2(area_ratio(j) * d.v, j.Su.dot(push_forward(j, d)));
}

double dot(const FirstForm& I, UvVec a, UvVec b) {
  return I.E * a.u * b.u + I.F * (a.u * b.v + a.v * b.u) + I.G * a.v * b.v;
}

// Rounding may leave the form of a nearly degenerate metric a hair below zero.
double norm(const FirstForm& I, UvVec d) { return std::sqrt(std::max(dot(I, d, d), 0.0)); }

UvVec direction_at_angle(const FirstForm& I, double t) {
  const double W = std::sqrt(I.W2()), root_E = std::sqrt(I.E);
  const double s = std::sin(t);
  return {(std::cos(t) - I.F * s / W) / root_E, root_E * s / W};
}

// With d = cos t e1 + sin t e2 (times its length): d . Su = |Su| cos t, and W d.v = |Su| sin t.
double angle_of_direction(const FirstForm& I, UvVec d) {
  return std::atan2(std::sqrt(I.W2()) * d.v, I.E * d.u + I.F * d.v);
}

// w = a Su + b Sv + c n: by Cramer, a = [w, Sv, n] / W^2 and b = [Su, w, n] / W^2 with n = Su x Sv.
UvVec tangent_components(const SurfaceJet& j, const Xyz& w) {
  const Xyz n = j.Su.cross(j.Sv);
  const double per_W2 = 1.0 / n.squaredNorm();
  return {per_W2 * w.cross(j.Sv).dot(n), per_W2 * j.Su.cross(w).dot(n)};
}

}  // namespace geovor
