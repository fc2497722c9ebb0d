#include "surface/bspline_curve.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "surface/bspline_basis.h"
#include "surface/closure.h"

namespace geovor {
namespace {

constexpr int kOrders = 4;  // value and three derivatives

[[noreturn]] void reject(const std::string& what) { throw Error(ErrorCode::FaceRejected, what); }

template <class Point>
void check(size_t count, const std::vector<Point>& poles, const std::vector<double>& weights) {
  if (poles.size() != count)
    reject("a B-spline curve has " + std::to_string(poles.size()) + " poles where its knots ask for " +
           std::to_string(count) + "; repair the knots or the poles");
  if (!weights.empty() && weights.size() != count)
    reject("a B-spline curve has not one weight a pole; repair the weights");
  for (const Point& p : poles)
    if (!p.allFinite()) reject("a pole of a B-spline curve is not finite; repair the poles");
  for (double w : weights)
    if (!(w > 0.0) || !std::isfinite(w)) reject("a weight of a B-spline curve is not positive; repair the weights");
}

}  // namespace

template <int Dim>
BSplineCurve<Dim>::BSplineCurve(KnotVector knots, const std::vector<Point>& poles, const std::vector<double>& weights)
    : knots_(std::move(knots)) {
  const int n = knots_.pole_count();
  check(static_cast<size_t>(n), poles, weights);
  for (int i = 0; i < knots_.unrolled_count(); ++i) {
    const double w = weights.empty() ? 1.0 : weights[i % n];
    poles_.push_back(w * poles[i % n]);
    if (!weights.empty()) weights_.push_back(w);
  }
  join_seam(poles);
}

// The ends are the same, and the curve is more than a point.
template <int Dim>
bool BSplineCurve<Dim>::closed(const std::vector<Point>& poles, double rounding) const {
  if (!knots_.clamped(true) || !knots_.clamped(false)) return false;
  if (!((poles.back() - poles.front()).cwiseAbs().maxCoeff() <= rounding)) return false;
  if (rational() && !(std::abs(weights_.back() - weights_.front()) <= closure::kSame * weights_.front())) return false;
  return std::any_of(poles.begin(), poles.end(),
                     [&](const Point& p) { return (p - poles.front()).cwiseAbs().maxCoeff() > rounding; });
}

template <int Dim>
void BSplineCurve<Dim>::join_seam(const std::vector<Point>& poles) {
  double size = 0.0;
  for (const Point& p : poles) size = std::max(size, p.cwiseAbs().maxCoeff());
  const double rounding = closure::kSame * size;
  if (knots_.periodic() || !closed(poles, rounding)) return;
  const auto& lines = knots_.lines();
  const double span = std::min(lines[1] - lines[0], lines.back() - lines[lines.size() - 2]);
  const double rate = knots_.degree() / span;
  const CurveJet<Dim> a = jet(lines.front(), piece(lines.front(), 1.0)),
                      b = jet(lines.back(), piece(lines.back(), -1.0));
  knots_.join_ends();
  seam_continuity_ = closure::kMostSmooth;
  const double bound = closure::kDerivative * rounding * rate;
  if (!((a.d2 - b.d2).cwiseAbs().maxCoeff() <= bound * rate)) seam_continuity_ = 1;
  if (!((a.d1 - b.d1).cwiseAbs().maxCoeff() <= bound)) seam_continuity_ = 0;
}

template <int Dim>
CurveJet<Dim> BSplineCurve<Dim>::evaluate(int span, double t) const {
  BasisRows<kOrders> N;
  basis_functions<kOrders>(knots_, span, t, N);
  const int p = knots_.degree(), first = span - p;
  Point A[kOrders];
  for (int k = 0; k < kOrders; ++k) {
    A[k].setZero();
    for (int i = 0; i <= p; ++i) A[k] += N[k][i] * poles_[first + i];
  }
  if (weights_.empty()) return {A[0], A[1], A[2], A[3]};
  double w[kOrders] = {};
  for (int k = 0; k < kOrders; ++k)
    for (int i = 0; i <= p; ++i) w[k] += N[k][i] * weights_[first + i];
  // A = w C, differentiated by Leibniz.
  CurveJet<Dim> j;
  j.C = A[0] / w[0];
  j.d1 = (A[1] - w[1] * j.C) / w[0];
  j.d2 = (A[2] - 2.0 * w[1] * j.d1 - w[2] * j.C) / w[0];
  j.d3 = (A[3] - 3.0 * w[1] * j.d2 - 3.0 * w[2] * j.d1 - w[3] * j.C) / w[0];
  return j;
}

template <int Dim>
std::optional<double> BSplineCurve<Dim>::period() const {
  return knots_.wraps() ? std::optional(knots_.period()) : std::nullopt;
}

template <int Dim>
CurveJet<Dim> BSplineCurve<Dim>::jet(double t) const {
  const KnotSpan span = knots_.find(t, 0.0);
  return evaluate(span.index, knots_.unwind(t, span));
}

template <int Dim>
CurveJet<Dim> BSplineCurve<Dim>::jet(double t, const CurvePiece& piece) const {
  return evaluate(piece.index, knots_.unwind(t, piece.index, piece.box));
}

template <int Dim>
CurvePiece BSplineCurve<Dim>::piece(double t, double towards) const {
  const KnotSpan span = knots_.find(t, towards);
  return {span.index, knots_.box(span)};
}

template <int Dim>
std::vector<double> BSplineCurve<Dim>::breaks(Interval range) const {
  std::vector<double> inside;
  auto add = [&](double t) {
    if (range.lo < t && t < range.hi) inside.push_back(t);
  };
  const auto& lines = knots_.lines();
  if (!knots_.wraps()) {
    for (size_t k = 1; k + 1 < lines.size(); ++k) add(lines[k]);
    return inside;
  }
  const double period = knots_.period();
  const double first = std::floor((range.lo - knots_.domain().lo) / period);
  for (double turn = first; knots_.domain().lo + turn * period < range.hi; turn += 1.0)
    for (size_t k = 0; k + 1 < lines.size(); ++k) add(lines[k] + turn * period);
  return inside;
}

template class BSplineCurve<2>;
template class BSplineCurve<3>;

}  // namespace geovor
