#include "make_cad/spline.h"

#include <BSplCLib.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <stdexcept>

namespace make_cad {

namespace {

TColStd_Array1OfReal to_array(const std::vector<double>& values) {
  TColStd_Array1OfReal array(1, static_cast<int>(values.size()));
  for (int i = 0; i < array.Length(); ++i) array(i + 1) = values[i];
  return array;
}

TColStd_Array1OfInteger clamped_multiplicities(const Knots& knots) {
  TColStd_Array1OfInteger mults(1, static_cast<int>(knots.values.size()));
  mults.Init(1);
  mults(1) = mults(mults.Upper()) = knots.degree + 1;
  return mults;
}

/// The weight of pole i under u = a s / (1 + (a - 1) s): the blossom of the denominator at the pole's knots, which are
/// written here in the new parameter s.
double moebius_weight(const std::vector<double>& flat, int degree, int i, double a) {
  double weight = 1.0;
  for (int k = 1; k <= degree; ++k) weight *= 1.0 + (a - 1.0) * flat[i + k];
  return weight;
}

/// s of u = a s / (1 + (a - 1) s).
double moebius_inverse(double u, double a) { return u / (a - (a - 1.0) * u); }

Knots warped(const TColStd_Array1OfReal& values, int degree, double a) {
  Knots knots{degree, {}};
  for (const double u : values) knots.values.push_back(moebius_inverse(u, a));
  return knots;
}

}  // namespace

std::vector<double> Knots::flat() const {
  std::vector<double> all(degree, values.front());
  all.insert(all.end(), values.begin(), values.end());
  all.insert(all.end(), degree, values.back());
  return all;
}

std::vector<double> Knots::greville() const {
  const std::vector<double> t = flat();
  std::vector<double> means(poles());
  for (int i = 0; i < poles(); ++i) {
    double sum = 0.0;
    for (int k = 1; k <= degree; ++k) sum += t[i + k];
    means[i] = sum / degree;
  }
  return means;
}

Knots uniform_knots(int degree, double lo, double hi, int spans) {
  Knots knots{degree, {}};
  for (int i = 0; i <= spans; ++i) knots.values.push_back(lo + (hi - lo) * i / spans);
  return knots;
}

std::vector<double> interpolate(const Knots& knots, const Function& f) {
  const std::vector<double> places = knots.greville();
  std::vector<double> coefficients;
  for (const double x : places) coefficients.push_back(f(x));
  TColStd_Array1OfInteger contact(1, knots.poles());
  contact.Init(0);
  int problem = 0;
  BSplCLib::Interpolate(knots.degree, to_array(knots.flat()), to_array(places), contact, 1, coefficients[0], problem);
  if (problem != 0) throw std::runtime_error("interpolation: singular system");
  return coefficients;
}

SplineHandle graph(const Knots& u, const Knots& v, const std::vector<Product>& terms) {
  const std::vector<double> x = u.greville(), y = v.greville();
  TColgp_Array2OfPnt poles(1, u.poles(), 1, v.poles());
  for (int i = 0; i < u.poles(); ++i)
    for (int j = 0; j < v.poles(); ++j) poles(i + 1, j + 1) = gp_Pnt(x[i], y[j], 0.0);
  for (const Product& term : terms) {
    const std::vector<double> f = interpolate(u, term.f), g = interpolate(v, term.g);
    for (int i = 0; i < u.poles(); ++i)
      for (int j = 0; j < v.poles(); ++j) {
        gp_Pnt& pole = poles(i + 1, j + 1);
        pole.SetZ(pole.Z() + f[i] * g[j]);
      }
  }
  return new Geom_BSplineSurface(poles, to_array(u.values), to_array(v.values), clamped_multiplicities(u),
                                 clamped_multiplicities(v), u.degree, v.degree);
}

SplineHandle moebius(const SplineHandle& patch, double a, double b) {
  const Knots u = warped(patch->UKnots(), patch->UDegree(), a), v = warped(patch->VKnots(), patch->VDegree(), b);
  const std::vector<double> u_flat = u.flat(), v_flat = v.flat();
  TColStd_Array2OfReal weights(1, patch->NbUPoles(), 1, patch->NbVPoles());
  for (int i = 0; i < patch->NbUPoles(); ++i)
    for (int j = 0; j < patch->NbVPoles(); ++j)
      weights(i + 1, j + 1) = moebius_weight(u_flat, u.degree, i, a) * moebius_weight(v_flat, v.degree, j, b);
  return new Geom_BSplineSurface(patch->Poles(), weights, to_array(u.values), to_array(v.values),
                                 clamped_multiplicities(u), clamped_multiplicities(v), u.degree, v.degree);
}

}  // namespace make_cad
