#include "pipeline/cad_corners.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "delaunay/surface_probe.h"

namespace geovor {
namespace {

/// The unit direction of a coedge in space, in the order of travel, at its start or its end.
std::optional<Xyz> direction(const CadModel& model, const Coedge& coedge, bool at_end) {
  const CadEdge& edge = model.edges[coedge.edge];
  const bool at_hi = at_end != coedge.reversed;
  const double t = at_hi ? edge.range.hi : edge.range.lo;
  Xyz d = edge.curve->jet(t).d1;
  // A curve that starts with derivative zero: a short chord tells.
  constexpr double kChord = 1e-4, kVanishing = 1e-9;
  const Xyz chord =
      edge.curve->position(t + (at_hi ? -1.0 : 1.0) * kChord * edge.range.length()) - edge.curve->position(t);
  if (!(d.norm() * kChord * edge.range.length() > kVanishing * chord.norm())) d = at_hi ? Xyz(-chord) : chord;
  if (!(d.norm() > 0.0)) return std::nullopt;
  return Xyz((coedge.reversed ? -1.0 : 1.0) * d.stableNormalized());
}

/// The angle from the way out to the way back, counter-clockwise about n: the inside of the face lies there.
double inner_angle(const Xyz& in, const Xyz& out, const Xyz& n) {
  // Edges that go on straight make 180 degrees; one that turns back makes 0 or 360, which rounding must not decide.
  constexpr double kCusp = 1e-6;
  const double angle = std::atan2(n.dot(out.cross(-in)), out.dot(-in));
  const double turned = angle < -kCusp ? angle + 2.0 * std::numbers::pi : std::max(angle, 0.0);
  return 180.0 / std::numbers::pi * turned;
}

void add_corners(const CadModel& model, int f, std::vector<CadCorner>& corners) {
  const CadFace& face = model.faces[f];
  std::map<int, int> uses;
  for (const TrimLoop& loop : face.loops) {
    for (const Coedge& c : loop.coedges) ++uses[c.edge];
  }
  const auto ends_face = [&](const Coedge& c) { return !model.edges[c.edge].degenerate() && uses[c.edge] == 1; };
  const SurfaceProbe probe(*face.surface, parameter_box(face));
  for (const TrimLoop& loop : face.loops) {
    for (std::size_t i = 0; i < loop.coedges.size(); ++i) {
      const Coedge &in = loop.coedges[i], &out = loop.coedges[(i + 1) % loop.coedges.size()];
      if (!ends_face(in) || !ends_face(out) || !out.pcurve) continue;
      const auto d_in = direction(model, in, true), d_out = direction(model, out, false);
      const auto uv = out.pcurve->position(out.reversed ? out.range.hi : out.range.lo);
      const Xyz n = probe.at({uv[0], uv[1]}).n;
      if (!d_in || !d_out || !(n.squaredNorm() > 0.0)) continue;
      const CadEdge& edge = model.edges[out.edge];
      const Xyz at = edge.curve->position(out.reversed ? edge.range.hi : edge.range.lo);
      corners.push_back({f, at, inner_angle(*d_in, *d_out, n)});
    }
  }
}

}  // namespace

std::vector<CadCorner> cad_corners(const CadModel& model) {
  std::vector<CadCorner> corners;
  for (int f = 0; f < static_cast<int>(model.faces.size()); ++f) {
    if (model.faces[f].surface && !model.faces[f].loops.empty()) add_corners(model, f, corners);
  }
  return corners;
}

}  // namespace geovor
