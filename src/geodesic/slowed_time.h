// The geodesic equation in a time that slows down where the metric fades, for paths that run towards a line or point
// where the map has no tangent plane.
#pragma once

#include "geodesic/piece.h"

namespace geovor {

/// (u, v, T, y, y', s) as functions of the time t, ds = W dt, W = |Su x Sv|, with the unit tangent T in space. Where W
/// vanishes because of the parameters (x = u^2, x = u^3) the velocities u', v' have no bound and no power series, but
/// du/dt = W u' = (T x Sv) n and T, which turns with the normal curvature alone, are smooth up to the bad line.
using SlowedVector = Eigen::Matrix<double, 8, 1>;

/// The logarithmic derivative W' / W by arc length along (du, dv).
double metric_rate(const SurfaceJet& j, double du, double dv);

/// A step in the slowed time, from a state of a path.
class SlowedStep {
 public:
  /// `slope` is the state's derivative by arc length, `normal` is Su x Sv and `rate` the metric_rate there.
  SlowedStep(const Surface& surface, const Piece& piece, const GeodesicVector& x, const GeodesicVector& slope,
             const Xyz& normal, double rate);

  /// Runs for the time t. False if the metric is lost meanwhile.
  bool run(double t);

  /// Runs as long as the arc length s takes; `t` is a guess. False also if that does not settle.
  bool run_to(double s, double t);

  double time() const { return t_; }
  double arc_length() const { return z_[7]; }
  GeodesicVector end() const { return end_; }
  /// The difference to the solution of order 5.
  const SlowedVector& error5() const { return error5_; }

  /// A border is met, or perhaps met, on the way of the last run. Turns too near to one to tell count.
  bool meets_border(const BorderSlack& slack) const;

  /// What the last run swept of a parameter.
  Interval swept_by(int axis) const;

  int evaluations() const { return evaluations_; }

 private:
  SlowedVector slope_at(const SlowedVector& z);

  const Surface& surface_;
  const Piece& piece_;
  Xyz normal0_, normal_;
  double W0_;
  SlowedVector z0_, z_, error5_;
  GeodesicVector from_, from_slope_, to_;  ///< u and v with their derivatives by t, as the borders of a piece see them
  double t_ = 0.0;
  GeodesicVector end_;
  int evaluations_ = 0;
};

}  // namespace geovor
