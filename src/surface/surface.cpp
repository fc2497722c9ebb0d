#include "surface/surface.h"

namespace geovor {

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
