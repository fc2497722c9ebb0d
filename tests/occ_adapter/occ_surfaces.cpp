#include "occ_adapter/occ_surfaces.h"

#include <GeomConvert.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Ellipse.hxx>
#include <Geom_Hyperbola.hxx>
#include <Geom_Line.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_Parabola.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <gp_Ax1.hxx>
#include <gp_Ax2.hxx>
#include <gp_Ax3.hxx>
#include <numbers>
#include <random>

namespace geovor::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTwoPi = 2.0 * kPi;

// Turned every way, and left-handed where asked.
gp_Ax3 axes(bool left_handed = false) {
  gp_Ax3 a(gp_Pnt(1.0, -2.0, 3.0), gp_Dir(0.3, -0.5, 0.8), gp_Dir(0.9, 0.1, 0.2));
  if (left_handed) a.YReverse();
  return a;
}

struct Direction {
  int degree;
  std::vector<int> multiplicities;
  bool periodic = false;
};

/// Inner knots of the multiplicities 1, 2, … up to `highest`, the ends clamped.
Direction clamped(int degree, int highest) {
  Direction d{degree, {degree + 1}};
  for (int m = 1; m <= highest; ++m) d.multiplicities.push_back(m);
  d.multiplicities.push_back(degree + 1);
  return d;
}

int pole_count(const Direction& d) {
  int sum = 0;
  for (int m : d.multiplicities) sum += m;
  return d.periodic ? sum - d.multiplicities.back() : sum - d.degree - 1;
}

Handle(Geom_BSplineSurface) spline(const Direction& u, const Direction& v, bool rational, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> jitter(-0.2, 0.2), weight(0.5, 2.0), gap(0.5, 1.5);
  auto knots = [&](const Direction& d) {
    TColStd_Array1OfReal k(1, static_cast<int>(d.multiplicities.size()));
    k(1) = -1.0;
    for (int i = 2; i <= k.Upper(); ++i) k(i) = k(i - 1) + gap(random);
    return k;
  };
  auto multiplicities = [](const Direction& d) {
    TColStd_Array1OfInteger m(1, static_cast<int>(d.multiplicities.size()));
    for (int i = 1; i <= m.Upper(); ++i) m(i) = d.multiplicities[i - 1];
    return m;
  };
  const int nu = pole_count(u), nv = pole_count(v);
  TColgp_Array2OfPnt poles(1, nu, 1, nv);
  TColStd_Array2OfReal weights(1, nu, 1, nv);
  for (int i = 1; i <= nu; ++i) {
    for (int j = 1; j <= nv; ++j) {
      // Round about the x axis in a periodic direction.
      const double x = 4.0 * i / nu, y = 4.0 * j / nv, a = kTwoPi * i / nu;
      const gp_Pnt p = u.periodic ? gp_Pnt(y, 2.0 * std::cos(a), 2.0 * std::sin(a)) : gp_Pnt(x, y, 0.0);
      poles(i, j) = p.Translated(gp_Vec(jitter(random), jitter(random), jitter(random)));
      weights(i, j) = rational ? weight(random) : 1.0;
    }
  }
  const TColStd_Array1OfReal uk = knots(u), vk = knots(v);
  if (!rational)
    return new Geom_BSplineSurface(poles, uk, vk, multiplicities(u), multiplicities(v), u.degree, v.degree, u.periodic,
                                   v.periodic);
  return new Geom_BSplineSurface(poles, weights, uk, vk, multiplicities(u), multiplicities(v), u.degree, v.degree,
                                 u.periodic, v.periodic);
}

Handle(Geom_BezierSurface) bezier(int p, int q, bool rational) {
  const auto patch = spline({p, {p + 1, p + 1}}, {q, {q + 1, q + 1}}, rational, 7);
  TColgp_Array2OfPnt poles(1, p + 1, 1, q + 1);
  TColStd_Array2OfReal weights(1, p + 1, 1, q + 1);
  patch->Poles(poles);
  patch->Weights(weights);
  return rational ? new Geom_BezierSurface(poles, weights) : new Geom_BezierSurface(poles);
}

