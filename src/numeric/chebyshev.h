// Chebyshev series of a smooth function of one variable.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/interval.h"

namespace geovor {

/// The polynomial of degree n - 1 that takes given values at the n Chebyshev nodes of an interval.
class ChebyshevSeries {
 public:
  ChebyshevSeries() = default;

  /// Node k of n, ascending.
  static double node(Interval over, int k, int n) {
    return over.middle() - 0.5 * over.length() * std::cos(std::numbers::pi * (k + 0.5) / n);
  }

  /// `values[k]` belongs to node(over, k, values.size()).
  ChebyshevSeries(Interval over, const std::vector<double>& values)
      : middle_(over.middle()), scale_(2.0 / over.length()), c_(values.size()) {
    const int n = static_cast<int>(values.size());
    for (int j = 0; j < n; ++j) {
      double sum = 0.0;
      for (int k = 0; k < n; ++k) sum += values[k] * std::cos(std::numbers::pi * j * (n - 1 - k + 0.5) / n);
      c_[j] = (j == 0 ? 1.0 : 2.0) * sum / n;
    }
  }

  /// By Clenshaw's recurrence.
  double operator()(double x) const {
    const double y = 2.0 * scale_ * (x - middle_);
    double b1 = 0.0, b2 = 0.0;
    for (size_t j = c_.size(); j-- > 1;) {
      const double b0 = c_[j] + y * b1 - b2;
      b2 = b1;
      b1 = b0;
    }
    return c_.empty() ? 0.0 : c_[0] + 0.5 * y * b1 - b2;
  }

  /// The largest of the last `count` coefficients: about the error, once they fall geometrically.
  double tail(int count) const {
    double most = 0.0;
    for (size_t j = c_.size() - std::min<size_t>(count, c_.size()); j < c_.size(); ++j)
      most = std::max(most, std::abs(c_[j]));
    return most;
  }

 private:
  double middle_ = 0.0, scale_ = 1.0;  // scale_ (x - middle_) runs over [-1, 1]
  std::vector<double> c_;
};

}  // namespace geovor
