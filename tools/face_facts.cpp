#include "face_facts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "brep/face_domain.h"

namespace geovor {
namespace {

/// How finely borders are followed when the parameterization is looked at, relative to the model's diagonal: the worst
/// stretch is a figure to two digits, not a measurement.
constexpr double kBorderDeflection = 1e-3;

void measure(const CadModel& model, const CadFace& face, FaceFacts& facts) {
  try {
    const Area area = face_area(model, face);
    if (!std::isfinite(area.value)) throw Error(ErrorCode::FaceRejected, "its area is not finite; rebuild the surface");
    facts.area = area.value;
    facts.area_error = area.error;
    const Stretch stretch = parameter_stretch(FaceDomain(model, face, kBorderDeflection * model.diagonal()));
    facts.anisotropy = stretch.anisotropy;
    facts.smallest_angle = stretch.smallest_angle * 180.0 / std::numbers::pi;
  } catch (const Error& error) {
    facts.problems.emplace_back(error.what());
  }
}

}  // namespace

FaceFacts face_facts(const CadModel& model, const CadFace& face) {
  FaceFacts facts;
  facts.number = face.number;
  facts.name = face.name;
  facts.kind = face.surface ? to_string(face.surface->kind()) : "-";
  facts.spline = face.spline;
  facts.holes = std::max(0, static_cast<int>(face.loops.size()) - 1);
  facts.tolerance = face.tolerance;
  facts.problems = face.problems;
  for (const TrimLoop& loop : face.loops) {
    for (const Coedge& coedge : loop.coedges) {
      facts.collapsed += model.edges[static_cast<std::size_t>(coedge.edge)].degenerate();
    }
  }
  if (!face.surface) return facts;
  facts.u_period = face.surface->u_period();
  facts.v_period = face.surface->v_period();
  measure(model, face, facts);
  return facts;
}

}  // namespace geovor
