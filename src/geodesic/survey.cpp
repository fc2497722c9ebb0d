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

// In each direction. Two sample steps a cell: a feature as wide as a cell shows in the samples.
constexpr int kCells = 24;
constexpr int kSamples = 2 * kCells + 1;

// A function changes between samples by no more than this part of what it changes from sample to sample.
constexpr double kAllowance = 0.5;

}  // namespace

SurfaceSurvey::Sample SurfaceSurvey::sample(const Surface& surface, Uv p) {
  const SurfaceJet j = surface.jet(p);
  const double W = j.Su.cross(j.Sv).norm();
  const double K = curvatures(j).gauss;
  if (!(W > 0.0) || !std::isfinite(K)) return {kInf, kInf, kInf, kInf};
  return {j.Sv.norm() / W, j.Su.norm() / W, K, W};
}

// An upper bound from the nine samples of a cell.
template <class Value>
double SurfaceSurvey::bound(const std::vector<Sample>& samples, int i, int j, Value value) {
  double lo = kInf, hi = -kInf;
  for (int b = 0; b <= 2; ++b)
    for (int a = 0; a <= 2; ++a) {
      const double x = value(samples[(2 * j + b) * kSamples + 2 * i + a]);
      if (!std::isfinite(x)) return kInf;
      lo = std::min(lo, x);
      hi = std::max(hi, x);
    }
  return hi + kAllowance * (hi - lo);
}

double SurfaceSurvey::Axis::cell() const { return range.length() / kCells; }

Interval SurfaceSurvey::Axis::reached(double x, double r) const {
  if (periodic) return {x - r, x + r};
  return {std::max(x - r, range.lo), std::min(x + r, range.hi)};
}

int SurfaceSurvey::Axis::first(Interval reach) const {
  const int i = static_cast<int>(std::floor((reach.lo - range.lo) / cell()));
  return periodic ? i : std::clamp(i, 0, kCells - 1);
}

int SurfaceSurvey::Axis::last(Interval reach) const {
  const int i = static_cast<int>(std::floor((reach.hi - range.lo) / cell()));
  return periodic ? i : std::clamp(i, 0, kCells - 1);
}

SurfaceSurvey::SurfaceSurvey(const Surface& surface)
    : u_{surface.domain().u, surface.u_period().has_value()}, v_{surface.domain().v, surface.v_period().has_value()} {
  const auto finite = [](Interval x) { return x.length() > 0.0 && x.length() < kInf; };
  usable_ = finite(u_.range) && finite(v_.range) && surface.continuity() > 0;
  if (!usable_) return;
  std::vector<Sample> samples;
  samples.reserve(kSamples * kSamples);
  for (int j = 0; j < kSamples; ++j)
    for (int i = 0; i < kSamples; ++i)
      samples.push_back(sample(surface, {u_.range.lo + 0.5 * i * u_.cell(), v_.range.lo + 0.5 * j * v_.cell()}));
  cells_.reserve(kCells * kCells);
  for (int j = 0; j < kCells; ++j)
    for (int i = 0; i < kCells; ++i) add_cell(samples, i, j);
}

void SurfaceSurvey::add_cell(const std::vector<Sample>& samples, int i, int j) {
  const auto positive = [](const Sample& s) { return std::max(s.gauss, 0.0) * s.density; };
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
        const Cell& cell = cells_[((j % kCells + kCells) % kCells) * kCells + (i % kCells + kCells) % kCells];
        rate_u = std::max(rate_u, cell.rate_u);
        rate_v = std::max(rate_v, cell.rate_v);
        region.gauss = std::max(region.gauss, cell.gauss);
        region.total += cell.total;
      }
    if (radius * rate_u <= r_u && radius * rate_v <= r_v) return region;
    r_u = std::max(r_u, radius * rate_u);
    r_v = std::max(r_v, radius * rate_v);
    if (!(r_u < kInf && r_v < kInf) || u_.wraps(r_u) || v_.wraps(r_v)) return std::nullopt;
  }
  return std::nullopt;
}

double second_geodesic_at_least(const SurfaceSurvey::Region& region, double length) {
  if (!(region.total < 2.0 * std::numbers::pi)) return 0.0;
  if (region.gauss <= 0.0) return kInf;
  return 2.0 * std::numbers::pi / std::sqrt(region.gauss) - length;
}

}  // namespace geovor
