// Whether a B-spline surface is closed without periodic knots, and how smoothly.
#include <algorithm>
#include <cmath>
#include <vector>

#include "surface/bspline_surface.h"
#include "surface/closure.h"

namespace geovor {
namespace {

using closure::kDerivative;
using closure::kMostSmooth;
using closure::kSame;

struct Ends {
  const BSplineSurface& surface;
  bool in_u;  // the ends of u, i.e. the rows i = 0 and i = last

  const KnotVector& knots() const { return in_u ? surface.u_knots() : surface.v_knots(); }
  int along() const { return (in_u ? surface.v_knots() : surface.u_knots()).pole_count(); }
  Xyz pole(bool last, int k) const {
    const int row = last ? knots().pole_count() - 1 : 0;
    return in_u ? surface.pole(row, k) : surface.pole(k, row);
  }
  double weight(bool last, int k) const {
    const int row = last ? knots().pole_count() - 1 : 0;
    return in_u ? surface.weight(row, k) : surface.weight(k, row);
  }
};

// The size of coordinates as the file has them.
double largest_coordinate(const BSplineSurface& s) {
  double size = 0.0;
  for (int i = 0; i < s.u_knots().pole_count(); ++i)
    for (int j = 0; j < s.v_knots().pole_count(); ++j)
      size = std::max(size, (s.centre() + s.pole(i, j)).cwiseAbs().maxCoeff());
  return size;
}

// The end rows are the same, and more than a point.
bool closed(const Ends& ends, double rounding) {
  if (!ends.knots().clamped(true) || !ends.knots().clamped(false)) return false;
  bool is_point = true;
  for (int k = 0; k < ends.along(); ++k) {
    if (!((ends.pole(false, k) - ends.pole(true, k)).cwiseAbs().maxCoeff() <= rounding)) return false;
    if (!(std::abs(ends.weight(false, k) - ends.weight(true, k)) <= kSame * ends.weight(false, k))) return false;
    if ((ends.pole(false, k) - ends.pole(false, 0)).cwiseAbs().maxCoeff() > rounding) is_point = false;
  }
  return !is_point;
}

// Parameters that tell two piecewise polynomials apart.
std::vector<double> samples(const KnotVector& knots) {
  std::vector<double> found;
  const auto& lines = knots.lines();
  const int n = 2 * knots.degree() + 1;
  for (size_t i = 0; i + 1 < lines.size(); ++i)
    for (int k = 0; k < n; ++k) found.push_back(lines[i] + (lines[i + 1] - lines[i]) * (k + 0.5) / n);
  return found;
}

// The order, kMostSmooth at most, up to which the derivatives across the seam agree from both sides.
int measured_continuity(const Ends& ends, double rounding) {
  const KnotVector& knots = ends.knots();
  const auto& lines = knots.lines();
  const double span = std::min(lines[1] - lines[0], lines.back() - lines[lines.size() - 2]);
  const double rate = knots.degree() / span;
  const double first = kDerivative * rounding * rate, second = kDerivative * rounding * rate * rate;
  int order = kMostSmooth;
  for (const double x : samples(ends.in_u ? ends.surface.v_knots() : ends.surface.u_knots())) {
    auto side = [&](double at, double towards) {
      const Uv p = ends.in_u ? Uv{at, x} : Uv{x, at};
      const UvVec d = ends.in_u ? UvVec{towards, 0.0} : UvVec{0.0, towards};
      return ends.surface.jet(p, ends.surface.span(p, d));
    };
    const SurfaceJet a = side(lines.front(), 1.0), b = side(lines.back(), -1.0);
    const Xyz d1 = ends.in_u ? a.Su - b.Su : a.Sv - b.Sv, d2 = ends.in_u ? a.Suu - b.Suu : a.Svv - b.Svv;
    if (!(d2.cwiseAbs().maxCoeff() <= second)) order = std::min(order, 1);
    if (!(d1.cwiseAbs().maxCoeff() <= first)) return 0;
  }
  return order;
}

}  // namespace

void BSplineSurface::join_seams() {
  if (u_knots_.periodic() && v_knots_.periodic()) return;
  const double rounding = kSame * largest_coordinate(*this);
  for (const bool in_u : {true, false}) {
    const Ends ends{*this, in_u};
    if (!closed(ends, rounding)) continue;
    (in_u ? u_knots_ : v_knots_).join_ends();
    seam_continuity_ = std::min(seam_continuity_, measured_continuity(ends, rounding));
  }
}

}  // namespace geovor
