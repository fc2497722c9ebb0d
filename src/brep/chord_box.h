// Boxes of the parameter plane around chords of the border, and what they tell from afar.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/interval.h"
#include "surface/forms.h"

namespace geovor {

/// The rectangle around a chord or a run of them, for NestedBoxes.
struct ChordBox {
  UvBox box;

  static ChordBox around(Uv a, Uv b) {
    return {{{std::min(a.u, b.u), std::max(a.u, b.u)}, {std::min(a.v, b.v), std::max(a.v, b.v)}}};
  }
  void include(const ChordBox& other) {
    box.u = {std::min(box.u.lo, other.box.u.lo), std::max(box.u.hi, other.box.u.hi)};
    box.v = {std::min(box.v.lo, other.box.v.lo), std::max(box.v.hi, other.box.v.hi)};
  }

  /// Whether the segment from a to b may come into the box: false is certain.
  bool may_meet(Uv a, Uv b) const {
    if (std::max(a.u, b.u) < box.u.lo || std::min(a.u, b.u) > box.u.hi) return false;
    if (std::max(a.v, b.v) < box.v.lo || std::min(a.v, b.v) > box.v.hi) return false;
    const UvVec way = b - a, to_middle = Uv{box.u.middle(), box.v.middle()} - a;
    const double reach = std::abs(way.u) * box.v.length() + std::abs(way.v) * box.u.length();
    constexpr double kRounding = 1e-9;  // a segment through a corner of the border must meet one of two boxes
    return !(2.0 * std::abs(cross(way, to_middle)) > (1.0 + kRounding) * reach);
  }

  /// A lower bound of the squared distance from p to the box in the metric I: of all ways with a given du (or dv) the
  /// shortest is as long as W du / sqrt(G) (W dv / sqrt(E)).
  double least_distance2(const FirstForm& I, Uv p) const {
    const double du = std::max({0.0, box.u.lo - p.u, p.u - box.u.hi}),
                 dv = std::max({0.0, box.v.lo - p.v, p.v - box.v.hi});
    const double W2 = std::max(I.W2(), 0.0);
    const double in_u = I.G > 0.0 ? du * du * W2 / I.G : 0.0, in_v = I.E > 0.0 ? dv * dv * W2 / I.E : 0.0;
    return std::max(in_u, in_v);
  }
};

}  // namespace geovor
