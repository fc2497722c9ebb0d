// An index of border segments of the parameter plane that answers "on which side?" in constant time.
#pragma once

#include <vector>

#include "base/interval.h"

namespace geovor {

struct BorderSegment {
  Uv a, b;
};

enum class Side { Inside, Outside, OnBorder };

/// Segments of closed polylines, sorted into bands of v. The region they bound is what a ray leaves an odd number of
/// times, so the way that the loops turn doesn't matter here.
class BorderIndex {
 public:
  BorderIndex() = default;
  /// `box` holds all segments.
  BorderIndex(const std::vector<BorderSegment>& segments, const UvBox& box);

  /// OnBorder: within rounding of a segment (some ulps of the box's coordinates).
  Side side(Uv p) const;

  /// The u, ascending, where the line of this v crosses the border; an even number of them.
  std::vector<double> crossings(double v) const;

  /// Adds to `k` the places of lerp(a, b, k), 0 <= k <= 1, where the segment meets the border (parallel segments left
  /// out; a place may come more than once).
  void meet(Uv a, Uv b, std::vector<double>& k) const;

  const UvBox& box() const { return box_; }
  double rounding_u() const { return eps_u_; }
  double rounding_v() const { return eps_v_; }

 private:
  struct Entry {
    Uv a, b;
    double slack;  ///< bound of |cross| for points within rounding of the segment's line
  };
  int band(double v) const;

  UvBox box_;
  double eps_u_ = 0.0, eps_v_ = 0.0;
  double bands_per_v_ = 0.0;
  int bands_ = 0;
  std::vector<int> first_;      ///< the entries of band i are first_[i] … first_[i + 1] - 1
  std::vector<Entry> entries_;  ///< a copy a band, so that a query reads memory in one run
};

}  // namespace geovor
