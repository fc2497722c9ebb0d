// The same surface under other parameters: nothing that is geometry may change under it. Every answer of geovor (a
// distance, a diagram, a mesh) is tested for being blind to it.
#pragma once

#include <memory>

#include "surface/surface.h"

namespace geovor {

/// A monotone change of one parameter, old = map(new).
class ParameterMap {
 public:
  struct Jet {
    double x, d1, d2, d3;  ///< the old parameter and its derivatives by the new one
  };
  virtual ~ParameterMap() = default;
  virtual Jet jet(double t) const = 0;
  /// The new parameter of an old one; infinite for an infinite one.
  virtual double inverse(double x) const = 0;
  /// Whether a period of the old parameter is a period (of other length) of the new one.
  virtual bool affine() const { return false; }
  bool descends() const { return jet(0.5).d1 < 0.0; }
};
using ParameterMapPtr = std::shared_ptr<const ParameterMap>;

/// x = scale t + shift; a negative scale reverses the direction. REQUIRES: scale != 0
ParameterMapPtr affine_map(double scale, double shift);

/// t in [0, 1] to x in `range` with x = lo + (hi - lo) s, s = t / (t + A (1 - t)): the change of parameter that keeps a
/// rational B-spline one. REQUIRES: A > 0
ParameterMapPtr moebius_map(Interval range, double A);

/// t in [0, 1] to x in `range` with s = t + k t (1 - t) (1 - 2 t): unequal speed at the ends and in the middle.
/// REQUIRES: -1 < k < 2
ParameterMapPtr cubic_map(Interval range, double k);

/// S'(a, b) = S(u_map(a), v_map(b)), or with the axes swapped S'(a, b) = S(u_map(b), v_map(a)). A null map leaves its
/// parameter as it is. The domain is the image of the old one; a direction stays periodic only under an affine map.
class Reparameterized final : public Surface {
 public:
  Reparameterized(SurfacePtr base, ParameterMapPtr u_map, ParameterMapPtr v_map, bool swap_axes = false);

  SurfaceKind kind() const override { return base_->kind(); }
  UvBox domain() const override;
  std::optional<double> u_period() const override;
  std::optional<double> v_period() const override;
  SurfaceJet jet(Uv p) const override;
  SurfaceJet jet(Uv p, const Span& span) const override;
  SurfaceThirds third(Uv p, const Span& span) const override;
  Xyz position(Uv p) const override { return base_->position(to_base(p)); }
  Span span(Uv p, UvVec towards) const override;
  int continuity() const override { return base_->continuity(); }

  Uv to_base(Uv p) const;    ///< parameters of the same point on the base surface
  Uv from_base(Uv p) const;  ///< the inverse of to_base
  const Surface& base() const { return *base_; }
  bool swapped() const { return swap_; }
  /// Whether the base's parameter falls as the new u (v) ascends.
  bool u_turned() const { return (swap_ ? v_map_ : u_map_)->descends(); }
  bool v_turned() const { return (swap_ ? u_map_ : v_map_)->descends(); }

 private:
  PoleCharts make_poles() const override;
  SurfaceJet chain(const SurfaceJet& b, const ParameterMap::Jet& u, const ParameterMap::Jet& v) const;
  UvBox box_from_base(const UvBox& box) const;
  UvBox box_to_base(const UvBox& box) const;

  SurfacePtr base_;
  ParameterMapPtr u_map_, v_map_;
  bool swap_;
};

}  // namespace geovor
