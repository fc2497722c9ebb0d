#include <GeomAdaptor_Surface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <memory>

#include "benches.h"

namespace geovor::bench {
namespace {

struct Direction {
  TColStd_Array1OfReal knots;
  TColStd_Array1OfInteger multiplicities;
  Direction(const std::vector<double>& values, int degree)
      : knots(1, static_cast<int>(values.size())), multiplicities(1, static_cast<int>(values.size())) {
    const std::vector<int> m = clamped_multiplicities(values, degree);
    for (int i = 1; i <= knots.Length(); ++i) {
      knots(i) = values[i - 1];
      multiplicities(i) = m[i - 1];
    }
  }
};

Handle(Geom_BSplineSurface) make(const Spline& s) {
  TColgp_Array2OfPnt poles(1, s.u_count(), 1, s.v_count());
  TColStd_Array2OfReal weights(1, s.u_count(), 1, s.v_count());
  for (int i = 0; i < s.u_count(); ++i) {
    for (int j = 0; j < s.v_count(); ++j) {
      const size_t at = static_cast<size_t>(i) * s.v_count() + j;
      poles(i + 1, j + 1) = gp_Pnt(s.poles[at].x(), s.poles[at].y(), s.poles[at].z());
      weights(i + 1, j + 1) = s.weights.empty() ? 1.0 : s.weights[at];
    }
  }
  const Direction u(s.u_knots, s.p), v(s.v_knots, s.q);
  if (s.weights.empty())
    return new Geom_BSplineSurface(poles, u.knots, v.knots, u.multiplicities, v.multiplicities, s.p, s.q);
  return new Geom_BSplineSurface(poles, weights, u.knots, v.knots, u.multiplicities, v.multiplicities, s.p, s.q);
}

template <class Evaluator>
void evaluate(const Evaluator& surface, const std::vector<Uv>& points) {
  gp_Pnt S;
  gp_Vec Su, Sv, Suu, Svv, Suv;
  for (const Uv p : points) {
    surface.D2(p.u, p.v, S, Su, Sv, Suu, Svv, Suv);
    keep(S);
  }
}

}  // namespace

std::vector<Contender> occ_contenders(const Spline& spline, const std::vector<Uv>& points) {
  const Handle(Geom_BSplineSurface) surface = make(spline);
  const auto adaptor = std::make_shared<GeomAdaptor_Surface>(surface);
  const int calls = static_cast<int>(points.size());
  return {{[surface, points] { evaluate(*surface, points); }, calls},
          {[adaptor, points] { evaluate(*adaptor, points); }, calls}};
}

}  // namespace geovor::bench
