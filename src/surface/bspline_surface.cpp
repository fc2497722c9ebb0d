#include "surface/bspline_surface.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "surface/bspline_basis.h"
#include "surface/pole_chart.h"
#include "surface/spline_cap.h"

namespace geovor {
namespace {

[[noreturn]] void reject(const std::string& what) { throw Error(ErrorCode::FaceRejected, what); }

// Weights that differ by rounding only describe a polynomial surface.
bool differ(const std::vector<double>& weights) {
  constexpr double kEqualWeights = 1e-15;
  const auto [lo, hi] = std::minmax_element(weights.begin(), weights.end());
  return !weights.empty() && *hi - *lo > kEqualWeights * *hi;
}

void check(size_t count, const std::vector<Xyz>& poles, const std::vector<double>& weights) {
  if (poles.size() != count)
    reject("a B-spline surface has " + std::to_string(poles.size()) + " poles where its knots ask for " +
           std::to_string(count) + "; repair the knots or the poles");
  if (!weights.empty() && weights.size() != count)
    reject("a B-spline surface has not one weight a pole; repair the weights");
  for (const Xyz& p : poles)
    if (!p.allFinite()) reject("a pole of a B-spline surface is not finite; repair the poles");
  for (double w : weights)
    if (!(w > 0.0) || !std::isfinite(w)) reject("a weight of a B-spline surface is not positive; repair the weights");
}

Xyz centre_of(const std::vector<Xyz>& poles) {
  Xyz lo = poles.front(), hi = lo;
  for (const Xyz& p : poles) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  return 0.5 * (lo + hi);
}

// Undoes the homogeneous coordinates: with A = w S, S_u = (A_u - w_u S) / w and so on by Leibniz.
SurfaceJet project_homogeneous(const double (&H)[6][4], const Xyz& centre) {
  auto A = [&H](int k) { return Xyz(H[k][0], H[k][1], H[k][2]); };
  const double r = 1.0 / H[0][3];
  const double wu = H[1][3], wv = H[2][3], wuu = H[3][3], wuv = H[4][3], wvv = H[5][3];
  SurfaceJet j;
  j.S = r * A(0);
  j.Su = r * (A(1) - wu * j.S);
  j.Sv = r * (A(2) - wv * j.S);
  j.Suu = r * (A(3) - 2.0 * wu * j.Su - wuu * j.S);
  j.Suv = r * (A(4) - wu * j.Sv - wv * j.Su - wuv * j.S);
  j.Svv = r * (A(5) - 2.0 * wv * j.Sv - wvv * j.S);
  j.S += centre;
  return j;
}

}  // namespace

// Poles are kept relative to the middle of their box: a part modelled far from the origin would otherwise lose digits
// of its derivatives in sums of large, nearly equal terms.
BSplineSurface::BSplineSurface(KnotVector u_knots, KnotVector v_knots, const std::vector<Xyz>& poles,
                               const std::vector<double>& weights, const std::optional<Xyz>& centre)
    : u_knots_(std::move(u_knots)), v_knots_(std::move(v_knots)) {
  const int nu = u_knots_.pole_count(), nv = v_knots_.pole_count();
  check(static_cast<size_t>(nu) * nv, poles, weights);
  rational_ = differ(weights);
  centre_ = centre ? *centre : centre_of(poles);
  const int width = rational_ ? 4 : 3;
  row_length_ = v_knots_.unrolled_count() * width;
  poles_.reserve(static_cast<size_t>(u_knots_.unrolled_count()) * row_length_);
  for (int i = 0; i < u_knots_.unrolled_count(); ++i) {
    for (int j = 0; j < v_knots_.unrolled_count(); ++j) {
      const size_t at = static_cast<size_t>(i % nu) * nv + j % nv;
      const double w = rational_ ? weights[at] : 1.0;
      const Xyz local = w * (poles[at] - centre_);
      poles_.insert(poles_.end(), local.data(), local.data() + 3);
      if (rational_) poles_.push_back(w);
    }
  }
  kernels_ = choose_kernels();
}

// Degrees fixed at compile time are worth a factor of three; CAD surfaces are mostly bilinear to biquintic with equal
// degrees. Everything else runs through the general kernel.
BSplineSurface::Kernels BSplineSurface::choose_kernels() const {
  switch (u_knots_.degree() == v_knots_.degree() ? u_knots_.degree() : 0) {
    case 1:
      return kernels<1>();
    case 2:
      return kernels<2>();
    case 3:
      return kernels<3>();
    case 5:
      return kernels<5>();
    default:
      return kernels<0>();
  }
}

template <int Degree>
BSplineSurface::Kernels BSplineSurface::kernels() const {
  if (rational_) return {&BSplineSurface::evaluate<Degree, 4>, &BSplineSurface::locate<Degree, 4>};
  return {&BSplineSurface::evaluate<Degree, 3>, &BSplineSurface::locate<Degree, 3>};
}

// The sum over u comes first: its inner loop runs over the contiguous coordinates of a row, so that it vectorizes
// without idle lanes. The sums over v then work on the three rows r, r_u, r_uu.
template <int Degree, int Width>
SurfaceJet BSplineSurface::evaluate(int u_span, int v_span, double u, double v) const {
  constexpr int kMax = Degree == 0 ? kMaxDegree : Degree;
  const int p = Degree == 0 ? u_knots_.degree() : Degree;
  const int q = Degree == 0 ? v_knots_.degree() : Degree;
  BasisRows<3, kMax> Nu, Nv;
  basis_functions<3, Degree>(u_knots_, u_span, u, Nu);
  basis_functions<3, Degree>(v_knots_, v_span, v, Nv);

  double rows[3][(kMax + 1) * Width];
  const int length = (q + 1) * Width;
  const double* first = &poles_[static_cast<size_t>(u_span - p) * row_length_ + (v_span - q) * Width];
  for (int k = 0; k < 3; ++k) {
    const double* pole = first;
    for (int m = 0; m < length; ++m) rows[k][m] = Nu[k][0] * pole[m];
    for (int i = 1; i <= p; ++i) {
      pole += row_length_;
      for (int m = 0; m < length; ++m) rows[k][m] += Nu[k][i] * pole[m];
    }
  }

  // Order of the sums: S, Su, Sv, Suu, Suv, Svv.
  constexpr int kOfU[6] = {0, 1, 0, 2, 1, 0};
  constexpr int kOfV[6] = {0, 0, 1, 0, 1, 2};
  double H[6][Width];
  for (int k = 0; k < 6; ++k) {
    const double* row = rows[kOfU[k]];
    const double* N = Nv[kOfV[k]].data();
    for (int c = 0; c < Width; ++c) H[k][c] = N[0] * row[c];
    for (int j = 1; j <= q; ++j)
      for (int c = 0; c < Width; ++c) H[k][c] += N[j] * row[j * Width + c];
  }
  if constexpr (Width == 4) {
    return project_homogeneous(H, centre_);
  } else {
    auto at = [&H](int k) { return Xyz(H[k][0], H[k][1], H[k][2]); };
    return {at(0) + centre_, at(1), at(2), at(3), at(4), at(5)};
  }
}

template <int Degree, int Width>
Xyz BSplineSurface::locate(int u_span, int v_span, double u, double v) const {
  constexpr int kMax = Degree == 0 ? kMaxDegree : Degree;
  const int p = Degree == 0 ? u_knots_.degree() : Degree;
  const int q = Degree == 0 ? v_knots_.degree() : Degree;
  BasisRows<1, kMax> Nu, Nv;
  basis_functions<1, Degree>(u_knots_, u_span, u, Nu);
  basis_functions<1, Degree>(v_knots_, v_span, v, Nv);
  const double* row = &poles_[static_cast<size_t>(u_span - p) * row_length_ + (v_span - q) * Width];
  double H[Width] = {};
  for (int i = 0; i <= p; ++i, row += row_length_) {
    double sum[Width] = {};
    for (int j = 0; j <= q; ++j)
      for (int c = 0; c < Width; ++c) sum[c] += Nv[0][j] * row[j * Width + c];
    for (int c = 0; c < Width; ++c) H[c] += Nu[0][i] * sum[c];
  }
  const Xyz local(H[0], H[1], H[2]);
  if constexpr (Width == 4) return centre_ + local / H[3];
  return centre_ + local;
}

Xyz BSplineSurface::pole(int i, int j) const {
  const double* q = &poles_[static_cast<size_t>(i) * row_length_ + j * (rational_ ? 4 : 3)];
  return rational_ ? Xyz(q[0] / q[3], q[1] / q[3], q[2] / q[3]) : Xyz(q[0], q[1], q[2]);
}

double BSplineSurface::weight(int i, int j) const {
  return rational_ ? poles_[static_cast<size_t>(i) * row_length_ + j * 4 + 3] : 1.0;
}

PoleCharts BSplineSurface::make_poles() const { return spline_poles(*this); }

std::optional<double> BSplineSurface::u_period() const {
  return u_knots_.periodic() ? std::optional(u_knots_.period()) : std::nullopt;
}

std::optional<double> BSplineSurface::v_period() const {
  return v_knots_.periodic() ? std::optional(v_knots_.period()) : std::nullopt;
}

SurfaceJet BSplineSurface::jet(Uv p) const {
  const KnotSpan u = u_knots_.find(p.u, 0.0), v = v_knots_.find(p.v, 0.0);
  return (this->*kernels_.jet)(u.index, v.index, u_knots_.unwind(p.u, u), v_knots_.unwind(p.v, v));
}

SurfaceJet BSplineSurface::jet(Uv p, const Span& span) const {
  return (this->*kernels_.jet)(span.u, span.v, u_knots_.unwind(p.u, span.u, span.box.u),
                               v_knots_.unwind(p.v, span.v, span.box.v));
}

Xyz BSplineSurface::position(Uv p) const {
  const KnotSpan u = u_knots_.find(p.u, 0.0), v = v_knots_.find(p.v, 0.0);
  return (this->*kernels_.position)(u.index, v.index, u_knots_.unwind(p.u, u), v_knots_.unwind(p.v, v));
}

Span BSplineSurface::span(Uv p, UvVec towards) const {
  const KnotSpan u = u_knots_.find(p.u, towards.u), v = v_knots_.find(p.v, towards.v);
  return {u.index, v.index, {u_knots_.box(u), v_knots_.box(v)}};
}

int BSplineSurface::continuity() const { return std::min(u_knots_.continuity(kSmooth), v_knots_.continuity(kSmooth)); }

BSplineSurface::KnotLines BSplineSurface::knot_lines() const {
  const auto& u = u_knots_.lines();
  const auto& v = v_knots_.lines();
  return {{u.begin() + 1, u.end() - 1}, {v.begin() + 1, v.end() - 1}};
}

}  // namespace geovor
