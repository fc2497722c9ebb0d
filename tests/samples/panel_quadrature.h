// Gauss-Legendre panels over a rectangle: the tests' own quadrature, which knows no face and no p-curve.
#pragma once

#include <array>

#include "base/interval.h"

namespace geovor::testing {

/// The integral of f(x, y) over `box`, cut into panels x panels rectangles with 5 x 5 Gauss points each.
template <class F>
double integrate_panels(const UvBox& box, int panels, const F& f) {
  constexpr std::array<double, 5> kNode = {-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                                           0.9061798459386640};
  constexpr std::array<double, 5> kWeight = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                             0.4786286704993665, 0.2369268850561891};
  const double hx = box.u.length() / panels, hy = box.v.length() / panels;
  double sum = 0.0;
  for (int i = 0; i < panels; ++i)
    for (int j = 0; j < panels; ++j)
      for (int a = 0; a < 5; ++a)
        for (int b = 0; b < 5; ++b)
          sum += kWeight[a] * kWeight[b] *
                 f(box.u.lo + hx * (i + 0.5 + 0.5 * kNode[a]), box.v.lo + hy * (j + 0.5 + 0.5 * kNode[b]));
  return 0.25 * hx * hy * sum;
}

}  // namespace geovor::testing
