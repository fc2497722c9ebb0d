#include "geodesic/ray_source.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geodesic/closed_form_path.h"
#include "geodesic/closed_forms.h"
#include "geodesic/integrator.h"
#include "numeric/dop853.h"
#include "surface/forms.h"
#include "surface/pole_chart.h"

namespace geovor {
namespace {

// One step of DOP853 covers this many radii of curvature times tolerance^(1/9): see kFirstStep and kStretch of the
// integrator.
constexpr double kOneStep = 1.75;

// What the estimate of a step's error may be, in tolerances (kAllowed of the integrator).
constexpr double kAllowed = 4.0;

// One step of order 4 over x radii of curvature errs by less than this times x^5 on waves, tori and ellipsoids.
constexpr double kOrder4 = 0.05;

// A ray counts as one on a single piece if it stays off the borders by this part of what it sweeps: the cubic that
// tells the sweep errs by less on a step that meets its tolerance.
constexpr double kClear = 0.1;

struct Flow {
  const Surface& surface;
  const Piece& piece;
  Xyz normal = Xyz::Zero();  ///< Su x Sv at the last place
  GeodesicVector operator()(const GeodesicVector& x) {
    return geodesic_slope(piece.jet(surface, {x[0], x[1]}), x, normal);
  }
};

GeodesicVector classical_step(const GeodesicVector& x, const GeodesicVector& k1, double h, Flow& flow) {
  const GeodesicVector k2 = flow(x + 0.5 * h * k1), k3 = flow(x + 0.5 * h * k2), k4 = flow(x + h * k3);
  return x + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

// Of the whole ray, relative to its length: as the integrator counts errors, and to what both its estimates say.
double error_of(const dop853::Step<GeodesicVector>& step, const SurfaceJet& j, double s) {
  const auto size = [&](const GeodesicVector& e) {
    const double place = push_forward(j, {e[0], e[1]}).norm() + std::abs(e[4]);
    return std::max(place / s, push_forward(j, {e[2], e[3]}).norm() + std::abs(e[5]));
  };
  const double difference = size(step.error5);
  const double settled = dop853::error_estimate(difference);
  if (!(difference > 2.0 * std::numeric_limits<double>::epsilon())) return settled;
  return std::max(settled, dop853::unsettled_error(difference, size(step.error3)));
}

bool within(Interval sweep, Interval range) {
  const double clear = kClear * sweep.length();
  return sweep.lo - clear > range.lo && sweep.hi + clear < range.hi;
}

}  // namespace

RaySource::RaySource(const Surface& surface, Uv p, const CurvatureMap* map)
    : surface_(&surface),
      p_(p),
      jet_(surface.jet(p)),
      frame_(tangent_frame(surface, p)),
      piece_(surface, p, {}, false),
      map_(map),
      curvature_(std::max(curvatures(jet_).largest(), map ? 1.0 / map->radius(p) : 0.0)),
      closed_form_(has_closed_form(surface)) {}

TracedRay RaySource::end(double s, double t, const TraceOptions& options) const {
  const Xyz T = frame_.at_angle(t);
  if (closed_form_) return in_closed_form(T, s);
  if (std::isfinite(curvature_) && !options.stop_at_domain && s > 0.0 && !near_pole(s)) {
    TracedRay end = one_step(T, s, options.tolerance);
    if (end.status == TraceStatus::Converged) return end;
  }
  GeodesicIntegrator path(*surface_, p_, T, s, options);
  TracedRay end;
  end.status = TraceStatus::Converged;
  double met = 0.0;
  for (double leg = 0.0; leg < s && end.status == TraceStatus::Converged;) {
    const Uv from = path.state().p;
    const double before = leg;
    leg = map_ ? map_->leg_end(from, leg, s, options.tolerance) : s;
    if (map_) met = std::max(met, map_->tolerance_of(from, leg - before));
    while (end.status == TraceStatus::Converged && path.advance_step(leg)) {
      end.status = map_ && !map_->near_domain(path.state().p) ? TraceStatus::LeftDomain : path.status();
    }
  }
  end.at = path.at();
  end.d = path.state().d;
  end.jet = path.jet();
  end.tolerance = std::min(std::max(met, path.tolerance_met()), options.tolerance);
  end.evaluations = path.evaluations() + 2;
  return end;
}

TracedRay RaySource::in_closed_form(const Xyz& T, double s) const {
  const UvVec direction = tangent_components(jet_, T);
  const TraceResult path = *trace_closed_form(*surface_, p_, direction, s);
  TracedRay end;
  end.status = path.status;
  end.at = closed_form_at(*surface_, p_, direction, T, path.length);
  end.d = path.end.d;
  end.jet = surface_->jet(path.end.p);
  end.tolerance = 0.0;
  end.evaluations = 1;
  return end;
}

// No point of the ray is nearer to a pole than the source less its length.
bool RaySource::near_pole(double s) const {
  const auto near = [&](const auto& chart) { return !((frame_.S - chart->pole()).norm() - s > chart->radius()); };
  const PoleCharts& charts = surface_->poles();
  return std::any_of(charts.begin(), charts.end(), near);
}

bool RaySource::stays_on_piece(const GeodesicVector& x, const GeodesicVector& end, double h) const {
  return within(swept(x[0], end[0], x[2], end[2], h), piece_.range(0)) &&
         within(swept(x[1], end[1], x[3], end[3], h), piece_.range(1));
}

// The ray in one step, if that meets the tolerance and no border; StepLimit if not.
TracedRay RaySource::one_step(const Xyz& T, double s, double tolerance) const {
  const UvVec d = tangent_components(jet_, T);
  const GeodesicVector x = to_vector({p_, d, 0.0, 1.0});
  Flow flow{*surface_, piece_};
  Xyz normal;
  const GeodesicVector slope = geodesic_slope(jet_, x, normal);
  const double reach = s * std::max(curvature_, push_forward(jet_, {slope[2], slope[3]}).norm());
  // The parabola tells at no cost that a ray leaves its piece, as most do where knots are dense.
  const GeodesicVector ahead = x + s * slope;
  if (!stays_on_piece(x, ahead, s)) return {};
  const auto short_enough_loose = [&](double bend) { return kOrder4 * std::pow(bend, 5) <= tolerance; };
  const auto short_enough_for = [](double bend) { return std::pow(bend / kOneStep, dop853::kErrorOrder); };
  const bool loose = tolerance >= kLoosest && short_enough_loose(reach);
  if (!loose && !(short_enough_for(reach) <= tolerance)) return {};
  GeodesicVector end;
  double met = std::numeric_limits<double>::infinity();
  if (loose) {
    end = classical_step(x, slope, s, flow);
  } else {
    const auto step = dop853::step(x, slope, s, flow);
    met = std::max(error_of(step, jet_, s) / kAllowed, short_enough_for(reach));
    end = step.state;
    if (!(met <= tolerance)) return {};
  }
  if (!(flow.normal.dot(normal) > 0.0 && stays_on_piece(x, end, s))) return {};
  TracedRay ray = finish(end, met, loose ? 4 : dop853::kStages);
  // The step may have come from a flat place to a curved one that it knows nothing of.
  const double bend = s * curvatures(ray.jet).largest();
  if (!loose) ray.tolerance = std::max(met, short_enough_for(bend));
  if (!(loose ? short_enough_loose(bend) : ray.tolerance <= tolerance)) return {};
  return ray;
}

TracedRay RaySource::finish(const GeodesicVector& x, double tolerance, int evaluations) const {
  TracedRay end;
  end.jet = piece_.jet(*surface_, {x[0], x[1]});
  end.d = {x[2], x[3]};
  end.at = {end.jet.S, push_forward(end.jet, end.d).normalized(), unit_normal(end.jet), x[4], x[5], {x[0], x[1]}};
  end.tolerance = tolerance;
  end.evaluations = evaluations;
  end.status = end.at.normal.allFinite() ? TraceStatus::Converged : TraceStatus::StepLimit;
  return end;
}

}  // namespace geovor
