// Changes of a parameter whose speed falls to zero at an end of its range.
#pragma once

#include <cmath>

#include "surface/reparameterize.h"

namespace geovor::testing {

/// t in [0, 1] to x = lo + (hi - lo) t^m, m >= 2: the lines stop at the low end.
class PowerMap final : public ParameterMap {
 public:
  PowerMap(Interval range, int m) : range_(range), m_(m) {}
  Jet jet(double t) const override {
    const double L = range_.length(), m = m_;
    return {range_.lo + L * power(t, m_), L * m * power(t, m_ - 1), L * m * (m - 1) * power(t, m_ - 2),
            m_ < 3 ? 0.0 : L * m * (m - 1) * (m - 2) * power(t, m_ - 3)};
  }
  double inverse(double x) const override { return std::pow((x - range_.lo) / range_.length(), 1.0 / m_); }

 private:
  static double power(double t, int n) { return std::pow(t, n); }
  Interval range_;
  int m_;
};

/// t in [0, 1] to x = lo + (hi - lo) (3 t^2 - 2 t^3): the lines stop at both ends.
class SmoothStep final : public ParameterMap {
 public:
  explicit SmoothStep(Interval range) : range_(range) {}
  Jet jet(double t) const override {
    const double L = range_.length();
    return {range_.lo + L * t * t * (3.0 - 2.0 * t), L * 6.0 * t * (1.0 - t), L * (6.0 - 12.0 * t), -12.0 * L};
  }
  double inverse(double x) const override {
    const double s = (x - range_.lo) / range_.length();
    return 0.5 - std::sin(std::asin(1.0 - 2.0 * s) / 3.0);
  }

 private:
  Interval range_;
};

}  // namespace geovor::testing
