#include "delaunay/surface_probe.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace geovor {
namespace {

// The first step, in parts of the way to the middle of the box, by which a singular point is left.
constexpr double kFirstStep = 1e-6, kLonger = 2.0;
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

SurfaceProbe::SurfaceProbe(const Surface& surface, const UvBox& box)
    : surface_(surface), box_(box), shapes_(surface, box) {}

SurfaceSample SurfaceProbe::at(Uv p) const {
  const SurfaceJet j = surface_.jet(p);
  SurfaceSample s;
  s.x = j.S;
  std::optional<Shape> shape = shapes_.at(p, j);
  s.regular = shape.has_value();
  // Ever larger steps towards the middle, until the derivatives come back.
  for (double step = kFirstStep; !shape && step < 1.0; step *= kLonger) {
    const Uv q = lerp(p, {box_.u.middle(), box_.v.middle()}, step);
    shape = shapes_.at(q, surface_.jet(q));
  }
  s.n = shape && shape->n.allFinite() ? shape->n : Xyz(Xyz::Zero());
  const double k = shape ? shape->largest_curvature() : 0.0;
  s.curvature = std::isfinite(k) ? k : 0.0;
  return s;
}

}  // namespace geovor
