// The knots of one parametric direction of a B-spline, periodic or not, with the search for the span of a parameter.
#pragma once

#include <cmath>
#include <vector>

#include "base/interval.h"

namespace geovor {

/// Highest degree of a B-spline (that of OpenCASCADE).
inline constexpr int kMaxDegree = 25;

/// A span as a knot vector knows it: the flat index i of the non-empty interval [t_i, t_i+1], and how many whole
/// periods the parameter asked for lies beyond the principal one.
struct KnotSpan {
  int index = 0;
  double turns = 0.0;
};

/// Knots t_0 <= t_1 <= … with degree p. Periodic knots are unrolled at construction: the flat sequence is continued by
/// p knots beyond each end of the period, so that evaluation knows one case only.
class KnotVector {
 public:
  /// As CAD files state them: ascending distinct knots with multiplicities. Not periodic: poles = sum of the
  /// multiplicities - p - 1. Periodic: the last knot repeats the first one, poles = sum of the multiplicities without
  /// the last. Throws Error(FaceRejected) if the knots do not ascend or a multiplicity is out of range.
  KnotVector(const std::vector<double>& knots, const std::vector<int>& multiplicities, int degree,
             bool periodic = false);

  /// The flat sequence, equal knots repeated; not periodic.
  static KnotVector from_flat(const std::vector<double>& flat, int degree);

  int degree() const { return degree_; }
  bool periodic() const { return periodic_; }
  /// The ends of the domain are one place: what is asked for beyond them lies on the other side. So it is with periodic
  /// knots, and with others after join_ends(), for curves and surfaces that are closed without saying so.
  bool wraps() const { return wraps_; }
  void join_ends() { wraps_ = true; }
  double period() const { return domain_.length(); }  ///< REQUIRES: wraps()
  const Interval& domain() const { return domain_; }
  /// Whether the curve's end at the low (high) end of the domain is its first (last) pole.
  bool clamped(bool low) const;
  /// Number of poles that the caller has to give.
  int pole_count() const { return pole_count_; }
  /// Number of poles after unrolling: pole j of the unrolled row is pole j mod pole_count().
  int unrolled_count() const { return static_cast<int>(flat_.size()) - degree_ - 1; }
  const std::vector<double>& flat() const { return flat_; }
  /// Distinct knots of the domain, both ends included.
  const std::vector<double>& lines() const { return lines_; }
  /// Smallest order of continuity at the knots inside the domain (and, if periodic, across its ends, but not across
  /// joined ones); `smooth` where there are none.
  int continuity(int smooth) const;

  /// The span that holds x; on a knot (to rounding) the one into which the sign of `towards` points, the right one if
  /// that is 0. Outside a domain that does not wrap: the outermost span.
  KnotSpan find(double x, double towards) const {
    // Mostly x lies inside the span in the middle of its bucket.
    const double place = (x - domain_.lo) * buckets_per_unit_;
    if (place >= 0.0 && place < static_cast<int>(guess_.size())) {
      const Guess& guess = guess_[static_cast<int>(place)];
      if (x - guess.lo > rounding_ && guess.hi - x > rounding_) return {guess.span, 0.0};
    }
    return search(x, towards);
  }

  /// Borders of a span around the parameter asked for: infinite where a domain that does not wrap ends, so that the
  /// outermost span holds everything beyond.
  Interval box(const KnotSpan& span) const;

  /// The parameter x, for which `span` was found, in the principal period.
  double unwind(double x, const KnotSpan& span) const { return span.turns == 0.0 ? x : x - span.turns * period(); }

  /// x moved by whole periods into the principal copy of a span whose box, as asked for, was `box`.
  double unwind(double x, int span, const Interval& box) const {
    if (!wraps_ || box.lo == flat_[span]) return x;
    return x - std::round((box.lo - flat_[span]) / period()) * period();
  }

  /// Reciprocals 1 / (t_{i+1+r} - t_{i+1+r-q}), q = 1 … p, r = 0 … q-1, of span i, that the recurrences of the basis
  /// functions need; entry (q, r) is at q (q - 1) / 2 + r.
  const double* reciprocals(int span) const { return &reciprocals_[row_of_span_[span] * reciprocal_stride_]; }

 private:
  void unroll(const std::vector<double>& knots, const std::vector<int>& multiplicities);
  void index_spans();
  KnotSpan search(double x, double towards) const;
  int line_below(double x) const;

  struct Guess {
    double lo, hi;
    int span;  // flat index
  };

  int degree_;
  bool periodic_;
  bool wraps_;
  int pole_count_ = 0;
  Interval domain_;
  double rounding_ = 0.0;  // parameters closer than this are the same
  std::vector<double> flat_;
  std::vector<double> lines_;
  std::vector<int> span_of_line_;  // flat index of the span that begins at lines_[k]
  std::vector<int> multiplicity_;  // of lines_[k]
  std::vector<int> bucket_;        // greatest k with lines_[k] <= left end of the bucket
  std::vector<Guess> guess_;       // the span that holds the middle of the bucket
  double buckets_per_unit_ = 0.0;
  std::vector<int> row_of_span_;  // by flat index: row of reciprocals_
  int reciprocal_stride_ = 0;
  std::vector<double> reciprocals_;
};

}  // namespace geovor
