// The B-spline surfaces that are timed, as plain data, so that geovor and OpenCASCADE are given the same.
#pragma once

#include <vector>

#include "surface/bspline_surface.h"

namespace geovor::bench {

/// Clamped equidistant knots, all inner ones simple, degree p in u and q in v.
struct Spline {
  int p = 3, q = 3;
  std::vector<double> u_knots, v_knots;  ///< distinct
  std::vector<Xyz> poles;                ///< v runs first
  std::vector<double> weights;           ///< empty: polynomial

  int u_count() const { return static_cast<int>(u_knots.size()) + p - 1; }
  int v_count() const { return static_cast<int>(v_knots.size()) + q - 1; }
  BSplineSurface surface() const;
};

/// 1 at each end p + 1 times, once inside.
std::vector<int> clamped_multiplicities(const std::vector<double>& knots, int degree);

/// A wavy sheet over about [0, spans]^2, from a fixed seed.
Spline wavy_sheet(int p, int q, int spans, bool rational);

/// z = sin u cos v over [-half, half]^2, each factor interpolated by a cubic C2 spline with knots `step` apart.
Spline cubic_wave(double half, double step);

}  // namespace geovor::bench
