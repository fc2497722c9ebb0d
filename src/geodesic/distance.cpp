#include "geodesic/distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "geodesic/closed_forms.h"
#include "geodesic/graph_path.h"
#include "geodesic/integrator.h"
#include "geodesic/polar_atlas.h"
#include "geodesic/relax.h"

namespace geovor {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// Rays of a fan may run so far beyond the domain: what lies at the border is between rays as well.
constexpr double kBeyondBorder = 0.05;

// Two results are one geodesic if they agree to this in length (relative) and in the angle at the start.
constexpr double kSameLength = 1e-9;
constexpr double kSameAngle = 1e-6;

// Of the displacements of one parameter that lead to the same point the nearer one.
double nearer_way(double d, std::optional<double> period) { return period ? d - *period * std::round(d / *period) : d; }

// And the one the other way round.
std::vector<double> both_ways(double d, std::optional<double> period) {
  if (!period) return {d};
  const double nearer = nearer_way(d, period);
  return {nearer, nearer - std::copysign(*period, nearer)};
}

bool same(const Connection& a, const Connection& b) {
  return std::abs(a.length - b.length) <= kSameLength * std::max(a.length, b.length) &&
         std::abs(std::remainder(a.angle - b.angle, 2.0 * M_PI)) <= kSameAngle;
}

void keep(DistanceResult& result, const Connection& c) {
  result.evaluations += c.evaluations;
  if (c.status != ConnectStatus::Converged) return;
  auto& all = result.candidates;
  if (std::any_of(all.begin(), all.end(), [&](const Connection& a) { return same(a, c); })) return;
  // Stays sorted by length, of equal ones the first found first.
  all.insert(std::upper_bound(all.begin(), all.end(), c,
                              [](const Connection& a, const Connection& b) { return a.length < b.length; }),
             c);
}

// Of one parameter: the range that holds every path shorter than `length` between the two, if the parameter changes by
// `rate` or less per unit of length; within the domain, or one period.
Interval search_range(double a, double b, double length, double rate, Interval domain, std::optional<double> period) {
  const double margin = 0.5 * length * rate;
  Interval range{std::min(a, b) - margin, std::max(a, b) + margin};
  if (period) return range.length() < *period ? range : Interval{std::min(a, b), std::min(a, b) + *period};
  return {std::max(range.lo, domain.lo), std::min(range.hi, domain.hi)};
}

// The grid follows the length of the best path so far: what lies farther off cannot be on a shorter one. The rates are
// those at three points only, hence the factor.
UvBox search_box(const Surface& surface, const Ends& ends, double length) {
  constexpr double kAllowance = 2.0;
  double rate_u = 0.0, rate_v = 0.0;
  for (const SurfaceJet& j : {ends.at_from, surface.jet(lerp(ends.from, ends.to, 0.5)), ends.at_to}) {
    const double W = j.Su.cross(j.Sv).norm();
    if (!(W > 0.0)) continue;
    rate_u = std::max(rate_u, kAllowance * j.Sv.norm() / W);
    rate_v = std::max(rate_v, kAllowance * j.Su.norm() / W);
  }
  const UvBox domain = surface.domain();
  return {search_range(ends.from.u, ends.to.u, length, rate_u, domain.u, surface.u_period()),
          search_range(ends.from.v, ends.to.v, length, rate_v, domain.v, surface.v_period())};
}

// A rough shortest path on a grid that holds all paths that are no longer than `length`; empty if there is none.
std::vector<Uv> rough_path(const Surface& surface, const Ends& ends, double length, int cells) {
  constexpr int kFewestCells = 4;
  const UvBox box = search_box(surface, ends, length);
  if (!(box.u.length() > 0.0 && box.v.length() > 0.0 && box.u.length() < kInf && box.v.length() < kInf)) return {};
  return graph_path(surface, ends.from, ends.to, box, std::max(cells, kFewestCells));
}

// Length of a polyline of the parameter plane, on the surface: its pieces are cut up, for they may be as long as the
// surface's waves.
double length_of(const Surface& surface, const std::vector<Uv>& points) {
  constexpr int kParts = 8;
  double length = 0.0;
  Xyz last = surface.position(points.front());
  for (std::size_t i = 1; i < points.size(); ++i)
    for (int part = 1; part <= kParts; ++part) {
      const Xyz next = surface.position(lerp(points[i - 1], points[i], double(part) / kParts));
      length += (next - last).norm();
      last = next;
    }
  return length;
}

// A hit beside a geodesic that is known already.
bool is_known(const AtlasHit& hit, const std::vector<Connection>& all) {
  return std::any_of(all.begin(), all.end(), [&](const Connection& c) { return is_meant(hit, {c.length, c.angle}); });
}

std::optional<DomainExit> first_exit(const Surface& surface, Uv from, const Connection& c) {
  if (!c.leaves_domain) return std::nullopt;
  GeodesicIntegrator path(surface, from, tangent_frame(surface, from).at_angle(c.angle), c.length, TraceOptions{});
  path.advance(c.length);
  return DomainExit{path.at().p, path.covered()};
}

// Relative. Lengths that differ by less are equal as far as two runs of the solver can tell, and as far as a symmetric
// shape is symmetric once a file has carried it.
double equal_lengths(const DistanceOptions& options) {
  constexpr double kErrors = 10.0, kFile = 1e-11;
  return std::max(kErrors * options.connect.tolerance, kFile);
}

// Every direction is as good where a few others, followed as far, end at the same point too. Only where the paths' ends
// are conjugate need that be tried; on a sphere conjugate points are opposite ones.
bool is_family(const Surface& surface, Uv from, Uv to, const Connection& c, const DistanceOptions& options) {
  constexpr double kConjugate = 1e-6, kOpposite = 1e-14, kPaths = 10.0;
  if (has_closed_form(surface))
    return surface.kind() == SurfaceKind::Sphere && std::abs(c.y) <= kOpposite * c.length && c.length > 0.0;
  if (!(c.length > 0.0 && std::abs(c.y) <= kConjugate * c.length)) return false;
  const TangentFrame frame = tangent_frame(surface, from);
  const Xyz target = surface.position(to);
  TraceOptions trace;
  trace.tolerance = options.connect.tolerance;
  trace.stop_at_domain = false;
  for (const double turn : {1.0, 2.5, 4.0}) {
    GeodesicIntegrator path(surface, from, frame.at_angle(c.angle + turn), c.length, trace);
    if (path.advance(c.length) != TraceStatus::Converged) return false;
    if (!((path.at().S - target).norm() <= kPaths * equal_lengths(options) * c.length)) return false;
  }
  return true;
}

void conclude(const Surface& surface, Uv from, Uv to, const DistanceOptions& options, DistanceResult& result) {
  if (result.candidates.empty()) return;
  result.shortest = result.candidates.front();
  result.status = result.shortest.status;
  const double tie = result.shortest.length * (1.0 + equal_lengths(options));
  for (const Connection& c : result.candidates)
    if (c.length <= tie) result.shortest_paths.push_back(c);
  result.family = is_family(surface, from, to, result.shortest, options);
  if (result.family) result.shortest_paths.resize(1);
  result.leaves_at = first_exit(surface, from, result.shortest);
}

}  // namespace

