// The five elementary surfaces in closed form. Parameterizations, angles in radians, are those of OpenCASCADE's
// Geom_Plane, Geom_CylindricalSurface, Geom_ConicalSurface, Geom_SphericalSurface and Geom_ToroidalSurface; below C, X,
// Y, Z are the frame's origin and axes, and rho(u) = cos u X + sin u Y. Constructors throw Error(FaceRejected) for a
// radius or an angle without sense and for axes that are not orthonormal.
#pragma once

#include "surface/frame.h"
#include "surface/surface.h"

namespace geovor {

/// S = C + u X + v Y.
class Plane final : public Surface {
 public:
  explicit Plane(const Frame& frame);
  SurfaceKind kind() const override { return SurfaceKind::Plane; }
  UvBox domain() const override;
  SurfaceJet jet(Uv p) const override;
  SurfaceThirds third(Uv p, const Span& span) const override;
  using Surface::jet;
  const Frame& frame() const { return frame_; }

 private:
  Frame frame_;
};

/// S = C + R rho(u) + v Z, u of period 2 pi.
class Cylinder final : public Surface {
 public:
  Cylinder(const Frame& frame, double radius);
  SurfaceKind kind() const override { return SurfaceKind::Cylinder; }
  UvBox domain() const override;
  std::optional<double> u_period() const override;
  SurfaceJet jet(Uv p) const override;
  SurfaceThirds third(Uv p, const Span& span) const override;
  using Surface::jet;
  const Frame& frame() const { return frame_; }
  double radius() const { return radius_; }

 private:
  Frame frame_;
  double radius_;
};

/// S = C + (R + v sin a) rho(u) + v cos a Z, u of period 2 pi, 0 < |a| < pi/2. The domain holds both nappes; the metric
/// vanishes at the apex.
class Cone final : public Surface {
 public:
  Cone(const Frame& frame, double reference_radius, double half_angle);
  SurfaceKind kind() const override { return SurfaceKind::Cone; }
  UvBox domain() const override;
  std::optional<double> u_period() const override;
  SurfaceJet jet(Uv p) const override;
  SurfaceThirds third(Uv p, const Span& span) const override;
  using Surface::jet;
  const Frame& frame() const { return frame_; }
  double reference_radius() const { return radius_; }
  double half_angle() const { return angle_; }
  double apex_v() const { return -radius_ / sin_; }
  Xyz apex() const { return frame_.origin + apex_v() * cos_ * frame_.z; }

 private:
  Frame frame_;
  double radius_, angle_, sin_, cos_;
};

/// S = C + R cos v rho(u) + R sin v Z, u of period 2 pi, -pi/2 <= v <= pi/2 (the poles).
class Sphere final : public Surface {
 public:
  Sphere(const Frame& frame, double radius);
  SurfaceKind kind() const override { return SurfaceKind::Sphere; }
  UvBox domain() const override;
  std::optional<double> u_period() const override;
  SurfaceJet jet(Uv p) const override;
  SurfaceThirds third(Uv p, const Span& span) const override;
  using Surface::jet;
  const Frame& frame() const { return frame_; }
  double radius() const { return radius_; }

 private:
  PoleCharts make_poles() const override;
  Frame frame_;
  double radius_;
};

/// S = C + (R + r cos v) rho(u) + r sin v Z, both of period 2 pi. R < r (a spindle torus) is allowed.
class Torus final : public Surface {
 public:
  Torus(const Frame& frame, double major_radius, double minor_radius);
  SurfaceKind kind() const override { return SurfaceKind::Torus; }
  UvBox domain() const override;
  std::optional<double> u_period() const override;
  std::optional<double> v_period() const override;
  SurfaceJet jet(Uv p) const override;
  SurfaceThirds third(Uv p, const Span& span) const override;
  using Surface::jet;
  const Frame& frame() const { return frame_; }
  double major_radius() const { return major_; }
  double minor_radius() const { return minor_; }

 private:
  Frame frame_;
  double major_, minor_;
};

}  // namespace geovor
