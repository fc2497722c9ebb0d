#include "surface/spline_cap.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "surface/polar_map.h"

namespace geovor {
namespace {

// Nearer to the pole than this part of the radius the osculating paraboloid is the surface, to rounding.
constexpr double kLimit = 1e-18;

// A disk: this part of the radius of curvature at the pole, if the first span reaches that far.
constexpr double kDisk = 0.25;

// Newton's method is tried out on this many directions, and somewhat beyond the disk.
constexpr int kDirections = 32;
constexpr double kBeyond = 1.45;  // the corners of the square around the disk
constexpr int kHalvings = 24;

// A path in the chart doesn't see the knot lines that run into the pole. Where the surface is another function on the
// other side of one, by the height d, a path that crosses it is off by about d / (radius of curvature): the disk is
// made so small that d stays below this part of its first radius.
constexpr double kSmoothAcross = 1e-14;

// Slopes up to this are still a graph with well-conditioned derivatives.
constexpr double kSteepest = 1.0;

class SplineCap final : public PoleChart {
 public:
  SplineCap(PolarMap map, const PoleSide& side, double radius, double reach, const HeightJet& at_pole)
      : PoleChart(map.frame(), side, radius, reach), map_(std::move(map)), at_pole_(at_pole) {}

  Uv to_base(Uv ab) const override {
    const double r = std::hypot(ab.u, ab.v), tiny = kLimit * radius();
    if (!(r > 0.0)) return side().point(map_.along().middle(), 0.0);
    // Below the limit the rays are straight: the foot is a part of that at the limit.
    const double k = std::max(tiny / r, 1.0);
    const auto foot = map_.foot({k * ab.u, k * ab.v});
    if (!foot) return side().point(map_.along().middle(), r / map_.speed().middle());
    return side().point(foot->w, foot->t / k);
  }

  Uv from_base(Uv p) const override {
    const SurfaceJet j = map_.jet(side().along(p), side().depth(p));
    return {j.S.x(), j.S.y()};
  }

  Xyz side_direction(Uv p) const override {
    const double t = side().depth(p), tiny = kLimit * map_.depth();
    const Xyz d = std::abs(t) > tiny ? map_.jet(side().along(p), t).Su : map_.jet(side().along(p), 0.0).Suv;
    return ((t < -tiny ? -1.0 : 1.0) * (d.x() * frame().x + d.y() * frame().y + d.z() * frame().z)).normalized();
  }

  HeightJet height(Uv ab) const override {
    if (std::hypot(ab.u, ab.v) > kLimit * radius())
      if (const auto foot = map_.foot(ab)) return PolarMap::graph(*foot, ab);
    HeightJet h = at_pole_;
    h.fu = h.fuu * ab.u + h.fuv * ab.v;
    h.fv = h.fuv * ab.u + h.fvv * ab.v;
    h.f = 0.5 * (h.fu * ab.u + h.fv * ab.v);
    return h;
  }

 private:
  PolarMap map_;
  HeightJet at_pole_;
};

// The greatest depth on the ring of the radius r in the wedge, if the graph is good all around it.
bool ring_is_good(const PolarMap& map, double r, double& depth) {
  const Interval w = map.along();
  depth = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    const SurfaceJet m = map.jet(w.lo + w.length() * (i + 0.5) / kDirections, 0.0);
    const double k = r / std::hypot(m.Sv.x(), m.Sv.y());
    const Uv ab{k * m.Sv.x(), k * m.Sv.y()};
    const auto foot = map.foot(ab);
    if (!foot || !(foot->t <= map.depth())) return false;
    const HeightJet h = PolarMap::graph(*foot, ab);
    if (!(std::hypot(h.fu, h.fv) <= kSteepest)) return false;
    depth = std::max(depth, foot->t);
  }
  return true;
}

std::shared_ptr<const PoleChart> cap_at(const BSplineSurface& surface, const PoleSide& side) {
  std::optional<PolarMap> map = PolarMap::make(surface, side);
  HeightJet at_pole{};
  if (!map || !map->second_form(at_pole)) return nullptr;
  const double bend = std::hypot(at_pole.fuu, std::numbers::sqrt2 * at_pole.fuv, at_pole.fvv);
  double radius = map->speed().lo * map->depth();
  if (bend * radius > kDisk) radius = kDisk / bend;
  const double most = kSmoothAcross * radius + map->rounding();
  double depth = 0.0;
  for (int i = 0; i < kHalvings; ++i, radius *= 0.5)
    if (map->mismatch(kBeyond * radius) <= most && ring_is_good(*map, kBeyond * radius, depth))
      return std::make_shared<const SplineCap>(std::move(*map), side, radius, depth, at_pole);
  return nullptr;
}

}  // namespace

PoleCharts spline_poles(const BSplineSurface& surface) {
  const UvBox box = surface.domain();
  PoleCharts charts;
  auto add = [&](const PoleSide& side) {
    if (auto chart = cap_at(surface, side)) charts.push_back(std::move(chart));
  };
  if (!surface.u_period()) {
    add({false, box.u.lo, true});
    add({false, box.u.hi, false});
  }
  if (!surface.v_period()) {
    add({true, box.v.lo, true});
    add({true, box.v.hi, false});
  }
  return charts;
}

}  // namespace geovor
