#include "surface/project.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace geovor {
namespace {

// Parameters, along one direction of `box`, at which to look for a start: a few in each analytic piece.
std::vector<double> samples(const Surface& surface, const UvBox& box, bool along_u, double reach) {
  constexpr int kPerSpan = 3, kLeast = 16, kMost = 128;
  const Interval given = along_u ? box.u : box.v;
  const Interval other = along_u ? box.v : box.u;
  const Interval range{std::max(given.lo, -reach), std::min(given.hi, reach)};
  const double fixed = other.clamp(0.0);
  int spans = 0;
  for (double x = range.lo; spans < kMost && x < range.hi; ++spans) {
    const Span s = surface.span(along_u ? Uv{x, fixed} : Uv{fixed, x}, {1.0, 1.0});
    const double next = along_u ? s.box.u.hi : s.box.v.hi;
    if (!(next > x)) break;
    x = next;
  }
  const int n = std::clamp(kPerSpan * spans, kLeast, kMost);
  std::vector<double> x(n + 1);
  for (int i = 0; i <= n; ++i) x[i] = range.lo + range.length() * i / n;
  return x;
}

struct Start {
  Uv p;
  double d2;
};

// The grid points that are no farther from the point than their neighbours, nearest first.
std::vector<Start> starts(const Surface& surface, const Xyz& point, const UvBox& box) {
  // In an infinite direction, look as far as the point is away.
  const double reach = 2.0 * (1.0 + point.norm() + surface.position(box.clamp({0.0, 0.0})).norm());
  const std::vector<double> u = samples(surface, box, true, reach), v = samples(surface, box, false, reach);
  const int nu = static_cast<int>(u.size()), nv = static_cast<int>(v.size());
  std::vector<double> d2(static_cast<size_t>(nu) * nv);
  for (int i = 0; i < nu; ++i)
    for (int k = 0; k < nv; ++k) d2[i * nv + k] = (surface.position({u[i], v[k]}) - point).squaredNorm();
  auto is_lowest = [&](int i, int k) {
    for (int a = std::max(i - 1, 0); a <= std::min(i + 1, nu - 1); ++a)
      for (int b = std::max(k - 1, 0); b <= std::min(k + 1, nv - 1); ++b)
        if (d2[a * nv + b] < d2[i * nv + k]) return false;
    return true;
  };
  std::vector<Start> lowest;
  for (int i = 0; i < nu; ++i)
    for (int k = 0; k < nv; ++k)
      if (is_lowest(i, k)) lowest.push_back({{u[i], v[k]}, d2[i * nv + k]});
  std::stable_sort(lowest.begin(), lowest.end(), [](const Start& a, const Start& b) { return a.d2 < b.d2; });
  return lowest;
}

// Moves x by whole periods into [lo, lo + period).
double wrap(double x, double lo, double period) { return x - std::floor((x - lo) / period) * period; }

}  // namespace

Projection project(const Surface& surface, const Xyz& point, const UvBox& box) {
  constexpr size_t kTries = 6;
  Projection best;
  best.distance = std::numeric_limits<double>::infinity();
  const std::vector<Start> from = starts(surface, point, box);
  for (size_t i = 0; i < std::min(kTries, from.size()); ++i) {
    const Projection candidate = project_near(surface, point, from[i].p, box);
    if (candidate.distance < best.distance) best = candidate;
  }
  if (surface.u_period()) best.uv.u = wrap(best.uv.u, box.u.lo, *surface.u_period());
  if (surface.v_period()) best.uv.v = wrap(best.uv.v, box.v.lo, *surface.v_period());
  return best;
}

}  // namespace geovor
