// A root of a continuous function of one variable between two points where its signs differ.
#pragma once

#include <cmath>

namespace geovor {

/// s in [a, b] with f(s) = 0, to `tolerance` in s, by the method of false position in the form of Illinois, with a
/// bisection wherever that is slow. An end where f vanishes, or where both ends have the same sign the end where |f| is
/// smaller, is the answer at once. NaN counts as positive. REQUIRES: a < b
template <class F>
double root_between(F&& f, double a, double b, double tolerance) {
  constexpr int kFast = 12;  // steps of false position before bisection is mixed in
  constexpr int kEnough = 200;
  double fa = f(a), fb = f(b);
  if ((fa > 0.0) == (fb > 0.0)) return std::abs(fa) <= std::abs(fb) ? a : b;
  for (int i = 0, side = 0; i < kEnough && b - a > tolerance && fa != 0.0 && fb != 0.0; ++i) {
    const bool bisect = i >= kFast && i % 2 == 0;
    double s = bisect ? 0.5 * (a + b) : (a * fb - b * fa) / (fb - fa);
    if (!(s > a && s < b)) s = 0.5 * (a + b);
    if (s == a || s == b) break;
    const double fs = f(s);
    if ((fs > 0.0) == (fb > 0.0)) {
      b = s;
      fb = fs;
      if (side == 1) fa *= 0.5;
      side = 1;
    } else {
      a = s;
      fa = fs;
      if (side == -1) fb *= 0.5;
      side = -1;
    }
  }
  return std::abs(fa) < std::abs(fb) ? a : b;
}

}  // namespace geovor
