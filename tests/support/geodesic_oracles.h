// What geodesics are measured against: closed forms, conservation laws, and a slow second integrator.
#pragma once

#include "geodesic/trace.h"

namespace geovor::testing {

/// Distance on the sphere of radius R about the origin.
double great_circle_distance(const Xyz& a, const Xyz& b, double R);

/// Clairaut's constant about the z axis: distance from the axis times the cosine of the angle to the parallel.
double clairaut(const SurfaceJet& j, UvVec d);

/// Classical fourth-order Runge-Kutta in equal steps on the equation with Christoffel symbols, blind to knots.
GeodesicState fine_steps(const Surface& surface, Uv start, UvVec direction, double length, int steps);

/// The unit direction at angle t at a point.
UvVec heading(const Surface& surface, Uv p, double t);

/// Distance in space between two points of a surface.
double gap(const Surface& surface, Uv a, Uv b);

/// The surface of revolution (r cos u, r sin u, v), r = 2 + 0.5 sin(2 v).
class WavyVase final : public Surface {
 public:
  SurfaceKind kind() const override { return SurfaceKind::Function; }
  UvBox domain() const override;
  std::optional<double> u_period() const override;
  SurfaceJet jet(Uv p) const override;
  using Surface::jet;
};

/// A can: for v <= R the disk of radius R about the origin in polar coordinates, beyond it the cylinder upwards. The
/// rim is a crease.
class Can final : public Surface {
 public:
  explicit Can(double radius) : radius_(radius) {}
  SurfaceKind kind() const override { return SurfaceKind::Function; }
  UvBox domain() const override;
  std::optional<double> u_period() const override;
  SurfaceJet jet(Uv p) const override { return jet(p, span(p, {0.0, 0.0})); }
  SurfaceJet jet(Uv p, const Span& span) const override;
  Span span(Uv p, UvVec towards) const override;
  int continuity() const override { return 0; }

 private:
  double radius_;
};

}  // namespace geovor::testing
