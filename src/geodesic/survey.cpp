#include "geodesic/survey.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "surface/forms.h"

namespace geovor {

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// Two sample steps a cell: a feature as wide as a cell shows in the samples. A first survey with few cells tells how
// many it takes for none to be wider than a part of the smallest radius of curvature.
constexpr int kFewestCells = 24;
constexpr double kCellBend = 0.25;

// Disks with less than this cannot hold a second geodesic; see second_geodesic_at_least.
constexpr double kFullTurn = 2.0 * std::numbers::pi;

// A function changes between samples by no more than this part of what it changes from sample to sample.
constexpr double kAllowance = 0.5;

// A derivative this part of what it might be, or less, is zero to rounding.
constexpr double kZero = 1e-12;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

// A side where the derivative across it vanishes is no point: the surface may be as good there as anywhere. What the
// parameters do not tell is NaN, to be told by the samples beside; only paths across the side have no bound.
SurfaceSurvey::Sample SurfaceSurvey::where_parameters_end(const UvBox& domain, Uv p, const SurfaceJet& j) {
  const double width = domain.u.length(), height = domain.v.length();
  const double u = width * j.Su.norm(), v = height * j.Sv.norm();
  const double scale = std::max({u, v, width * width * j.Suu.norm(), height * height * j.Svv.norm()});
  const auto at_end = [](Interval x, double at) {
    return std::min(std::abs(at - x.lo), std::abs(at - x.hi)) <= kZero * x.length();
  };
  const bool across_u = u <= kZero * scale && at_end(domain.u, p.u);
  const bool across_v = v <= kZero * scale && at_end(domain.v, p.v);
  if (!across_u && !across_v) return {kInf, kInf, kInf, kInf, 0.0, 0.0};
  return {across_u ? kInf : kUnknown, across_v ? kInf : kUnknown, kUnknown, kUnknown, 0.0, 0.0};
}

SurfaceSurvey::Sample SurfaceSurvey::sample(const Surface& surface, Uv p) {
  const SurfaceJet j = surface.jet(p);
  const double W = j.Su.cross(j.Sv).norm();
  const Curvatures c = curvatures(j);
  const double u = j.Su.norm(), v = j.Sv.norm();
  if (!(W > 0.0) || !std::isfinite(c.gauss)) return where_parameters_end(surface.domain(), p, j);
  return {v / W, u / W, c.gauss, W, c.largest() * u, c.largest() * v};
}

// An upper bound from those of the nine samples of a cell that tell something.
template <class Value>
double SurfaceSurvey::bound(const std::vector<Sample>& samples, int i, int j, Value value) const {
  double lo = kInf, hi = -kInf;
  for (int b = 0; b <= 2; ++b)
    for (int a = 0; a <= 2; ++a) {
      const double x = value(samples[(2 * j + b) * (2 * u_.cells + 1) + 2 * i + a]);
      if (std::isnan(x)) continue;
      if (std::isinf(x)) return kInf;
      lo = std::min(lo, x);
      hi = std::max(hi, x);
    }
  return lo <= hi ? hi + kAllowance * (hi - lo) : kInf;
}

double SurfaceSurvey::Axis::cell() const { return range.length() / cells; }

Interval SurfaceSurvey::Axis::reached(double x, double r) const {
  if (periodic) return {x - r, x + r};
  return {std::max(x - r, range.lo), std::min(x + r, range.hi)};
}

int SurfaceSurvey::Axis::first(Interval reach) const {
  const int i = static_cast<int>(std::floor((reach.lo - range.lo) / cell()));
  return periodic ? i : std::clamp(i, 0, cells - 1);
}

int SurfaceSurvey::Axis::last(Interval reach) const {
  const int i = static_cast<int>(std::floor((reach.hi - range.lo) / cell()));
  return periodic ? i : std::clamp(i, 0, cells - 1);
}

SurfaceSurvey::Axis SurfaceSurvey::Axis::of(Interval range, Interval domain, bool periodic) {
  return {range, periodic, kFewestCells, !periodic && range.lo > domain.lo, !periodic && range.hi < domain.hi};
}

SurfaceSurvey::SurfaceSurvey(const Surface& surface, int most_cells)
    : SurfaceSurvey(surface, surface.domain(), most_cells) {}

SurfaceSurvey::SurfaceSurvey(const Surface& surface, const UvBox& box, int most_cells)
    : u_(Axis::of(box.u, surface.domain().u, surface.u_period().has_value())),
      v_(Axis::of(box.v, surface.domain().v, surface.v_period().has_value())) {
  const auto finite = [](Interval x) { return x.length() > 0.0 && x.length() < kInf; };
  usable_ = finite(u_.range) && finite(v_.range) && surface.continuity() > 0;
  if (!usable_) return;
  std::vector<Sample> samples = take(surface);
  double bend_u = 0.0, bend_v = 0.0;  // of the first survey's cells, in radii
  for (const Sample& s : samples) {
    bend_u = std::max(bend_u, s.bend_u * u_.cell());
    bend_v = std::max(bend_v, s.bend_v * v_.cell());
  }
  const auto wanted = [most_cells](double bend) {
    const double cells = std::ceil(kFewestCells * bend / kCellBend);
    return static_cast<int>(std::clamp<double>(cells, kFewestCells, std::max(most_cells, kFewestCells)));
  };
  u_.cells = wanted(bend_u);
  v_.cells = wanted(bend_v);
  if (u_.cells > kFewestCells || v_.cells > kFewestCells) samples = take(surface);
  cells_.reserve(static_cast<std::size_t>(u_.cells) * v_.cells);
  for (int j = 0; j < v_.cells; ++j)
    for (int i = 0; i < u_.cells; ++i) add_cell(samples, i, j);
}

std::vector<SurfaceSurvey::Sample> SurfaceSurvey::take(const Surface& surface) const {
  std::vector<Sample> samples;
  samples.reserve(static_cast<std::size_t>(2 * u_.cells + 1) * (2 * v_.cells + 1));
  for (int j = 0; j <= 2 * v_.cells; ++j)
    for (int i = 0; i <= 2 * u_.cells; ++i)
      samples.push_back(sample(surface, {u_.range.lo + 0.5 * i * u_.cell(), v_.range.lo + 0.5 * j * v_.cell()}));
  return samples;
}

void SurfaceSurvey::add_cell(const std::vector<Sample>& samples, int i, int j) {
  const auto positive = [](const Sample& s) {
    return std::isnan(s.gauss) ? kUnknown : std::max(s.gauss, 0.0) * s.density;
  };
  cells_.push_back({bound(samples, i, j, [](const Sample& s) { return s.rate_u; }),
                    bound(samples, i, j, [](const Sample& s) { return s.rate_v; }),
                    bound(samples, i, j, [](const Sample& s) { return s.gauss; }),
                    bound(samples, i, j, positive) * u_.cell() * v_.cell()});
}

std::optional<SurfaceSurvey::Region> SurfaceSurvey::ball(Uv centre, double radius) const {
  constexpr int kRounds = 12;
  if (!usable_ || !(radius < kInf)) return std::nullopt;
  double r_u = 0.0, r_v = 0.0;
  // The rectangle grows until paths at the rates met in it no longer leave it.
  for (int round = 0; round < kRounds; ++round) {
    Region region{{u_.reached(centre.u, r_u), v_.reached(centre.v, r_v)}, -kInf, 0.0};
    double rate_u = 0.0, rate_v = 0.0;
    for (int j = v_.first(region.box.v); j <= v_.last(region.box.v); ++j)
      for (int i = u_.first(region.box.u); i <= u_.last(region.box.u); ++i) {
        const Cell& cell = cells_[v_.wrapped(j) * u_.cells + u_.wrapped(i)];
        rate_u = std::max(rate_u, cell.rate_u);
        rate_v = std::max(rate_v, cell.rate_v);
        region.gauss = std::max(region.gauss, cell.gauss);
        region.total += cell.total;
      }
    if (!(region.total < kFullTurn)) return std::nullopt;
    if (radius * rate_u <= r_u && radius * rate_v <= r_v) return region;
    r_u = std::max(r_u, radius * rate_u);
    r_v = std::max(r_v, radius * rate_v);
    if (u_.wraps(r_u) || v_.wraps(r_v)) return std::nullopt;
    if (u_.leaves(centre.u, r_u) || v_.leaves(centre.v, r_v)) return std::nullopt;
  }
  return std::nullopt;
}

double second_geodesic_at_least(const SurfaceSurvey::Region& region, double length) {
  if (!(region.total < kFullTurn)) return 0.0;
  if (region.gauss <= 0.0) return kInf;
  return kFullTurn / std::sqrt(region.gauss) - length;
}

}  // namespace geovor
