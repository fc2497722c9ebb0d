#include "surface/bspline_surface.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
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

// Where the knots are unrolled the poles are, too.
std::vector<Quad> unrolled(const KnotVector& u, const KnotVector& v, const std::vector<Xyz>& poles,
                           const std::vector<double>& weights, const Xyz& centre) {
  std::vector<Quad> quads;
  quads.reserve(static_cast<size_t>(u.unrolled_count()) * v.unrolled_count());
  for (int i = 0; i < u.unrolled_count(); ++i) {
    for (int j = 0; j < v.unrolled_count(); ++j) {
      const size_t at = static_cast<size_t>(i % u.pole_count()) * v.pole_count() + j % v.pole_count();
      const double w = weights.empty() ? 1.0 : weights[at];
      const Xyz local = w * (poles[at] - centre);
      quads.push_back({{local.x(), local.y(), local.z(), w}});
    }
  }
  return quads;
}

// Poles are kept relative to the middle of their box: a part modelled far from the origin would otherwise lose digits
// of its derivatives in sums of large, nearly equal terms.
BSplineNet make_net(const KnotVector& u, const KnotVector& v, const std::vector<Xyz>& poles,
                    const std::vector<double>& weights, const std::optional<Xyz>& given_centre) {
  check(static_cast<size_t>(u.pole_count()) * v.pole_count(), poles, weights);
  const bool rational = differ(weights);
  const Xyz centre = given_centre ? *given_centre : centre_of(poles);
  return {SpanBasis(u),
          SpanBasis(v),
          rational,
          centre,
          unrolled(u, v, poles, rational ? weights : std::vector<double>{}, centre),
          v.unrolled_count()};
}

}  // namespace

BSplineSurface::BSplineSurface(KnotVector u_knots, KnotVector v_knots, const std::vector<Xyz>& poles,
                               const std::vector<double>& weights, const std::optional<Xyz>& centre)
    : u_knots_(std::move(u_knots)),
      v_knots_(std::move(v_knots)),
      net_(make_net(u_knots_, v_knots_, poles, weights, centre)),
      kernels_(fastest_kernels(u_knots_.degree(), v_knots_.degree())) {
  join_seams();
}

Xyz BSplineSurface::pole(int i, int j) const {
  const double* q = net_.poles[static_cast<size_t>(i) * net_.row_length + j].at;
  return rational() ? Xyz(q[0] / q[3], q[1] / q[3], q[2] / q[3]) : Xyz(q[0], q[1], q[2]);
}

double BSplineSurface::weight(int i, int j) const {
  return rational() ? net_.poles[static_cast<size_t>(i) * net_.row_length + j].at[3] : 1.0;
}

PoleCharts BSplineSurface::make_poles() const { return spline_poles(*this); }

std::optional<double> BSplineSurface::u_period() const {
  return u_knots_.wraps() ? std::optional(u_knots_.period()) : std::nullopt;
}

std::optional<double> BSplineSurface::v_period() const {
  return v_knots_.wraps() ? std::optional(v_knots_.period()) : std::nullopt;
}

SurfaceJet BSplineSurface::jet(Uv p) const {
  const KnotSpan u = u_knots_.find(p.u, 0.0), v = v_knots_.find(p.v, 0.0);
  SurfaceJet j;
  kernels_.jet(net_, u.index, v.index, u_knots_.unwind(p.u, u), v_knots_.unwind(p.v, v), j);
  return j;
}

SurfaceJet BSplineSurface::jet(Uv p, const Span& span) const {
  SurfaceJet j;
  kernels_.jet(net_, span.u, span.v, u_knots_.unwind(p.u, span.u, span.box.u), v_knots_.unwind(p.v, span.v, span.box.v),
               j);
  return j;
}

Xyz BSplineSurface::position(Uv p) const {
  const KnotSpan u = u_knots_.find(p.u, 0.0), v = v_knots_.find(p.v, 0.0);
  Xyz S;
  kernels_.position(net_, u.index, v.index, u_knots_.unwind(p.u, u), v_knots_.unwind(p.v, v), S);
  return S;
}

Span BSplineSurface::span(Uv p, UvVec towards) const {
  const KnotSpan u = u_knots_.find(p.u, towards.u), v = v_knots_.find(p.v, towards.v);
  return {u.index, v.index, {u_knots_.box(u), v_knots_.box(v)}};
}

int BSplineSurface::continuity() const {
  return std::min({u_knots_.continuity(kSmooth), v_knots_.continuity(kSmooth), seam_continuity_});
}

BSplineSurface::KnotLines BSplineSurface::knot_lines() const {
  const auto& u = u_knots_.lines();
  const auto& v = v_knots_.lines();
  return {{u.begin() + 1, u.end() - 1}, {v.begin() + 1, v.end() - 1}};
}

}  // namespace geovor
