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

HeightJet Paraboloid::height(Uv p) const { return {p.u * p.u + p.v * p.v, 2.0 * p.u, 2.0 * p.v, 2.0, 0.0, 2.0}; }

HeightJet MonkeySaddle::height(Uv p) const {
  const double u = p.u, v = p.v;
  return {u * (u * u - 3.0 * v * v), 3.0 * (u * u - v * v), -6.0 * u * v, 6.0 * u, -6.0 * v, -6.0 * u};
}

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

UvBox Ellipsoid::domain() const { return {kFullTurn, {-0.5 * kPi, 0.5 * kPi}}; }
std::optional<double> Ellipsoid::u_period() const { return kFullTurn.length(); }
SurfaceJet Ellipsoid::jet(Uv p) const {
  const double cu = std::cos(p.u), su = std::sin(p.u), cv = std::cos(p.v), sv = std::sin(p.v);
  const double a = a_, b = b_, c = c_;
  return {{a * cu * cv, b * su * cv, c * sv}, {-a * su * cv, b * cu * cv, 0.0}, {-a * cu * sv, -b * su * sv, c * cv},
          {-a * cu * cv, -b * su * cv, 0.0},  {a * su * sv, -b * cu * sv, 0.0}, {-a * cu * cv, -b * su * cv, -c * sv}};
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

SurfaceJet Helicoid::jet(Uv p) const {
  const double cu = std::cos(p.u), su = std::sin(p.u), v = p.v;
  return {{v * cu, v * su, c_ * p.u}, {-v * su, v * cu, c_}, {cu, su, 0.0},
          {-v * cu, -v * su, 0.0},    {-su, cu, 0.0},        {0.0, 0.0, 0.0}};
}

}  // namespace geovor
