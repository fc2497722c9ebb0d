// A surface as the mesher looks at it: position, normal and curvature, also where the parameterization degenerates.
#pragma once

#include "brep/model.h"
#include "surface/shape.h"

namespace geovor {

struct SurfaceSample {
  Xyz x;
  Xyz n;                   ///< unit normal Su x Sv / |Su x Sv| or its limit: see ShapeField
  double curvature = 0.0;  ///< largest |normal curvature|
  bool regular = true;  ///< false where there is no tangent plane (the tip of a cone); n and curvature are those of a
                        ///< place a little towards the middle of the box
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
  double u_speed() const { return shapes_.u_speed(); }
  double v_speed() const { return shapes_.v_speed(); }

 private:
  const Surface& surface_;
  UvBox box_;
  ShapeField shapes_;
};

}  // namespace geovor