Handle(Geom_BSplineCurve) profile() {
  TColgp_Array1OfPnt poles(1, 7);
  const double radius[] = {1.0, 1.5, 1.2, 2.0, 1.4, 1.1, 1.6};
  for (int i = 1; i <= 7; ++i) poles(i) = gp_Pnt(radius[i - 1], 0.1 * i, i);
  TColStd_Array1OfReal knots(1, 4);
  TColStd_Array1OfInteger multiplicities(1, 4);
  for (int i = 1; i <= 4; ++i) knots(i) = i;
  multiplicities(1) = multiplicities(4) = 4;
  multiplicities(2) = 1;
  multiplicities(3) = 2;
  return new Geom_BSplineCurve(poles, knots, multiplicities, 3);
}

UvBox bounds(const Handle(Geom_Surface) & s) {
  UvBox box;
  s->Bounds(box.u.lo, box.u.hi, box.v.lo, box.v.hi);
  return box;
}

OccSurface whole(const std::string& name, const Handle(Geom_Surface) & s) { return {name, s, bounds(s), {}}; }

// What offsets and trims are made of.
std::vector<OccSurface> bases() {
  std::vector<OccSurface> all = elementary_surfaces();
  for (const OccSurface& s : swept_surfaces()) all.push_back(s);
  for (int p : {2, 3, 5, 9}) {
    for (bool rational : {false, true}) {
      const std::string name = (rational ? "rational spline " : "polynomial spline ") + std::to_string(p);
      all.push_back(whole(name, spline({p, {p + 1, 1, p + 1}}, {4, {5, 1, 5}}, rational, p)));
    }
  }
  return all;
}

}  // namespace

std::vector<OccSurface> elementary_surfaces() {
  std::vector<OccSurface> all;
  for (bool left : {false, true}) {
    const gp_Ax3 a = axes(left);
    const std::string hand = left ? "left-handed " : "";
    const Interval turn{-1.0, 8.0};
    all.push_back({hand + "plane", new Geom_Plane(a), {{-5, 5}, {-5, 5}}, {{0, 0}}});
    all.push_back({hand + "cylinder", new Geom_CylindricalSurface(a, 2.5), {turn, {-5, 5}}, {{0, 0}, {kTwoPi, 1}}});
    for (double angle : {0.4, -0.4}) {
      // One side of the apex: beyond it OpenCASCADE's offset has another normal than the cone's map. The plain cone is
      // looked at there, too.
      const double apex = -2.0 / std::sin(angle);
      const Interval side = apex < 0.0 ? Interval{apex, 9.0} : Interval{-9.0, apex};
      all.push_back(
          {hand + "cone", new Geom_ConicalSurface(a, angle, 2.0), {turn, side}, {{1, apex}, {2, 1.3 * apex}, {0, 0}}});
    }
    all.push_back({hand + "sphere",
                   new Geom_SphericalSurface(a, 3.0),
                   {turn, {-kPi / 2, kPi / 2}},
                   {{1, kPi / 2}, {2, -kPi / 2}, {0, 0}, {kTwoPi, 0.3}}});
    all.push_back({hand + "torus", new Geom_ToroidalSurface(a, 3.0, 1.0), {turn, turn}, {{0, kPi}, {kTwoPi, kTwoPi}}});
  }
  return all;
}

std::vector<OccSurface> spline_surfaces() {
  std::vector<OccSurface> all;
  auto add = [&all](const std::string& name, int p, int q, const Handle(Geom_Surface) & s) {
    all.push_back(whole(name + " (" + std::to_string(p) + ", " + std::to_string(q) + ")", s));
  };
  for (bool rational : {false, true}) {
    const std::string kind = rational ? "rational " : "polynomial ";
    for (int p = 1; p <= 25; ++p) {
      add(kind + "spline", p, p, spline(clamped(p, std::min(p, 3)), clamped(p, 1), rational, p));
      if (p >= 2) add(kind + "Bezier", p, 1 + p / 2, bezier(p, 1 + p / 2, rational));
    }
    for (const auto& [p, q] : {std::pair{1, 3}, {3, 1}, {3, 5}, {5, 2}, {2, 9}, {25, 1}, {14, 3}})
      add(kind + "spline", p, q, spline(clamped(p, 1), clamped(q, std::min(q, 2)), rational, p));
    for (int p : {1, 2, 3, 5, 8})
      add(kind + "spline with creases", p, 3, spline({p, {p + 1, p, p, p + 1}}, clamped(3, 3), rational, p));
    for (int p : {2, 3, 5}) {
      add(kind + "periodic spline", p, 3, spline({p, {1, 1, 1, 1, 1, 1, 1}, true}, clamped(3, 2), rational, p));
      add(kind + "periodic spline of double knots", p, 3,
          spline({p, {2, 1, 2, 1, 2}, true}, clamped(3, 2), rational, p));
    }
  }
  const Handle(Geom_Surface) torus = new Geom_ToroidalSurface(axes(), 3.0, 1.0);
  add("torus as a spline", 2, 2, GeomConvert::SurfaceToBSplineSurface(torus));
  const Handle(Geom_Surface) sphere = new Geom_SphericalSurface(axes(), 3.0);
  add("sphere as a spline", 2, 2, GeomConvert::SurfaceToBSplineSurface(sphere));
  return all;
}

