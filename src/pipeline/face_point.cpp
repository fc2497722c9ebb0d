#include "pipeline/face_point.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "base/error.h"
#include "surface/project.h"
#include "voronoi/diagram_builder.h"
#include "voronoi/face_border.h"

namespace geovor {
namespace {

// Of the face's size: coordinates that were printed with seven digits.
constexpr double kPrintedCoordinates = 1e-6;

std::string text(double x) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.3g", x);
  return buffer;
}

/// The place between a and b that is nearest to x, by ternary search: the distance to a short piece of border has one
/// valley.
Uv nearest_between(const Surface& surface, Uv a, Uv b, const Xyz& x) {
  constexpr int kRounds = 60;  // (2/3)^60 of a short segment is rounding
  double lo = 0.0, hi = 1.0;
  const auto distance2 = [&](double k) { return (surface.position(lerp(a, b, k)) - x).squaredNorm(); };
  for (int i = 0; i < kRounds; ++i) {
    const double third = (hi - lo) / 3.0;
    if (distance2(lo + third) < distance2(hi - third)) {
      hi -= third;
    } else {
      lo += third;
    }
  }
  return lerp(a, b, 0.5 * (lo + hi));
}

/// The place on the border that is nearest to x in space; p where there is no border.
Uv nearest_on_border(const FaceDomain& domain, Uv p, const Xyz& x) {
  const FaceBorder border(domain);
  const Surface& surface = domain.surface();
  double least = std::numeric_limits<double>::infinity();
  Uv nearest = p;
  const auto try_place = [&](Uv q) {
    const double d = (surface.position(q) - x).norm();
    if (!(d < least)) return false;
    least = d, nearest = q;
    return true;
  };
  for (int cycle = 0; cycle < border.cycle_count(); ++cycle) {
    const std::vector<Uv> line = border.stretch({cycle, 0.0}, {cycle, 0.0});
    int closest = -1;
    for (int i = 0; i < static_cast<int>(line.size()); ++i) {
      if (try_place(line[i])) closest = i;
    }
    if (closest < 0) continue;
    for (int i = std::max(closest - 1, 0); i <= closest && i + 1 < static_cast<int>(line.size()); ++i) {
      try_place(nearest_between(surface, line[i], line[i + 1], x));
    }
  }
  return nearest;
}

}  // namespace

double face_tolerance(const CadFace& face) { return std::max(face.tolerance, kConfusion); }

double printed_tolerance(const FaceDomain& domain, const CadFace& face) {
  return std::max(face_tolerance(face), kPrintedCoordinates * face_size(domain));
}

FacePlace project_on_face(const FaceDomain& domain, const Xyz& x, double tolerance, bool snap) {
  if (!x.allFinite()) throw Error(ErrorCode::Usage, "is no finite point; give three finite coordinates");
  const Projection p = project(domain.surface(), x, domain.box());
  if (!snap && !(p.distance <= tolerance)) {
    throw Error(ErrorCode::Usage,
                "lies off the face by " + text(p.distance) + "; move it onto the face, or give --snap");
  }
  return {domain.to_principal(p.uv), p.foot, p.distance};
}

FacePlace place_on_face(const FaceDomain& domain, const FacePoint& point, double tolerance, bool snap) {
  FacePlace place;
  Xyz given;
  if (const Uv* uv = std::get_if<Uv>(&point)) {
    if (!is_finite(*uv)) throw Error(ErrorCode::Usage, "is no finite point; give two finite parameters");
    place.uv = domain.to_principal(*uv);
    given = place.xyz = domain.surface().position(place.uv);
  } else {
    given = std::get<Xyz>(point);
    place = project_on_face(domain, given, tolerance, snap);
  }
  if (domain.contains(place.uv) || domain.distance_to_border(place.uv) <= tolerance) return place;
  if (!snap) {
    throw Error(ErrorCode::Usage, "lies outside the border of the face; move it inside, or give --snap");
  }
  place.uv = nearest_on_border(domain, place.uv, given);
  place.xyz = domain.surface().position(place.uv);
  place.moved = (place.xyz - given).norm();
  return place;
}

}  // namespace geovor
