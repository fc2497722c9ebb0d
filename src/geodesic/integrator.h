// The engine of trace_geodesic: a geodesic with its Jacobi field, advanced by DOP853 from one analytic piece to the
// next.
#pragma once

#include "geodesic/geodesic_equation.h"
#include "geodesic/piece.h"
#include "surface/forms.h"

namespace geovor {

class GeodesicIntegrator {
 public:
  /// Ready at `start`, y = 0. `length` is the whole length that will be asked for: errors are shared out over it.
  GeodesicIntegrator(const Surface& surface, Uv start, UvVec direction, double length, const TraceOptions& options);

  /// Goes on to arc length `s` from the start; Converged if it gets there. Once it has failed it stays where it is.
  TraceStatus advance(double s);

  GeodesicState state() const;
  SurfaceJet jet() const { return piece_.jet(surface_, {x_[0], x_[1]}); }  ///< at the state
  double covered() const { return covered_; }
  int steps() const { return steps_; }
  int evaluations() const { return evaluations_; }

  /// The tolerance that the steps so far would have met: where one step covers the path, often far below the one asked.
  double tolerance_met() const { return worst_error_ * options_.tolerance; }

  /// Smallest box of the parameter plane that holds the path so far (to the accuracy of a cubic on each step).
  const UvBox& reach() const { return reach_; }

 private:
  GeodesicVector slope_at(const GeodesicVector& x);
  SurfaceJet refresh();
  double first_step(const SurfaceJet& j) const;
  TraceStatus enter_piece();
  TraceStatus step(double remaining);
  double error_of(const GeodesicVector& difference, double h) const;
  BorderSlack slack() const;
  bool land(const Border& border, GeodesicVector x, const GeodesicVector& slope, double s, double remaining);
  TraceStatus cross(const Border& border);
  void refract(const Border& border, const SurfaceJet& before);
  void accept(const GeodesicVector& x, double h);

  const Surface& surface_;
  double length_;
  TraceOptions options_;
  Piece piece_;
  GeodesicVector x_, slope_;
  Xyz normal_ = Xyz::Zero();       ///< Su x Sv at x_
  Xyz last_normal_ = Xyz::Zero();  ///< at the last place where the slope was evaluated
  FirstForm metric_{};             ///< at x_
  bool fresh_ = false;             ///< slope_ and metric_ belong to x_
  double next_h_ = 0.0;            ///< that the error control proposes
  double cap_;                     ///< the next step alone may not be longer: a border is known to lie there
  double covered_ = 0.0;
  double worst_error_ = 0.0;  ///< of an accepted step, in parts of what it was allowed
  int steps_ = 0;
  int evaluations_ = 0;
  UvBox reach_;
  TraceStatus status_ = TraceStatus::Converged;
};

}  // namespace geovor
