// The sums over the poles of a B-spline surface: its inner loops.
#pragma once

#include <vector>

#include "surface/span_basis.h"
#include "surface/surface.h"

namespace geovor {

/// What the kernels read.
struct BSplineNet {
  SpanBasis u, v;
  bool rational = false;
  Xyz centre = Xyz::Zero();  ///< poles are kept relative to it
  std::vector<Quad> poles;   ///< unrolled rows, v runs first, of (x, y, z, 0) or (w x, w y, w z, w)
  int row_length = 0;        ///< poles a row
};

/// Functions that evaluate the polynomials of one span, given by its flat indices, at any parameter.
struct BSplineKernels {
  void (*jet)(const BSplineNet&, int u_span, int v_span, double u, double v, SurfaceJet& j);
  void (*position)(const BSplineNet&, int u_span, int v_span, double u, double v, Xyz& S);
};

/// For the degrees p in u and q in v: those that run on any machine, and the fastest ones on this machine. Both give
/// the same bits.
BSplineKernels portable_kernels(int p, int q);
BSplineKernels fastest_kernels(int p, int q);

}  // namespace geovor
