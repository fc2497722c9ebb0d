// A surface at a constant distance from another one.
#pragma once

#include "surface/surface.h"

namespace geovor {

/// S = B + d n with n = Bu x Bv / |Bu x Bv| (as Geom_OffsetSurface). Periods and pieces are those of the basis.
/// Exact up to the second derivatives where the basis is up to the third (Surface::third).
/// At a pole of the basis, where n has no
/// formula, the limit from inside the domain is taken. Regular only where d times the principal curvatures of the basis
/// stays below 1.
class OffsetSurface final : public Surface {
 public:
  /// Throws Error(FaceRejected) if there is no basis or the distance is not finite.
  OffsetSurface(SurfacePtr basis, double distance);

  SurfaceKind kind() const override { return SurfaceKind::Offset; }
  UvBox domain() const override { return basis_->domain(); }
  std::optional<double> u_period() const override { return basis_->u_period(); }
  std::optional<double> v_period() const override { return basis_->v_period(); }
  SurfaceJet jet(Uv p) const override { return jet(p, basis_->span(p, {})); }
  SurfaceJet jet(Uv p, const Span& span) const override;
  Xyz position(Uv p) const override;
  Span span(Uv p, UvVec towards) const override { return basis_->span(p, towards); }
  int continuity() const override;

  const Surface& basis() const { return *basis_; }
  double distance() const { return distance_; }

 private:
  PoleCharts make_poles() const override;
  Uv off_the_pole(Uv p) const;
  Xyz moved(Uv p, const SurfaceJet& basis) const;

  SurfacePtr basis_;
  double distance_;
};

}  // namespace geovor
