// A surface that counts how often it is evaluated.
#pragma once

#include "surface/surface.h"

namespace geovor::bench {

/// The base, which outlives it, with the same pieces and no poles. Not for several threads.
class CountingSurface final : public Surface {
 public:
  explicit CountingSurface(const Surface& base) : base_(base) {}

  SurfaceKind kind() const override { return base_.kind(); }
  UvBox domain() const override { return base_.domain(); }
  std::optional<double> u_period() const override { return base_.u_period(); }
  std::optional<double> v_period() const override { return base_.v_period(); }
  SurfaceJet jet(Uv p) const override { return ++count_, base_.jet(p); }
  SurfaceJet jet(Uv p, const Span& span) const override { return ++count_, base_.jet(p, span); }
  SurfaceThirds third(Uv p, const Span& span) const override { return ++count_, base_.third(p, span); }
  Xyz position(Uv p) const override { return ++count_, base_.position(p); }
  Span span(Uv p, UvVec towards) const override { return base_.span(p, towards); }
  int continuity() const override { return base_.continuity(); }

  long count() const { return count_; }
  void reset() { count_ = 0; }

 private:
  const Surface& base_;
  mutable long count_ = 0;
};

}  // namespace geovor::bench