DistanceFinder::DistanceFinder(SurfacePtr surface, const DistanceOptions& options)
    : surface_(std::move(surface)), options_(options) {
  if (!has_closed_form(*surface_)) survey_.emplace(*surface_, options_.survey);
}

DistanceFinder::DistanceFinder(const Surface& surface, const DistanceOptions& options)
    : DistanceFinder(SurfacePtr(std::shared_ptr<const Surface>(), &surface), options) {}

DistanceResult DistanceFinder::distance(Uv from, Uv to, std::optional<Polar> guess) const {
  const Surface& surface = *surface_;
  DistanceResult result;
  if (!is_finite(from) || !is_finite(to)) return result;
  if (const auto closed = connections_closed_form(surface, from, to)) {
    for (const Connection& c : *closed) keep(result, c);
    if (result.candidates.empty()) return result;  // the two nappes of a cone meet in its tip only
    result.certainty = Certainty::ClosedForm;
    result.doubt = Doubt::None;
    conclude(surface, from, to, options_, result);
    return result;
  }
  const UvVec way{nearer_way(to.u - from.u, surface.u_period()), nearer_way(to.v - from.v, surface.v_period())};
  result.shortest = connect(surface, from, from + way, guess, options_.connect);
  result.status = result.shortest.status;
  keep(result, result.shortest);
  if (!settled_by_curvature(from, result)) search_far(from, from + way, result);
  conclude(surface, from, to, options_, result);
  return result;
}

// Sets certainty or doubt.
bool DistanceFinder::settled_by_curvature(Uv from, DistanceResult& result) const {
  const Connection& c = result.shortest;
  result.doubt = c.status == ConnectStatus::DegenerateMetric ? Doubt::Degenerate : Doubt::NotConverged;
  if (c.status != ConnectStatus::Converged) return false;
  result.doubt = c.leaves_domain ? Doubt::LeavesDomain : Doubt::NotSearched;
  if (c.leaves_domain) return false;
  const auto region = survey_->ball(from, c.length);
  if (c.length > 0.0 && !region) return false;
  result.second_at_least = c.length > 0.0 ? second_geodesic_at_least(*region, c.length) : kInf;
  if (!(result.second_at_least > c.length)) return false;
  result.certainty = Certainty::Curvature;
  result.doubt = Doubt::None;
  return true;
}

