// How exact the next shots of an iteration have to be, from what the last ones missed. Private to the room.
#pragma once

#include <algorithm>
#include <cmath>

#include "voronoi/site_ray.h"

namespace geovor {

/// An iteration shoots rays, and corrects their aims to second order. All misses are relative to the length or, where
/// geodesics come together, to the Jacobi field. Only the last shots need all digits, and they need not hit: moved()
/// makes a small miss good.
class ShotLadder {
 public:
  /// `bend`: the rays' length in radii of curvature.
  ShotLadder(double bend, double tolerance) : bend_(std::max(bend, kLeastBend)), tolerance_(tolerance) {}

  /// A miss that moved() makes good to the tolerance: it leaves the third power in the length, and in the angle the
  /// square times dy/dt, which is the bend to the third power.
  double made_good() const {
    return std::min(std::cbrt(kShare * tolerance_), std::sqrt(kShare * tolerance_ / (bend_ * bend_ * bend_)));
  }

  /// For shots whose aim is off by `miss`: all digits if they may be the last, else as many as make the next ones the
  /// last, or as the corrected aim is worth.
  double tolerance_for(double miss) const {
    if (!(miss > made_good())) return tolerance_;
    return std::clamp(kBelowMiss * std::max(after(miss), made_good()), tolerance_, kRoughest);
  }

  /// What the aim corrected after a miss is off by.
  double after(double miss) const { return kMargin * miss * miss * std::min(1.0, miss + bend_ * bend_ * bend_); }

  double tolerance() const { return tolerance_; }

 private:
  static constexpr double kShare = 0.3;       ///< of the tolerance that the last step may leave open
  static constexpr double kBelowMiss = 0.1;   ///< a shot is that much more exact than what is done with it
  static constexpr double kRoughest = 1e-4;   ///< a shot that is worth having
  static constexpr double kMargin = 3.0;      ///< over the orders of magnitude
  static constexpr double kLeastBend = 1e-3;  ///< of a surface that is not quite flat

  double bend_, tolerance_;
};

}  // namespace geovor
