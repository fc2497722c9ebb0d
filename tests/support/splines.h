// B-spline surfaces for tests: seeded random ones, and the same surface with one knot more.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "support/differences.h"
#include "surface/bspline_surface.h"

namespace geovor::testing {

/// What a BSplineSurface is made of, open in both directions, knots flat.
struct SplineData {
  int u_degree = 3, v_degree = 3;
  std::vector<double> u_knots, v_knots;
  std::vector<Xyz> poles;  // v runs first
  std::vector<double> weights;

  int u_count() const { return static_cast<int>(u_knots.size()) - u_degree - 1; }
  int v_count() const { return static_cast<int>(v_knots.size()) - v_degree - 1; }
  BSplineSurface surface() const {
    return {KnotVector::from_flat(u_knots, u_degree), KnotVector::from_flat(v_knots, v_degree), poles, weights};
  }
};

/// Clamped knots over [0, spans] with unequal spans.
inline std::vector<double> clamped_knots(int degree, int spans, std::mt19937& random) {
  std::vector<double> knots(degree + 1, 0.0);
  for (int i = 1; i < spans; ++i) knots.push_back(i + uniform(random, -0.3, 0.3));
  knots.insert(knots.end(), degree + 1, spans);
  return knots;
}

/// A wavy sheet over about [0, spans]^2.
inline SplineData random_spline(int u_degree, int v_degree, int spans, bool rational, unsigned seed) {
  std::mt19937 random(seed);
  SplineData d;
  d.u_degree = u_degree;
  d.v_degree = v_degree;
  d.u_knots = clamped_knots(u_degree, spans, random);
  d.v_knots = clamped_knots(v_degree, spans, random);
  for (int i = 0; i < d.u_count(); ++i) {
    for (int j = 0; j < d.v_count(); ++j) {
      d.poles.push_back({i * spans / (d.u_count() - 1.0) + uniform(random, -0.1, 0.1),
                         j * spans / (d.v_count() - 1.0) + uniform(random, -0.1, 0.1), uniform(random, -0.5, 0.5)});
      if (rational) d.weights.push_back(uniform(random, 0.5, 2.0));
    }
  }
  return d;
}

/// Boehm's algorithm: one more knot at x in u, the same surface. REQUIRES: x inside the domain
inline SplineData insert_u_knot(const SplineData& d, double x) {
  const int p = d.u_degree, n = d.u_count(), m = d.v_count();
  int k = p;
  while (d.u_knots[k + 1] <= x) ++k;
  SplineData out = d;
  out.u_knots.insert(out.u_knots.begin() + k + 1, x);
  out.poles.clear();
  out.weights.clear();
  auto weight = [&](int i, int j) { return d.weights.empty() ? 1.0 : d.weights[i * m + j]; };
  for (int i = 0; i <= n; ++i) {
    double a = (i <= k - p) ? 1.0 : 0.0;
    if (i > k - p && i <= k) a = (x - d.u_knots[i]) / (d.u_knots[i + p] - d.u_knots[i]);
    for (int j = 0; j < m; ++j) {
      const int here = std::min(i, n - 1), before = std::max(i - 1, 0);
      const double w = a * weight(here, j) + (1.0 - a) * weight(before, j);
      const Xyz wP =
          a * weight(here, j) * d.poles[here * m + j] + (1.0 - a) * weight(before, j) * d.poles[before * m + j];
      out.poles.push_back(wP / w);
      if (!d.weights.empty()) out.weights.push_back(w);
    }
  }
  return out;
}

/// The torus of radii R and r as a rational biquadratic of 4 x 4 quarter arcs of an angle pi/2 each, periodic or
/// clamped.
inline BSplineSurface spline_torus(double R, double r, bool periodic) {
  const double kHalf = std::numbers::sqrt2 / 2.0;
  const double corner[9][3] = {{1, 0, 1},       {1, 1, kHalf}, {0, 1, 1},      {-1, 1, kHalf}, {-1, 0, 1},
                               {-1, -1, kHalf}, {0, -1, 1},    {1, -1, kHalf}, {1, 0, 1}};
  const std::vector<double> knots{0, 1, 2, 3, 4};
  const std::vector<int> multiplicities = periodic ? std::vector<int>{2, 2, 2, 2, 2} : std::vector<int>{3, 2, 2, 2, 3};
  const KnotVector k(knots, multiplicities, 2, periodic);
  const int n = periodic ? 8 : 9;
  std::vector<Xyz> poles;
  std::vector<double> weights;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double radius = R + r * corner[j][0];
      poles.push_back({radius * corner[i][0], radius * corner[i][1], r * corner[j][1]});
      weights.push_back(corner[i][2] * corner[j][2]);
    }
  }
  return {k, k, poles, weights};
}

}  // namespace geovor::testing
