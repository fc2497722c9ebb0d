// Derivatives of a jet held against differences of the jet's own lower orders, on seeded random points.
#pragma once

#include <algorithm>
#include <random>

#include "surface/curve.h"
#include "surface/surface.h"

namespace geovor::testing {

inline double uniform(std::mt19937& random, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}

inline Uv random_point(std::mt19937& random, const UvBox& box) {
  const double u = uniform(random, box.u.lo, box.u.hi);
  return {u, uniform(random, box.v.lo, box.v.hi)};
}

/// (f(x - 2h) - 8 f(x - h) + 8 f(x + h) - f(x + 2h)) / 12h: error h^4 f^(5) / 30.
template <class Function>
auto central_difference(const Function& f, double x, double h) {
  using Value = std::decay_t<decltype(f(x))>;
  const Value near_by = f(x + h) - f(x - h), far_off = f(x + 2.0 * h) - f(x - 2.0 * h);
  return Value((8.0 * near_by - far_off) / (12.0 * h));
}

/// Worst error of the five derivatives at `count` points of `box`, relative to the largest derivative of that order
/// met. Differences stay on the analytic piece of their point. `h` is the step.
inline double worst_derivative_error(const Surface& surface, const UvBox& box, double h = 1e-3, int count = 200,
                                     unsigned seed = 1) {
  std::mt19937 random(seed);
  double first = 0.0, second = 0.0, first_size = 1e-300, second_size = 1e-300;
  for (int i = 0; i < count; ++i) {
    const Uv p = random_point(random, box);
    const Span span = surface.span(p, {1.0, 1.0});
    const SurfaceJet j = surface.jet(p, span);
    auto along_u = [&](auto member) {
      return central_difference([&](double u) -> Xyz { return surface.jet({u, p.v}, span).*member; }, p.u, h);
    };
    auto along_v = [&](auto member) {
      return central_difference([&](double v) -> Xyz { return surface.jet({p.u, v}, span).*member; }, p.v, h);
    };
    first = std::max({first, (along_u(&SurfaceJet::S) - j.Su).norm(), (along_v(&SurfaceJet::S) - j.Sv).norm()});
    second = std::max({second, (along_u(&SurfaceJet::Su) - j.Suu).norm(), (along_v(&SurfaceJet::Su) - j.Suv).norm(),
                       (along_u(&SurfaceJet::Sv) - j.Suv).norm(), (along_v(&SurfaceJet::Sv) - j.Svv).norm()});
    first_size = std::max({first_size, j.Su.norm(), j.Sv.norm()});
    second_size = std::max({second_size, j.Suu.norm(), j.Suv.norm(), j.Svv.norm()});
  }
  return std::max(first / first_size, second / std::max(second_size, first_size));
}

/// The same for a curve.
template <int Dim>
double worst_derivative_error(const Curve<Dim>& curve, Interval range, double h = 1e-3, int count = 100) {
  std::mt19937 random(1);
  double error = 0.0, size = 1e-300;
  for (int i = 0; i < count; ++i) {
    const double t = uniform(random, range.lo, range.hi);
    const CurvePiece piece = curve.piece(t, 1.0);
    const CurveJet<Dim> j = curve.jet(t, piece);
    auto along = [&](auto member) {
      return central_difference([&](double s) -> typename Curve<Dim>::Point { return curve.jet(s, piece).*member; }, t,
                                h);
    };
    error = std::max({error, (along(&CurveJet<Dim>::C) - j.d1).norm(), (along(&CurveJet<Dim>::d1) - j.d2).norm(),
                      (along(&CurveJet<Dim>::d2) - j.d3).norm()});
    size = std::max({size, j.d1.norm(), j.d2.norm(), j.d3.norm()});
  }
  return error / size;
}

/// Largest difference of two jets, component by component.
inline double distance(const SurfaceJet& a, const SurfaceJet& b) {
  return std::max({(a.S - b.S).norm(), (a.Su - b.Su).norm(), (a.Sv - b.Sv).norm(), (a.Suu - b.Suu).norm(),
                   (a.Suv - b.Suv).norm(), (a.Svv - b.Svv).norm()});
}

}  // namespace geovor::testing
