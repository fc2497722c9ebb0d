// B-spline surfaces for the samples: graphs z = f(u) g(v) by interpolation, and one patch under other
// parameterizations.
#pragma once

#include <functional>
#include <vector>

class Geom_BSplineSurface;

namespace opencascade {
template <class T>
class handle;
}

namespace make_cad {

using SplineHandle = opencascade::handle<Geom_BSplineSurface>;
using Function = std::function<double(double)>;

/// A clamped knot vector: the ends carry multiplicity degree + 1, the inside knots 1.
struct Knots {
  int degree = 0;
  std::vector<double> values;  ///< ascending, each once

  int poles() const { return static_cast<int>(values.size()) + degree - 1; }
  std::vector<double> flat() const;
  /// Means of `degree` neighbouring knots: the coefficients of the identity map, and good places to interpolate at.
  std::vector<double> greville() const;
};

/// Knots at `spans` + 1 equal steps from lo to hi.
Knots uniform_knots(int degree, double lo, double hi, int spans);

/// Coefficients of the spline that takes the values of `f` at the Greville points.
std::vector<double> interpolate(const Knots& knots, const Function& f);

/// The graph (u, v, sum_k f_k(u) g_k(v)) with x = u and y = v exactly; each factor is interpolated on its knots.
struct Product {
  Function f, g;
};
SplineHandle graph(const Knots& u, const Knots& v, const std::vector<Product>& terms);

/// The same points under the map u = a s / (1 + (a - 1) s), s in [0, 1], of a patch on [0, 1]: weights appear, the
/// shape stays. The same in v with b.
SplineHandle moebius(const SplineHandle& patch, double a, double b);

}  // namespace make_cad
