#include "surface/pole_chart.h"

#include <cmath>

namespace geovor {
namespace {

// A parameter that has been computed may lie so far beyond the side.
constexpr double kRounding = 1e-12;

}  // namespace

SurfaceJet PoleChart::jet(Uv ab) const {
  const HeightJet h = height(ab);
  const Xyz &e1 = frame_.x, &e2 = frame_.y, &n = frame_.z;
  return {frame_.to_space({ab.u, ab.v, h.f}), e1 + h.fu * n, e2 + h.fv * n, h.fuu * n, h.fuv * n, h.fvv * n};
}

bool PoleChart::holds(Uv p) const {
  const double depth = side_.depth(p);
  if (!(depth >= -kRounding * reach_ && depth <= reach_)) return false;
  const Uv ab = from_base(p);
  return std::hypot(ab.u, ab.v) <= radius_;
}

}  // namespace geovor
