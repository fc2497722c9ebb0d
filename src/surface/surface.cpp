#include "surface/surface.h"

#include <cmath>
#include <mutex>

namespace geovor {
namespace {

// Differences of fourth order with the step h on a function that varies over the length l are off by (h/l)^4 / 30 +
// 1.5 eps l / h of its size: 4e-13 at h = 1e-3 l.
constexpr double kStep = 1e-3;

// A length, in the parameter, over which the surface changes: its span, and the first derivative over the second.
double step(const Interval& box, double first, double second) {
  double length = std::isfinite(box.length()) ? box.length() : 1.0;
  if (second * length > first && first > 0.0) length = first / second;
  return kStep * length;
}

// The derivative of the second derivatives of one piece in direction `d` (a unit step in u or in v).
struct Change {
  Xyz uu, uv, vv;
  Change(const Surface& s, Uv p, UvVec d, double h, const Span& span) {
    const SurfaceJet a = s.jet(p + h * d, span), b = s.jet(p + -h * d, span);
    const SurfaceJet aa = s.jet(p + 2.0 * h * d, span), bb = s.jet(p + -2.0 * h * d, span);
    auto difference = [h](const Xyz& f1, const Xyz& b1, const Xyz& f2, const Xyz& b2) -> Xyz {
      return (8.0 * (f1 - b1) - (f2 - b2)) / (12.0 * h);
    };
    uu = difference(a.Suu, b.Suu, aa.Suu, bb.Suu);
    uv = difference(a.Suv, b.Suv, aa.Suv, bb.Suv);
    vv = difference(a.Svv, b.Svv, aa.Svv, bb.Svv);
  }
};

}  // namespace

SurfaceThirds Surface::third(Uv p, const Span& span) const {
  const SurfaceJet j = jet(p, span);
  const Change in_u(*this, p, {1.0, 0.0}, step(span.box.u, j.Su.norm(), j.Suu.norm()), span);
  const Change in_v(*this, p, {0.0, 1.0}, step(span.box.v, j.Sv.norm(), j.Svv.norm()), span);
  return {in_u.uu, in_u.uv, in_u.vv, in_v.vv};
}

struct PoleCache::Entry {
  std::once_flag made;
  PoleCharts charts;
};

PoleCache::PoleCache() : entry_(std::make_unique<Entry>()) {}
PoleCache::~PoleCache() = default;

PoleCache& PoleCache::operator=(const PoleCache& other) {
  if (this != &other) entry_ = std::make_unique<Entry>();
  return *this;
}

const PoleCharts& PoleCache::get(const Surface& surface) const {
  std::call_once(entry_->made, [&] { entry_->charts = surface.make_poles(); });
  return entry_->charts;
}

std::string to_string(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::Plane:
      return "plane";
    case SurfaceKind::Cylinder:
      return "cylinder";
    case SurfaceKind::Cone:
      return "cone";
    case SurfaceKind::Sphere:
      return "sphere";
    case SurfaceKind::Torus:
      return "torus";
    case SurfaceKind::BSpline:
      return "bspline";
    case SurfaceKind::Revolution:
      return "revolution";
    case SurfaceKind::Extrusion:
      return "extrusion";
    case SurfaceKind::Offset:
      return "offset";
    case SurfaceKind::Function:
      return "function";
  }
  return "unknown";
}

}  // namespace geovor
