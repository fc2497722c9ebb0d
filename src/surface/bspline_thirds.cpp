// The third derivatives of a B-spline surface. Offsets alone ask for them: one plain loop serves all degrees.
#include "surface/bspline_basis.h"
#include "surface/bspline_surface.h"

namespace geovor {
namespace {

// By the orders of differentiation in u and in v; entries of a total order above 3 are not used.
constexpr int kOrders = 4;
using Homogeneous = Eigen::Vector4d;  // (w x, w y, w z, w)
struct Derivatives {
  Homogeneous at[kOrders][kOrders];
};

// With A = w S: A_ij = sum of binomials w_kl S_(i-k)(j-l); solved for S_ij from the lowest orders on.
Xyz quotient(const Derivatives& d, Xyz (&S)[kOrders][kOrders], int i, int j) {
  constexpr double kBinomial[kOrders][kOrders] = {{1, 0, 0, 0}, {1, 1, 0, 0}, {1, 2, 1, 0}, {1, 3, 3, 1}};
  Xyz sum = d.at[i][j].head<3>();
  for (int k = 0; k <= i; ++k)
    for (int l = 0; l <= j; ++l)
      if (k + l > 0) sum -= kBinomial[i][k] * kBinomial[j][l] * d.at[k][l][3] * S[i - k][j - l];
  return sum / d.at[0][0][3];
}

}  // namespace

SurfaceThirds BSplineSurface::third(Uv p, const Span& span) const {
  BasisRows<kOrders> Nu, Nv;
  basis_functions<kOrders>(u_knots_, span.u, u_knots_.unwind(p.u, span.u, span.box.u), Nu);
  basis_functions<kOrders>(v_knots_, span.v, v_knots_.unwind(p.v, span.v, span.box.v), Nv);
  const int first_u = span.u - u_knots_.degree(), first_v = span.v - v_knots_.degree();
  Derivatives d;
  for (auto& row : d.at)
    for (auto& entry : row) entry.setZero();
  for (int i = 0; i <= u_knots_.degree(); ++i) {
    for (int j = 0; j <= v_knots_.degree(); ++j) {
      Homogeneous q;
      q[3] = weight(first_u + i, first_v + j);
      q.head<3>() = q[3] * pole(first_u + i, first_v + j);
      for (int a = 0; a < kOrders; ++a)
        for (int b = 0; a + b < kOrders; ++b) d.at[a][b] += Nu[a][i] * Nv[b][j] * q;
    }
  }
  if (!rational()) {
    return {d.at[3][0].head<3>(), d.at[2][1].head<3>(), d.at[1][2].head<3>(), d.at[0][3].head<3>()};
  }
  Xyz S[kOrders][kOrders];
  for (int total = 0; total < kOrders; ++total)
    for (int i = 0; i <= total; ++i) S[i][total - i] = quotient(d, S, i, total - i);
  return {S[3][0], S[2][1], S[1][2], S[0][3]};
}

}  // namespace geovor
