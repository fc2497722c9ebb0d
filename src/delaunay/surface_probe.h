// A surface as the mesher looks at it: position, normal and curvature, also where the parameterization degenerates.
#pragma once

#include "brep/model.h"
#include "surface/surface.h"

namespace geovor {

struct SurfaceSample {
  Xyz x;
  Xyz n;  ///< unit normal Su x Sv / |Su x Sv|; at a pole its limit along the way to the middle of the box
  double curvature = 0.0;  ///< largest |normal curvature|
  bool regular = true;     ///< false where Su and Sv do not span the tangent plane
};

/// The parameters of the face's border, a little enlarged, but inside the surface's domain in directions that are not
/// periodic. REQUIRES: face.surface != nullptr.
UvBox parameter_box(const CadFace& face);

/// Evaluates a surface over a box of its parameters.
class SurfaceProbe {
 public:
  SurfaceProbe(const Surface& surface, const UvBox& box);

  SurfaceSample at(Uv p) const;
  Xyz position(Uv p) const { return surface_.position(p); }

  const Surface& surface() const { return surface_; }
  const UvBox& box() const { return box_; }
  /// Mean |Su| and |Sv| over the box: what a step of the parameters is worth in space.
  double u_speed() const { return u_speed_; }
  double v_speed() const { return v_speed_; }

 private:
  bool regular(const SurfaceJet& j) const;

  const Surface& surface_;
  UvBox box_;
  double u_speed_ = 1.0;
  double v_speed_ = 1.0;
};

}  // namespace geovor
