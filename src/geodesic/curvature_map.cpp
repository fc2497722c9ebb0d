#include "geodesic/curvature_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/dop853.h"
#include "surface/forms.h"

namespace geovor {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// Cells in each direction. Their middles are looked at: there may be poles along the sides.
constexpr int kCells = 32;

Interval finite_part(Interval i) {
  if (std::isfinite(i.lo)) return {i.lo, std::isfinite(i.hi) ? i.hi : i.lo + 1.0};
  return {std::isfinite(i.hi) ? i.hi - 1.0 : 0.0, std::isfinite(i.hi) ? i.hi : 1.0};
}

// See near_domain(); in parts of the extents.
constexpr double kBeyond = 0.5;
Interval widened(Interval i) {
  const double more = std::isfinite(i.length()) ? kBeyond * i.length() : 0.0;
  return {i.lo - more, i.hi + more};
}

// Legs as parts of the radius: the error of a step over a part of it goes as the ninth power, so that legs go as this
// times tolerance^(1/9). With 4.2 and 5e-14 rays on bumps and saddles err by 7e-13 of their length at most, with 3.6 by
// 5e-13 (random ones, 2,000 of a kind; the worst are short). A leg longer than the second steps over a bump's tail to
// any tolerance.
constexpr double kLegForTolerance = 3.6;
constexpr double kLongestLeg = 0.25;

// Those of one ray, where it is curved so much that its steps are short anyway.
constexpr double kMostLegs = 1e3;

// See radius().
constexpr double kNear = 0.25;

struct Place {
  Xyz x;
  double radius;
};

}  // namespace

CurvatureMap::CurvatureMap(const Surface& surface)
    : box_{finite_part(surface.domain().u), finite_part(surface.domain().v)},
      rim_{widened(surface.domain().u), widened(surface.domain().v)},
      u_periodic_(surface.u_period().has_value()),
      v_periodic_(surface.v_period().has_value()) {
  std::vector<Place> places;
  for (int k = 0; k < kCells; ++k) {
    for (int i = 0; i < kCells; ++i) {
      const SurfaceJet j = surface.jet(
          {box_.u.lo + (i + 0.5) / kCells * box_.u.length(), box_.v.lo + (k + 0.5) / kCells * box_.v.length()});
      const double c = curvatures(j).largest();
      places.push_back({j.S, std::isfinite(c) && c > 0.0 ? 1.0 / c : kInf});
      if (std::isfinite(c)) largest_ = std::max(largest_, c);
    }
  }
  std::vector<Place> sharpest = places;
  std::stable_sort(sharpest.begin(), sharpest.end(),
                   [](const Place& a, const Place& b) { return a.radius < b.radius; });
  for (const Place& p : places) {
    double radius = kInf;
    for (const Place& q : sharpest) {
      if (!(q.radius < radius)) break;
      radius = std::min(radius, std::max(q.radius, kNear * (q.x - p.x).norm()));
    }
    radii_.push_back(radius);
  }
}

bool CurvatureMap::near_domain(Uv p) const {
  return (u_periodic_ || rim_.u.contains(p.u)) && (v_periodic_ || rim_.v.contains(p.v));
}

int CurvatureMap::cell(double x, Interval range, bool periodic) const {
  const double part = (x - range.lo) / range.length();
  const double inside = periodic ? part - std::floor(part) : std::clamp(part, 0.0, 1.0);
  return std::min(static_cast<int>(inside * kCells), kCells - 1);
}

double CurvatureMap::leg_end(Uv p, double covered, double s, double tolerance) const {
  const double part = std::min(kLongestLeg, kLegForTolerance * std::pow(tolerance, 1.0 / dop853::kErrorOrder));
  const double leg = std::max(part * radius(p), s / kMostLegs), rest = s - covered;
  return rest <= leg ? s : covered + rest / std::ceil(rest / leg);
}

double CurvatureMap::tolerance_of(Uv p, double leg) const {
  return std::pow(leg / (kLegForTolerance * radius(p)), dop853::kErrorOrder);
}

double CurvatureMap::radius(Uv p) const {
  if (!is_finite(p)) return kInf;
  return radii_[cell(p.v, box_.v, v_periodic_) * kCells + cell(p.u, box_.u, u_periodic_)];
}

}  // namespace geovor
