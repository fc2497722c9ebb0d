#include "delaunay/surface_probe.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "surface/forms.h"

namespace geovor {
namespace {

// Below this share of its mean length a derivative counts as zero: rounding has eaten the digits of the normal.
constexpr double kVanishing = 1e-7;
// Below this sine the two derivatives count as parallel.
constexpr double kParallel = 1e-9;

// The first step, in parts of the way to the middle of the box, by which a singular point is left.
constexpr double kFirstStep = 1e-6;
// A border curve may bulge beyond the points at which it was looked at, by this share of the box.
constexpr double kBulge = 0.05;
constexpr int kLooks = 16;

}  // namespace

UvBox parameter_box(const CadFace& face) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  UvBox box{{kInf, -kInf}, {kInf, -kInf}};
  for (const TrimLoop& loop : face.loops) {
    for (const Coedge& c : loop.coedges) {
      for (int i = 0; i <= kLooks; ++i) {
        const auto p = c.pcurve->position(c.range.lo + c.range.length() * i / kLooks);
        box.u = {std::min(box.u.lo, p.x()), std::max(box.u.hi, p.x())};
        box.v = {std::min(box.v.lo, p.y()), std::max(box.v.hi, p.y())};
      }
    }
  }
  const auto widen = [](Interval r, Interval domain, bool periodic) {
    const Interval wide{r.lo - kBulge * r.length(), r.hi + kBulge * r.length()};
    return periodic ? wide : Interval{std::max(wide.lo, domain.lo), std::min(wide.hi, domain.hi)};
  };
  const Surface& s = *face.surface;
  return {widen(box.u, s.domain().u, s.u_period().has_value()), widen(box.v, s.domain().v, s.v_period().has_value())};
}

SurfaceProbe::SurfaceProbe(const Surface& surface, const UvBox& box) : surface_(surface), box_(box) {
  constexpr int kGrid = 7;
  double su = 0.0, sv = 0.0;
  for (int i = 0; i < kGrid; ++i) {
    for (int k = 0; k < kGrid; ++k) {
      const SurfaceJet j =
          surface.jet({box.u.lo + (i + 0.5) / kGrid * box.u.length(), box.v.lo + (k + 0.5) / kGrid * box.v.length()});
      su += j.Su.norm();
      sv += j.Sv.norm();
    }
  }
  u_speed_ = su / (kGrid * kGrid);
  v_speed_ = sv / (kGrid * kGrid);
}

bool SurfaceProbe::regular(const SurfaceJet& j) const {
  const double a = j.Su.norm(), b = j.Sv.norm();
  return a > kVanishing * u_speed_ && b > kVanishing * v_speed_ && j.Su.cross(j.Sv).norm() > kParallel * a * b;
}

SurfaceSample SurfaceProbe::at(Uv p) const {
  SurfaceJet j = surface_.jet(p);
  SurfaceSample s;
  s.x = j.S;
  s.regular = regular(j);
  // The limit of normal and curvature: ever larger steps towards the middle, until the derivatives come back.
  for (double step = kFirstStep; !regular(j) && step < 0.5; step *= 10.0) {
    j = surface_.jet(lerp(p, {box_.u.middle(), box_.v.middle()}, step));
  }
  s.n = unit_normal(j);
  if (!s.n.allFinite()) s.n = Xyz::Zero();
  const double k = curvatures(j).largest();
  s.curvature = std::isfinite(k) ? k : 0.0;
  return s;
}

}  // namespace geovor
