#include "brep/face_loops.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace geovor {
namespace {

/// A side of the whole domain has no edge. It is no border where a period joins it to the other side or where it is one
/// point in space.
bool side_is_border(const Surface& surface, const Coedge& side) {
  const CurveJet<2> middle = side.pcurve->jet(side.range.middle());
  const bool along_u = middle.d1[1] == 0.0;
  if (along_u ? surface.v_period().has_value() : surface.u_period().has_value()) return false;
  const SurfaceJet j = surface.jet({middle.C[0], middle.C[1]});
  // Beside the other derivative a pole's own is rounding.
  constexpr double kPole = 1e-12;
  return along_u ? j.Su.norm() > kPole * j.Sv.norm() : j.Sv.norm() > kPole * j.Su.norm();
}

}  // namespace

std::vector<TrimLoop> loops_or_whole_domain(const CadFace& face) {
  if (!face.surface) {
    const std::string why = face.problems.empty() ? "the face has no usable surface" : face.problems.front();
    throw Error(ErrorCode::FaceRejected, why + "; repair the face");
  }
  if (!face.loops.empty()) return face.loops;
  const UvBox box = face.surface->domain();
  if (!(std::isfinite(box.u.length()) && std::isfinite(box.v.length()))) {
    throw Error(ErrorCode::FaceRejected, "the face has no border on an unbounded surface; trim it");
  }
  const Uv corners[] = {{box.u.lo, box.v.lo}, {box.u.hi, box.v.lo}, {box.u.hi, box.v.hi}, {box.u.lo, box.v.hi}};
  TrimLoop loop;
  for (int i = 0; i < 4; ++i) {
    loop.coedges.push_back({-1, std::make_shared<UvLine>(corners[i], corners[(i + 1) % 4]), {0.0, 1.0}, false});
  }
  return {loop};
}

std::vector<int> edge_uses(const std::vector<TrimLoop>& loops) {
  std::vector<int> uses;
  for (const TrimLoop& loop : loops) {
    for (const Coedge& coedge : loop.coedges) {
      if (coedge.edge < 0) continue;
      if (coedge.edge >= static_cast<int>(uses.size())) uses.resize(coedge.edge + 1, 0);
      ++uses[coedge.edge];
    }
  }
  return uses;
}

bool is_border(const CadModel& model, const Surface& surface, const Coedge& coedge, const std::vector<int>& uses) {
  if (coedge.edge < 0) return side_is_border(surface, coedge);
  if (coedge.edge < static_cast<int>(model.edges.size()) && model.edges[coedge.edge].degenerate()) return false;
  return uses[coedge.edge] == 1;
}

}  // namespace geovor
