// When the ends of a B-spline are one place although its knots are not periodic, and how smoothly they meet.
#pragma once

namespace geovor::closure {

/// Poles equal within this part of the largest coordinate are equal: what text with 15 digits leaves.
inline constexpr double kSame = 1e-14;

/// Derivatives are differences of poles over spans: those of both sides agree within this multiple of the rounding of a
/// pole, degree over span a derivative.
inline constexpr double kDerivative = 16.0;

/// The highest order of continuity that is measured.
inline constexpr int kMostSmooth = 2;

}  // namespace geovor::closure
