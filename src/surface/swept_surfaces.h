// Surfaces swept by a curve. The analytic pieces of the curve are those of the surface.
#pragma once

#include "surface/curve.h"
#include "surface/surface.h"

namespace geovor {

/// The curve C(v) turned by the angle u about an axis (as Geom_SurfaceOfRevolution): u of period 2 pi. Where the curve
/// meets the axis the metric vanishes.
class RevolutionSurface final : public Surface {
 public:
  /// `direction` of any length but zero. Throws Error(FaceRejected) otherwise.
  RevolutionSurface(Curve3Ptr meridian, const Xyz& origin, const Xyz& direction);

  SurfaceKind kind() const override { return SurfaceKind::Revolution; }
  UvBox domain() const override;
  std::optional<double> u_period() const override;
  std::optional<double> v_period() const override { return meridian_->period(); }
  SurfaceJet jet(Uv p) const override { return turn(p.u, meridian_->jet(p.v)); }
  SurfaceJet jet(Uv p, const Span& span) const override;
  SurfaceThirds third(Uv p, const Span& span) const override;
  Span span(Uv p, UvVec towards) const override;
  int continuity() const override { return meridian_->continuity(); }

  const Curve3& meridian() const { return *meridian_; }
  const Xyz& axis_origin() const { return origin_; }
  const Xyz& axis_direction() const { return axis_; }  ///< unit

 private:
  PoleCharts make_poles() const override;
  SurfaceJet turn(double angle, const CurveJet<3>& c) const;
  Curve3Ptr meridian_;
  Xyz origin_, axis_;
};

/// S = C(u) + v D (as Geom_SurfaceOfLinearExtrusion).
class ExtrusionSurface final : public Surface {
 public:
  /// `direction` of any length but zero, used as it is. Throws Error(FaceRejected) otherwise.
  ExtrusionSurface(Curve3Ptr profile, const Xyz& direction);

  SurfaceKind kind() const override { return SurfaceKind::Extrusion; }
  UvBox domain() const override;
  std::optional<double> u_period() const override { return profile_->period(); }
  SurfaceJet jet(Uv p) const override { return shift(p.v, profile_->jet(p.u)); }
  SurfaceJet jet(Uv p, const Span& span) const override;
  SurfaceThirds third(Uv p, const Span& span) const override;
  Span span(Uv p, UvVec towards) const override;
  int continuity() const override { return profile_->continuity(); }

  const Curve3& profile() const { return *profile_; }
  const Xyz& direction() const { return direction_; }

 private:
  SurfaceJet shift(double v, const CurveJet<3>& c) const;
  Curve3Ptr profile_;
  Xyz direction_;
};

}  // namespace geovor
