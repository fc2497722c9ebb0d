// The engine of trace_geodesic: a geodesic with its Jacobi field, advanced by DOP853 from one analytic piece to the
// next.
#pragma once

#include <optional>

#include "geodesic/geodesic_equation.h"
#include "geodesic/path_leg.h"
#include "geodesic/piece.h"
#include "geodesic/slowed_time.h"
#include "numeric/dop853.h"
#include "surface/forms.h"

namespace geovor {

class GeodesicIntegrator {
 public:
  /// Ready at `start`, y = 0. `length` is the whole length that will be asked for: errors are shared out over it.
  GeodesicIntegrator(const Surface& surface, Uv start, UvVec direction, double length, const TraceOptions& options);

  /// The same with the direction as a vector in space, of any length; its part in the tangent plane counts. At a pole
  /// this is the way to tell a direction (see tangent_frame).
  GeodesicIntegrator(const Surface& surface, Uv start, const Xyz& tangent, double length, const TraceOptions& options);

  /// Goes on to arc length `s` from the start; Converged if it gets there. Once it has failed it stays where it is.
  TraceStatus advance(double s);

  /// The same by one step, accepted or not; false if there is nothing more to do.
  bool advance_step(double s);

  TraceStatus status() const { return status_; }
  GeodesicState state() const;

  /// The state in space, exact at a pole too.
  SpaceState at() const;

  /// The surface's jet at the state.
  SurfaceJet jet() const;

  double covered() const { return covered_; }
  int steps() const { return steps_; }
  int evaluations() const { return evaluations_; }

  /// The tolerance that the steps so far would have met: where one step covers the path, often far below the one asked.
  double tolerance_met() const { return worst_error_ * options_.tolerance; }

  /// Smallest box of the parameter plane that holds the path so far (to the accuracy of a cubic on each step).
  const UvBox& reach() const { return reach_; }

  /// From now on every step and every line crossed is added to `record`, which outlives the integrator.
  void keep(PathRecord* record) { record_ = record; }

 private:
  void begin(Uv start, UvVec direction);
  void begin_on_chart(const PoleChart& chart, Uv start, const Xyz& tangent);
  void begin_steps(const SurfaceJet& j);
  const PoleChart* chart_near(Uv p, const Xyz& S) const;
  const Surface& map() const;
  Uv base_point() const { return chart_ == nullptr ? Uv{x_[0], x_[1]} : base_; }
  GeodesicVector slope_at(const GeodesicVector& x);
  SurfaceJet refresh();
  bool metric_fades(const SurfaceJet& j) const;
  double length_of(UvVec d) const { return (d.u * Su_ + d.v * Sv_).norm(); }
  double first_step(const SurfaceJet& j) const;
  void change_map();
  double room() const;
  TraceStatus enter_piece();
  TraceStatus step(double remaining);
  std::optional<TraceStatus> slowed_step(double remaining, const BorderSlack& beyond);
  bool reject(double h, double factor, bool regular);
  double error_of(double place, double turn, double h) const;
  double unsettled_error_of(const dop853::Step<GeodesicVector>& step, double h);
  double allowed_error(double h) const;
  BorderSlack slack() const;
  Exit exit_of(const GeodesicVector& end, double h, const BorderSlack& beyond);
  Exit dip_at(Exit turn, const BorderSlack& beyond);
  bool leaves_wedge(const GeodesicVector& x) const;
  TraceStatus stop_at_wedge(double h);
  bool land(const Border& border, GeodesicVector x, const GeodesicVector& slope, double s, double remaining);
  TraceStatus cross(const Border& border);
  bool refract(const Border& border, const SurfaceJet& before, double& bend);
  void accept(const GeodesicVector& x, double h, const SlowedStep* slowed = nullptr);
  void widen(Interval u, Interval v);

  const Surface& surface_;
  const PoleCharts& charts_;
  double length_;
  TraceOptions options_;
  const PoleChart* chart_ = nullptr;  ///< in whose coordinates x_ is; none: in the surface's parameters
  Piece piece_;
  GeodesicVector x_, slope_;
  Uv base_;              ///< the surface's parameters, while in a chart
  Xyz S_ = Xyz::Zero();  ///< at x_
  Xyz Su_ = Xyz::Zero(), Sv_ = Xyz::Zero();
  Xyz normal_ = Xyz::Zero();       ///< Su x Sv at x_
  Xyz last_normal_ = Xyz::Zero();  ///< at the last place where the slope was evaluated
  bool fresh_ = false;             ///< slope_ and the jet's parts belong to x_
  double next_h_ = 0.0;            ///< that the error control proposes
  double next_t_ = 0.0;            ///< the same in the slowed time; zero: the last step was one by arc length
  double rate_ = 0.0;              ///< the metric's, at x_
  bool fading_ = false;            ///< it is the metric that makes steps short
  double cap_;                     ///< the next step alone may not be longer: a border is known to lie there
  double unsettled_ = 0.0;  ///< difference of orders over h^3 in the last step, if that was too long for the orders
  double rounding_ = 0.0;   ///< in differences of orders, per length, where it has shown
  double covered_ = 0.0;
  double worst_error_ = 0.0;  ///< of an accepted step, in parts of what it was allowed
  int steps_ = 0;
  int evaluations_ = 0;
  UvBox reach_;
  TraceStatus status_ = TraceStatus::Converged;
  PathRecord* record_ = nullptr;
};

}  // namespace geovor
