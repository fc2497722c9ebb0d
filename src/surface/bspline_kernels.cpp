#include "surface/bspline_kernels.h"

#include "surface/lanes.h"

namespace geovor {
namespace {

// A degree that is known when the program runs only.
constexpr int kAny = -1;
constexpr int most(int degree) { return degree == kAny ? kMaxDegree : degree; }

// Values (row 0) and derivatives up to order Orders - 1 of the p + 1 functions of a span.
template <int Orders, int MaxDegree>
struct Rows {
  Quad quads[Orders][SpanBasis::quads(MaxDegree)];
  GEOVOR_INLINE const double* operator[](int order) const { return quads[order][0].at; }
};

template <int Degree, int Orders>
GEOVOR_INLINE void evaluate(const SpanBasis& basis, int flat_index, double x, Rows<Orders, most(Degree)>& rows) {
  const int p = Degree == kAny ? basis.degree() : Degree;
  const SpanBasis::Span span = basis.span(flat_index);
  Lanes a[most(Degree) + 1], b[most(Degree) + 1];  // their powers
  a[0] = b[0] = all(1.0);
  a[1] = all((span.hi - x) * span.per_length);
  b[1] = all((x - span.lo) * span.per_length);
#pragma GCC unroll 16
  for (int k = 2; k <= p; ++k) {
    a[k] = a[k - 1] * a[1];
    b[k] = b[k - 1] * b[1];
  }
  const int blocks = SpanBasis::quads(p);
  const Quad* m = span.m;
#pragma GCC unroll 3
  for (int order = 0; order < Orders; ++order) {
    const int n = p - order;
    Lanes bernstein[most(Degree) + 1];
#pragma GCC unroll 16
    for (int k = 0; k <= n; ++k) bernstein[k] = a[n - k] * b[k];
#pragma GCC unroll 2
    for (int q = 0; q < blocks; ++q) {
      Lanes sum{};
#pragma GCC unroll 16
      for (int k = 0; k <= n; ++k) sum += bernstein[k] * load(m[k * blocks + q]);
      store(sum, rows.quads[order][q]);
    }
    m += (n + 1) * blocks;
  }
}

GEOVOR_INLINE void copy(const Lanes& from, Xyz& to) {
  to.x() = from[0];
  to.y() = from[1];
  to.z() = from[2];
}

// S and its derivatives in four coordinates.
struct LanesJet {
  Lanes S{}, Su{}, Sv{}, Suu{}, Suv{}, Svv{};
};

// Undoes the homogeneous coordinates A = w S: A_u = w_u S + w S_u and so on by Leibniz.
GEOVOR_INLINE void project(LanesJet& A) {
  const Lanes r = all(1.0 / A.S[3]), wu = all(A.Su[3]), wv = all(A.Sv[3]);
  const Lanes wuu = all(A.Suu[3]), wuv = all(A.Suv[3]), wvv = all(A.Svv[3]);
  A.S = r * A.S;
  A.Su = r * (A.Su - wu * A.S);
  A.Sv = r * (A.Sv - wv * A.S);
  A.Suu = r * (A.Suu - 2.0 * wu * A.Su - wuu * A.S);
  A.Suv = r * (A.Suv - wu * A.Sv - wv * A.Su - wuv * A.S);
  A.Svv = r * (A.Svv - 2.0 * wv * A.Sv - wvv * A.S);
}

template <int P, int Q>
GEOVOR_INLINE void jet(const BSplineNet& net, int u_span, int v_span, double u, double v, SurfaceJet& j) {
  const int p = P == kAny ? net.u.degree() : P, q = Q == kAny ? net.v.degree() : Q;
  Rows<3, most(P)> Nu;
  Rows<3, most(Q)> Nv;
  evaluate<P>(net.u, u_span, u, Nu);
  evaluate<Q>(net.v, v_span, v, Nv);

  // One column of poles after the other: summed over u, then added to the sums over v.
  LanesJet A;
  const Quad* column = &net.poles[static_cast<size_t>(u_span - p) * net.row_length + (v_span - q)];
  for (int b = 0; b <= q; ++b, ++column) {
    Lanes r{}, ru{}, ruu{};
    const Quad* pole = column;
#pragma GCC unroll 16
    for (int a = 0; a <= p; ++a, pole += net.row_length) {
      const Lanes P_ab = load(*pole);
      r += all(Nu[0][a]) * P_ab;
      ru += all(Nu[1][a]) * P_ab;
      ruu += all(Nu[2][a]) * P_ab;
    }
    const Lanes N = all(Nv[0][b]), Nv1 = all(Nv[1][b]), Nv2 = all(Nv[2][b]);
    A.S += N * r;
    A.Su += N * ru;
    A.Sv += Nv1 * r;
    A.Suu += N * ruu;
    A.Suv += Nv1 * ru;
    A.Svv += Nv2 * r;
  }
  if (net.rational) project(A);
  copy(A.S, j.S);
  copy(A.Su, j.Su);
  copy(A.Sv, j.Sv);
  copy(A.Suu, j.Suu);
  copy(A.Suv, j.Suv);
  copy(A.Svv, j.Svv);
  j.S += net.centre;
}

template <int P, int Q>
GEOVOR_INLINE void position(const BSplineNet& net, int u_span, int v_span, double u, double v, Xyz& S) {
  const int p = P == kAny ? net.u.degree() : P, q = Q == kAny ? net.v.degree() : Q;
  Rows<1, most(P)> Nu;
  Rows<1, most(Q)> Nv;
  evaluate<P>(net.u, u_span, u, Nu);
  evaluate<Q>(net.v, v_span, v, Nv);
  Lanes A{};
  const Quad* column = &net.poles[static_cast<size_t>(u_span - p) * net.row_length + (v_span - q)];
  for (int b = 0; b <= q; ++b, ++column) {
    Lanes r{};
    const Quad* pole = column;
#pragma GCC unroll 16
    for (int a = 0; a <= p; ++a, pole += net.row_length) r += all(Nu[0][a]) * load(*pole);
    A += all(Nv[0][b]) * r;
  }
  if (net.rational) A = all(1.0 / A[3]) * A;
  copy(A, S);
  S += net.centre;
}

// The same source, compiled for every machine and for those that have AVX2.
template <int P, int Q>
struct Portable {
  static void jet(const BSplineNet& net, int u_span, int v_span, double u, double v, SurfaceJet& j) {
    geovor::jet<P, Q>(net, u_span, v_span, u, v, j);
  }
  static void position(const BSplineNet& net, int u_span, int v_span, double u, double v, Xyz& S) {
    geovor::position<P, Q>(net, u_span, v_span, u, v, S);
  }
};

#ifdef GEOVOR_AVX2
template <int P, int Q>
struct Avx2 {
  GEOVOR_AVX2 static void jet(const BSplineNet& net, int u_span, int v_span, double u, double v, SurfaceJet& j) {
    geovor::jet<P, Q>(net, u_span, v_span, u, v, j);
  }
  GEOVOR_AVX2 static void position(const BSplineNet& net, int u_span, int v_span, double u, double v, Xyz& S) {
    geovor::position<P, Q>(net, u_span, v_span, u, v, S);
  }
};
#endif

// Degrees fixed at compile time spare half of the time. CAD surfaces are mostly of equal degrees, or sweeps and lofts
// of low ones; everything else runs through the general kernel.
template <template <int, int> class Compiled>
BSplineKernels choose(int p, int q) {
  BSplineKernels chosen{Compiled<kAny, kAny>::jet, Compiled<kAny, kAny>::position};
  auto offer = [&]<int P, int Q>() {
    if (p == P && q == Q) chosen = {Compiled<P, Q>::jet, Compiled<P, Q>::position};
  };
  auto with_others = [&]<int P>() {
    offer.template operator()<P, 1>();
    offer.template operator()<P, 2>();
    offer.template operator()<P, 3>();
    offer.template operator()<P, 5>();
  };
  with_others.template operator()<1>();
  with_others.template operator()<2>();
  with_others.template operator()<3>();
  with_others.template operator()<5>();
  offer.template operator()<4, 4>();
  offer.template operator()<6, 6>();
  offer.template operator()<7, 7>();
  offer.template operator()<9, 9>();
  return chosen;
}

}  // namespace

BSplineKernels portable_kernels(int p, int q) { return choose<Portable>(p, q); }

BSplineKernels fastest_kernels(int p, int q) {
#ifdef GEOVOR_AVX2
  if (has_avx2()) return choose<Avx2>(p, q);
#endif
  return portable_kernels(p, q);
}

}  // namespace geovor
