#include "surface/surface.h"

#include <mutex>

namespace geovor {

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
