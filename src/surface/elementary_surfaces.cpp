#include "surface/elementary_surfaces.h"

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "surface/ellipsoid_cap.h"
#include "surface/pole_chart.h"

namespace geovor {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr Interval kFullTurn{0.0, kTwoPi};
constexpr Interval kWholeLine{-kInf, kInf};

// Axes read from text with ten digits pass; a frame that someone forgot to normalize does not.
constexpr double kAxisTolerance = 1e-9;

const Frame& checked(const Frame& f) {
  Eigen::Matrix3d axes;
  axes << f.x, f.y, f.z;
  const double defect = (axes.transpose() * axes - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(defect < kAxisTolerance) || !f.origin.allFinite())
    throw Error(ErrorCode::FaceRejected, "the placement's axes are not orthonormal; normalize them");
  return f;
}

double checked_radius(double radius) {
  if (!(radius > 0.0) || !std::isfinite(radius))
    throw Error(ErrorCode::FaceRejected, "the radius of an elementary surface is not positive; give a positive radius");
  return radius;
}

// rho(u) = cos u X + sin u Y and its derivative; the second derivative is -rho.
struct Circle {
  Xyz rho, rho_u;
  Circle(const Frame& f, double u) {
    const double c = std::cos(u), s = std::sin(u);
    rho = c * f.x + s * f.y;
    rho_u = c * f.y - s * f.x;
  }
};

// The surface of revolution C + r rho(u) + h Z with the profile (r, h)(v).
struct Profile {
  double r, h, r_v, h_v, r_vv, h_vv;
};

SurfaceJet revolve(const Frame& f, double u, const Profile& m) {
  const Circle c(f, u);
  return {f.origin + m.r * c.rho + m.h * f.z, m.r * c.rho_u, m.r_v * c.rho + m.h_v * f.z, -m.r * c.rho, m.r_v * c.rho_u,
          m.r_vv * c.rho + m.h_vv * f.z};
}

// With a straight profile.
SurfaceThirds revolve_thirds(const Frame& f, double u, const Profile& m) {
  const Circle c(f, u);
  return {-m.r * c.rho_u, -m.r_v * c.rho, m.r_vv * c.rho_u, Xyz::Zero()};
}

// With a circle for a profile: its third derivative is the first one with the other sign.
SurfaceThirds circle_thirds(const Frame& f, double u, const Profile& m) {
  SurfaceThirds t = revolve_thirds(f, u, m);
  t.vvv = -m.r_v * Circle(f, u).rho - m.h_v * f.z;
  return t;
}

}  // namespace

Plane::Plane(const Frame& frame) : frame_(checked(frame)) {}
UvBox Plane::domain() const { return {kWholeLine, kWholeLine}; }
SurfaceJet Plane::jet(Uv p) const {
  const Xyz zero = Xyz::Zero();
  return {frame_.origin + p.u * frame_.x + p.v * frame_.y, frame_.x, frame_.y, zero, zero, zero};
}
SurfaceThirds Plane::third(Uv, const Span&) const { return {Xyz::Zero(), Xyz::Zero(), Xyz::Zero(), Xyz::Zero()}; }

Cylinder::Cylinder(const Frame& frame, double radius) : frame_(checked(frame)), radius_(checked_radius(radius)) {}
UvBox Cylinder::domain() const { return {kFullTurn, kWholeLine}; }
std::optional<double> Cylinder::u_period() const { return kTwoPi; }
SurfaceJet Cylinder::jet(Uv p) const { return revolve(frame_, p.u, {radius_, p.v, 0.0, 1.0, 0.0, 0.0}); }
SurfaceThirds Cylinder::third(Uv p, const Span&) const {
  return revolve_thirds(frame_, p.u, {radius_, p.v, 0.0, 1.0, 0.0, 0.0});
}

Cone::Cone(const Frame& frame, double reference_radius, double half_angle)
    : frame_(checked(frame)),
      radius_(reference_radius),
      angle_(half_angle),
      sin_(std::sin(half_angle)),
      cos_(std::cos(half_angle)) {
  if (!(radius_ >= 0.0) || !std::isfinite(radius_))
    throw Error(ErrorCode::FaceRejected, "the radius of a cone is negative; give a radius of at least 0");
  if (!(std::abs(angle_) > 0.0 && std::abs(angle_) < 0.5 * std::numbers::pi))
    throw Error(ErrorCode::FaceRejected,
                "the half-angle of a cone is not between 0 and 90 degrees; give such an angle");
}
UvBox Cone::domain() const { return {kFullTurn, kWholeLine}; }
std::optional<double> Cone::u_period() const { return kTwoPi; }
SurfaceJet Cone::jet(Uv p) const {
  return revolve(frame_, p.u, {radius_ + p.v * sin_, p.v * cos_, sin_, cos_, 0.0, 0.0});
}
SurfaceThirds Cone::third(Uv p, const Span&) const {
  return revolve_thirds(frame_, p.u, {radius_ + p.v * sin_, p.v * cos_, sin_, cos_, 0.0, 0.0});
}

Sphere::Sphere(const Frame& frame, double radius) : frame_(checked(frame)), radius_(checked_radius(radius)) {}
UvBox Sphere::domain() const { return {kFullTurn, {-0.5 * std::numbers::pi, 0.5 * std::numbers::pi}}; }
std::optional<double> Sphere::u_period() const { return kTwoPi; }
SurfaceJet Sphere::jet(Uv p) const {
  const double c = radius_ * std::cos(p.v), s = radius_ * std::sin(p.v);
  return revolve(frame_, p.u, {c, s, -s, c, -c, -s});
}
SurfaceThirds Sphere::third(Uv p, const Span&) const {
  const double c = radius_ * std::cos(p.v), s = radius_ * std::sin(p.v);
  return circle_thirds(frame_, p.u, {c, s, -s, c, -c, -s});
}
PoleCharts Sphere::make_poles() const { return ellipsoid_poles(frame_, radius_, radius_, radius_); }

Torus::Torus(const Frame& frame, double major_radius, double minor_radius)
    : frame_(checked(frame)), major_(checked_radius(major_radius)), minor_(checked_radius(minor_radius)) {}
UvBox Torus::domain() const { return {kFullTurn, kFullTurn}; }
std::optional<double> Torus::u_period() const { return kTwoPi; }
std::optional<double> Torus::v_period() const { return kTwoPi; }
SurfaceJet Torus::jet(Uv p) const {
  const double c = minor_ * std::cos(p.v), s = minor_ * std::sin(p.v);
  return revolve(frame_, p.u, {major_ + c, s, -s, c, -c, -s});
}
SurfaceThirds Torus::third(Uv p, const Span&) const {
  const double c = minor_ * std::cos(p.v), s = minor_ * std::sin(p.v);
  return circle_thirds(frame_, p.u, {major_ + c, s, -s, c, -c, -s});
}

}  // namespace geovor