std::vector<OccSurface> swept_surfaces() {
  const gp_Ax2 sideways(gp_Pnt(3.0, 0.0, 0.5), gp_Dir(0.0, 1.0, 0.0), gp_Dir(1.0, 0.0, 0.0));
  const gp_Ax1 axis(gp_Pnt(0.0, 0.0, 0.0), gp_Dir(0.0, 0.0, 1.0));
  const gp_Dir direction(0.2, 0.9, 0.4);
  TColgp_Array1OfPnt to_axis(1, 4);
  to_axis(1) = gp_Pnt(2, 0, 0);
  to_axis(2) = gp_Pnt(2, 0, 1);
  to_axis(3) = gp_Pnt(1, 0, 2);
  to_axis(4) = gp_Pnt(0, 0, 2);
  struct Curve {
    std::string name;
    Handle(Geom_Curve) curve;
    Interval range;
  };
  const std::vector<Curve> curves = {
      {"line", new Geom_Line(gp_Pnt(2, 0, 0), gp_Dir(0.3, 0.1, 0.9)), {-3, 3}},
      {"circle", new Geom_Circle(sideways, 1.0), {0, kTwoPi}},
      {"ellipse", new Geom_Ellipse(sideways, 2.0, 1.0), {0, kTwoPi}},
      {"parabola", new Geom_Parabola(sideways, 0.5), {-2, 2}},
      {"hyperbola", new Geom_Hyperbola(sideways, 2.0, 1.0), {-1, 1}},
      {"spline", profile(), {1, 4}},
      {"Bezier down to the axis", new Geom_BezierCurve(to_axis), {0, 1}},
  };
  std::vector<OccSurface> all;
  for (const Curve& c : curves) {
    all.push_back({"revolution of a " + c.name,
                   new Geom_SurfaceOfRevolution(c.curve, axis),
                   {{-1.0, 8.0}, c.range},
                   {{1, c.range.lo}, {2, c.range.hi}}});
    all.push_back({"extrusion of a " + c.name,
                   new Geom_SurfaceOfLinearExtrusion(c.curve, direction),
                   {c.range, {-4, 4}},
                   {{c.range.lo, 0}, {c.range.hi, 1}}});
  }
  return all;
}

std::vector<OccSurface> offset_surfaces() {
  std::vector<OccSurface> all;
  for (const OccSurface& b : bases()) {
    const Interval inside{b.box.v.lo + 0.05 * b.box.v.length(), b.box.v.hi - 0.05 * b.box.v.length()};
    all.push_back({"offset of a " + b.name, new Geom_OffsetSurface(b.surface, 0.15), {b.box.u, inside}, {}});
  }
  return all;
}

std::vector<OccSurface> trimmed_surfaces() {
  std::vector<OccSurface> all;
  for (const OccSurface& b : bases()) {
    const UvBox part{b.surface->IsUPeriodic() ? Interval{0.5, 4.0} : b.box.u, b.box.v};
    all.push_back({"trimmed " + b.name,
                   new Geom_RectangularTrimmedSurface(b.surface, part.u.lo, part.u.hi, part.v.lo, part.v.hi),
                   part,
                   {}});
  }
  return all;
}

}  // namespace geovor::test
