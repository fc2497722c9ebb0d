// How far a point of space lies from the border of a face, in a straight line: the same however the face is
// parameterized.
#pragma once

#include <vector>

#include "voronoi/face_border.h"
#include "voronoi/site_tree.h"

namespace geovor {

class BorderDistance {
 public:
  /// `step`: no two neighbouring samples of the border are farther apart, to a percent or so. REQUIRES: the
  /// surface and the border outlive the object.
  BorderDistance(const Surface& surface, const FaceBorder& border, double step);

  bool empty() const { return places_.empty(); }

  /// The distance from x to the nearest point of the border, or `limit` where it is no less. As exact as FaceBorder's
  /// places wherever the border bends little within a step.
  double to(const Xyz& x, double limit) const;

  /// A point of the border with the sum of the border's directions before and after it: turned left in the tangent
  /// plane it leads into the face, at a corner half way between its sides.
  struct Gate {
    Uv uv;
    Xyz x, along;
  };
  /// The point of the border that lies farthest in a direction. REQUIRES: !empty().
  Gate extreme(const Xyz& direction) const;

  /// The samples of a cycle strictly between two places, in order; from a place to itself: once around.
  std::vector<BorderPlace> between(BorderPlace from, BorderPlace to) const;

  /// The samples before and after the k-th.
  BorderPlace before(int k) const;
  BorderPlace after(int k) const;

  /// Within [from, to], which holds one turn of sign at most of a function of the place: where it turns from positive
  /// to negative. Converges to corners as well.
  template <class Function>
  BorderPlace turning_point(BorderPlace from, BorderPlace to, const Function& rising) const;

  const FaceBorder& border() const { return border_; }

  /// The border's unit tangent in space, also where parameters stand still (to a millionth of a radian there, as a
  /// rule).
  Xyz tangent(BorderPlace place) const;

  /// The same just before and just after the place: at a corner two.
  struct Tangents {
    Xyz arrives, leaves;
  };
  Tangents tangents(BorderPlace place) const;

 private:
  double refined(int k, const Xyz& x) const;
  BorderPlace wrapped(BorderPlace place) const;
  Xyz chord_along(BorderPlace place, double shortest) const;

  const Surface& surface_;
  const FaceBorder& border_;
  std::vector<BorderPlace> places_;
  std::vector<int> first_;  ///< of each cycle, and the number of all
  SiteTree tree_;
};

template <class Function>
BorderPlace BorderDistance::turning_point(BorderPlace from, BorderPlace to, const Function& rising) const {
  const double n = border_.segment_count(from.cycle);
  double lo = from.parameter, hi = to.parameter > lo ? to.parameter : to.parameter + n;
  constexpr int kHalvings = 52;  // of a double
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (lo + hi);
    (rising(wrapped({from.cycle, middle})) > 0.0 ? lo : hi) = middle;
  }
  return wrapped({from.cycle, 0.5 * (lo + hi)});
}

}  // namespace geovor
