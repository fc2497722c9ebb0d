// A straight p-curve, for the tests of every room.
#pragma once

#include "base/uv.h"
#include "surface/curve.h"

namespace geovor::testing {

/// The straight segment from a (t = 0) to b (t = 1) of the parameter plane.
class Segment final : public Curve2 {
 public:
  Segment(Uv a, Uv b) : a_(a), b_(b) {}
  Interval domain() const override { return {0, 1}; }
  CurveJet<2> jet(double t) const override {
    const Uv p = at(t);
    const UvVec d = direction();
    return {{p.u, p.v}, {d.u, d.v}, {0, 0}, {0, 0}};
  }
  Uv at(double t) const { return lerp(a_, b_, t); }
  UvVec direction() const { return b_ - a_; }

 private:
  Uv a_, b_;
};

}  // namespace geovor::testing
