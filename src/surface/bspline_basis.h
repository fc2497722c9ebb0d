// The B-spline basis functions of one span and their derivatives, at any parameter: outside the span they are the
// continuation of the span's own polynomials. [Piegl & Tiller, The NURBS Book, algorithms A2.2 and A2.3, rewritten with
// the reciprocals of the knot differences kept in the knot vector.]
#pragma once

#include <array>

#include "surface/knot_vector.h"

namespace geovor {

/// Values (row 0) and derivatives up to order `Orders - 1` of the p + 1 functions that do not vanish on a span.
template <int Orders>
using BasisRows = std::array<std::array<double, kMaxDegree + 1>, Orders>;

namespace detail {

// From the functions of degree q - 1 (q of them) to those of degree q. The two terms are convex weights inside the
// span.
inline void raise(double* N, int q, const double* reciprocal, const double* t, double x) {
  double saved = 0.0;
  for (int r = 0; r < q; ++r) {
    const double term = N[r] * reciprocal[r];
    N[r] = saved + (t[1 + r] - x) * term;
    saved = (x - t[1 + r - q]) * term;
  }
  N[q] = saved;
}

// From the k-th derivatives of degree q - 1 to the (k+1)-th derivatives of degree q: N' = q (N_i/… - N_i+1/…).
// `from` may be `to`; the first step of each derivative takes them apart instead of copying.
inline void differentiate(const double* from, double* to, int q, const double* reciprocal) {
  double saved = 0.0;
  for (int r = 0; r < q; ++r) {
    const double term = q * from[r] * reciprocal[r];
    to[r] = saved - term;
    saved = term;
  }
  to[q] = saved;
}

}  // namespace detail

template <int Orders>
inline void basis_functions(const KnotVector& knots, int span, double x, BasisRows<Orders>& rows) {
  const int p = knots.degree();
  const double* t = &knots.flat()[span];
  const double* reciprocals = knots.reciprocals(span);
  auto triangle = [reciprocals](int q) { return reciprocals + q * (q - 1) / 2; };

  double* N = rows[0].data();
  N[0] = 1.0;
  for (int q = 0; q <= p; ++q) {
    if (q > 0) detail::raise(N, q, triangle(q), t, x);
    // The derivative of order p - q starts from the functions of degree q.
    const int order = p - q;
    if (order <= 0 || order >= Orders) continue;
    double* D = rows[order].data();
    for (int up = q + 1; up <= p; ++up) detail::differentiate(up == q + 1 ? N : D, D, up, triangle(up));
  }
  for (int order = 1; order < Orders; ++order)
    if (order > p) rows[order].fill(0.0);
}

}  // namespace geovor
