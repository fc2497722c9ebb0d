// The B-spline basis functions of one direction with two derivatives, tabulated span by span in the Bernstein form.
//
// On the span [t_i, t_i+1], with a = (t_i+1 - x) / h, b = (x - t_i) / h, h = t_i+1 - t_i, the functions that do not
// vanish there are N_r = sum_k m_rk a^(p-k) b^k, r = 0 … p, and their derivatives have the same form with p - 1 and
// p - 2. The m_rk are not negative (inserting knots makes convex sums), so that nothing cancels in N_r, at any degree;
// those of the derivatives are made from the differences of knots that belong there, however uneven the knots are.
// Outside the span the sums are the continuation of its polynomials.
#pragma once

#include <vector>

#include "surface/knot_vector.h"

namespace geovor {

/// Four doubles, for processors that take four at once.
struct alignas(32) Quad {
  double at[4];
};

class SpanBasis {
 public:
  explicit SpanBasis(const KnotVector& knots);

  int degree() const { return degree_; }

  /// Quads that hold one number for each of the functions of a degree; those that are left over are zero.
  static constexpr int quads(int degree) { return degree / 4 + 1; }

  struct Span {
    double lo, hi, per_length;  ///< t_i, t_i+1, 1 / h
    /// The m_rk of all r for order 0 (k = 0 … p), then for orders 1 (k = 0 … p - 1) and 2 (k = 0 … p - 2): quads(p)
    /// quads for each k.
    const Quad* m;
  };
  Span span(int flat_index) const {
    const Place& place = places_[row_of_span_[flat_index]];
    return {place.lo, place.hi, place.per_length, &table_[place.first]};
  }

 private:
  struct Place {
    double lo, hi, per_length;
    size_t first;  // in table_
  };
  void tabulate(const KnotVector& knots, int span);

  int degree_;
  std::vector<int> row_of_span_;  // by flat index
  std::vector<Place> places_;     // of the spans
  std::vector<Quad> table_;
};

}  // namespace geovor
