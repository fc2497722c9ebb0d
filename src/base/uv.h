// Points and directions of the parameter plane. A place and a direction are different types, so that
// adding two places, or reading a direction as a place, does not compile.
#pragma once

#include <cmath>

namespace geovor {

/// A direction (or a displacement) in the parameter plane.
struct UvVec {
  double u = 0.0;
  double v = 0.0;
};

/// A place in the parameter plane.
struct Uv {
  double u = 0.0;
  double v = 0.0;
};

constexpr UvVec operator+(UvVec a, UvVec b) { return {a.u + b.u, a.v + b.v}; }
constexpr UvVec operator-(UvVec a, UvVec b) { return {a.u - b.u, a.v - b.v}; }
constexpr UvVec operator-(UvVec a) { return {-a.u, -a.v}; }
constexpr UvVec operator*(double k, UvVec a) { return {k * a.u, k * a.v}; }
constexpr UvVec operator-(Uv a, Uv b) { return {a.u - b.u, a.v - b.v}; }
constexpr Uv operator+(Uv a, UvVec b) { return {a.u + b.u, a.v + b.v}; }
constexpr bool operator==(Uv a, Uv b) { return a.u == b.u && a.v == b.v; }

/// The determinant of two directions: twice the signed area of their triangle in the parameter plane.
constexpr double cross(UvVec a, UvVec b) { return a.u * b.v - a.v * b.u; }

/// The point of the straight parameter segment from `a` (k = 0) to `b` (k = 1).
constexpr Uv lerp(Uv a, Uv b, double k) { return {a.u + k * (b.u - a.u), a.v + k * (b.v - a.v)}; }

inline bool is_finite(Uv a) { return std::isfinite(a.u) && std::isfinite(a.v); }
inline bool is_finite(UvVec a) { return std::isfinite(a.u) && std::isfinite(a.v); }

}  // namespace geovor