// No shortest path is longer than the path found so far, nor than any other path.
void DistanceFinder::search_far(Uv from, Uv to, DistanceResult& result) const {
  constexpr double kDirect = 1.2;  // a path no longer than this many chords needs no other bound
  constexpr double kRough = 1.02;  // the allowance for the length of a polyline
  const Surface& surface = *surface_;
  if (result.status == ConnectStatus::DegenerateMetric) return;
  const Ends ends(surface, from, to);
  double bound =
      result.candidates.empty() ? length_of(surface, {from, lerp(from, to, 0.5), to}) : result.shortest.length;
  std::vector<Uv> rough;
  if (options_.grid > 0 && bound > kDirect * ends.chord()) {
    rough = rough_path(surface, ends, bound, options_.grid);
    if (!rough.empty()) bound = std::min(bound, kRough * length_of(surface, rough));
  }
  if (options_.fan && search_fan_of(ends, bound, result)) return;
  if (!rough.empty()) keep(result, connect_along(surface, Ends(surface, from, rough.back()), rough, options_.connect));
  for (const double du : both_ways(to.u - from.u, surface.u_period()))
    for (const double dv : both_ways(to.v - from.v, surface.v_period())) {
      const Ends way(surface, from, from + UvVec{du, dv});
      if (!(way.to == to))
        keep(result, connect(surface, from, way.to, guess_from_parameters(surface, way), options_.connect));
    }
}

// True if the answer is certain now.
bool DistanceFinder::search_fan_of(const Ends& ends, double bound, DistanceResult& result) const {
  const PolarAtlas fan(*surface_, ends.from, {bound, kBeyondBorder, ends.at_to.S});
  result.evaluations += fan.evaluations();
  ConnectOptions once = options_.connect;
  once.persist = false;
  std::vector<AtlasHit> unsettled;
  for (const AtlasHit& hit : fan.hits(ends.at_to.S, kInf)) {
    if (is_known(hit, result.candidates)) continue;
    const Connection c = connect(*surface_, ends.from, ends.to, hit.at, once);
    if (c.status != ConnectStatus::Converged && hit.plain) unsettled.push_back(hit);
    keep(result, c);
  }
  // A plain hit from which no geodesic was found may stand for a shorter one; nor was anything searched beyond the
  // fan's reach.
  const auto in_doubt = [&](double length) {
    return length > PolarAtlas::kReach * bound ||
           std::any_of(unsettled.begin(), unsettled.end(), [&](const AtlasHit& hit) {
             return hit.at.s < (1.0 - kHitError) * length && !is_known(hit, result.candidates);
           });
  };
  if (result.candidates.empty()) {
    result.doubt = Doubt::NotConverged;
  } else if (result.candidates.front().leaves_domain) {
    result.doubt = Doubt::LeavesDomain;
  } else if (std::isfinite(fan.complete_to()) || in_doubt(result.candidates.front().length)) {
    result.doubt = Doubt::FanLost;
  } else {
    result.certainty = Certainty::Fan;
    result.doubt = Doubt::None;
  }
  return result.certainty == Certainty::Fan;
}

DistanceResult distance(const Surface& surface, Uv from, Uv to, const DistanceOptions& options) {
  DistanceOptions once = options;
  once.survey = 0;  // the fewest cells: a single question does not pay for more
  return DistanceFinder(surface, once).distance(from, to);
}

namespace {

std::string place(const std::optional<Uv>& at) {
  if (!at) return "";
  std::ostringstream text;
  text << ", at (" << at->u << ", " << at->v << ")";
  return text.str();
}

}  // namespace

std::string explain(const DistanceResult& result) {
  switch (result.certainty) {
    case Certainty::ClosedForm:
      return "certain: the surface's geodesics are known in closed form";
    case Certainty::Curvature:
      return "certain: no second geodesic this short can exist, for the curvature round about";
    case Certainty::Fan:
      return "certain: the geodesics that leave the first point were searched all round as far as the path is long";
    case Certainty::None:
      break;
  }
  switch (result.doubt) {
    case Doubt::Degenerate:
      return "not certain: a place without tangent plane stands in the way" + place(result.shortest.degenerate_at);
    case Doubt::LeavesDomain:
      return "not certain: the path leaves the surface's domain";
    case Doubt::NotSearched:
      return "not certain: the points are far from each other, and the way all round was not searched";
    case Doubt::FanLost:
      return "not certain: some of the geodesics that leave the first point could not be followed far enough";
    case Doubt::NotConverged:
    case Doubt::None:
      break;
  }
  return "not certain: no geodesic between the two was found";
}

}  // namespace geovor
