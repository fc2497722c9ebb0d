#include "surface/analytic_surfaces.h"

#include <cmath>
#include <numbers>

#include "surface/ellipsoid_cap.h"
#include "surface/pole_chart.h"

namespace geovor {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr Interval kFullTurn{0.0, 2.0 * kPi};

}  // namespace

HeightJet WaveSurface::height(Uv p) const {
  const double su = std::sin(p.u), cu = std::cos(p.u), sv = std::sin(p.v), cv = std::cos(p.v);
  return {su * cv, cu * cv, -su * sv, -su * cv, -cu * sv, -su * cv};
}

HeightThirds WaveSurface::height_thirds(Uv p) const {
  const double su = std::sin(p.u), cu = std::cos(p.u), sv = std::sin(p.v), cv = std::cos(p.v);
  return {-cu * cv, su * sv, -cu * cv, su * sv};
}

HeightJet Paraboloid::height(Uv p) const { return {p.u * p.u + p.v * p.v, 2.0 * p.u, 2.0 * p.v, 2.0, 0.0, 2.0}; }
HeightThirds Paraboloid::height_thirds(Uv) const { return {0.0, 0.0, 0.0, 0.0}; }

HeightJet MonkeySaddle::height(Uv p) const {
  const double u = p.u, v = p.v;
  return {u * (u * u - 3.0 * v * v), 3.0 * (u * u - v * v), -6.0 * u * v, 6.0 * u, -6.0 * v, -6.0 * u};
}
HeightThirds MonkeySaddle::height_thirds(Uv) const { return {6.0, 0.0, -6.0, 0.0}; }

HeightJet GaussianBumps::height(Uv p) const {
  HeightJet h{0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  for (const Bump& bump : bumps_) {
    const double x = (p.u - bump.centre.u) / bump.width, y = (p.v - bump.centre.v) / bump.width;
    const double f = bump.height * std::exp(-0.5 * (x * x + y * y));
    const double f1 = f / bump.width, f2 = f1 / bump.width;
    h.f += f;
    h.fu -= x * f1;
    h.fv -= y * f1;
    h.fuu += (x * x - 1.0) * f2;
    h.fuv += x * y * f2;
    h.fvv += (y * y - 1.0) * f2;
  }
  return h;
}

// Hermite's polynomials: the third derivative of exp(-x^2/2) is (3x - x^3) exp(-x^2/2).
HeightThirds GaussianBumps::height_thirds(Uv p) const {
  HeightThirds h{0.0, 0.0, 0.0, 0.0};
  for (const Bump& bump : bumps_) {
    const double x = (p.u - bump.centre.u) / bump.width, y = (p.v - bump.centre.v) / bump.width;
    const double f3 = bump.height * std::exp(-0.5 * (x * x + y * y)) / (bump.width * bump.width * bump.width);
    h.fuuu += x * (3.0 - x * x) * f3;
    h.fuuv += y * (1.0 - x * x) * f3;
    h.fuvv += x * (1.0 - y * y) * f3;
    h.fvvv += y * (3.0 - y * y) * f3;
  }
  return h;
}

UvBox Ellipsoid::domain() const { return {kFullTurn, {-0.5 * kPi, 0.5 * kPi}}; }
std::optional<double> Ellipsoid::u_period() const { return kFullTurn.length(); }
SurfaceJet Ellipsoid::jet(Uv p) const {
  const double cu = std::cos(p.u), su = std::sin(p.u), cv = std::cos(p.v), sv = std::sin(p.v);
  const double a = a_, b = b_, c = c_;
  return {{a * cu * cv, b * su * cv, c * sv}, {-a * su * cv, b * cu * cv, 0.0}, {-a * cu * sv, -b * su * sv, c * cv},
          {-a * cu * cv, -b * su * cv, 0.0},  {a * su * sv, -b * cu * sv, 0.0}, {-a * cu * cv, -b * su * cv, -c * sv}};
}

SurfaceThirds Ellipsoid::third(Uv p, const Span&) const {
  const double cu = std::cos(p.u), su = std::sin(p.u), cv = std::cos(p.v), sv = std::sin(p.v);
  return {{a_ * su * cv, -b_ * cu * cv, 0.0},
          {a_ * cu * sv, b_ * su * sv, 0.0},
          {a_ * su * cv, -b_ * cu * cv, 0.0},
          {a_ * cu * sv, b_ * su * sv, -c_ * cv}};
}
PoleCharts Ellipsoid::make_poles() const { return ellipsoid_poles({}, a_, b_, c_); }

UvBox Catenoid::domain() const { return {kFullTurn, v_range_}; }
std::optional<double> Catenoid::u_period() const { return kFullTurn.length(); }
SurfaceJet Catenoid::jet(Uv p) const {
  const double cu = std::cos(p.u), su = std::sin(p.u);
  const double r = c_ * std::cosh(p.v / c_), r1 = std::sinh(p.v / c_), r2 = std::cosh(p.v / c_) / c_;
  return {{r * cu, r * su, p.v},   {-r * su, r * cu, 0.0},   {r1 * cu, r1 * su, 1.0},
          {-r * cu, -r * su, 0.0}, {-r1 * su, r1 * cu, 0.0}, {r2 * cu, r2 * su, 0.0}};
}
SurfaceThirds Catenoid::third(Uv p, const Span&) const {
  const double cu = std::cos(p.u), su = std::sin(p.u);
  const double r = c_ * std::cosh(p.v / c_), r1 = std::sinh(p.v / c_), r2 = std::cosh(p.v / c_) / c_;
  const double r3 = r1 / (c_ * c_);
  return {{r * su, -r * cu, 0.0}, {-r1 * cu, -r1 * su, 0.0}, {-r2 * su, r2 * cu, 0.0}, {r3 * cu, r3 * su, 0.0}};
}

SurfaceJet Helicoid::jet(Uv p) const {
  const double cu = std::cos(p.u), su = std::sin(p.u), v = p.v;
  return {{v * cu, v * su, c_ * p.u}, {-v * su, v * cu, c_}, {cu, su, 0.0},
          {-v * cu, -v * su, 0.0},    {-su, cu, 0.0},        {0.0, 0.0, 0.0}};
}
SurfaceThirds Helicoid::third(Uv p, const Span&) const {
  const double cu = std::cos(p.u), su = std::sin(p.u), v = p.v;
  return {{v * su, -v * cu, 0.0}, {-cu, -su, 0.0}, Xyz::Zero(), Xyz::Zero()};
}

}  // namespace geovor
