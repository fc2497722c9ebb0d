#include "geodesic/distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geodesic/closed_forms.h"
#include "geodesic/graph_path.h"
#include "geodesic/relax.h"

namespace geovor {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// Two results are one geodesic if they agree to this in length (relative) and in the angle at the start.
constexpr double kSameLength = 1e-9;
constexpr double kSameAngle = 1e-6;

// The displacements of one parameter that lead to the same point: the nearer one and the one the other way round.
std::vector<double> both_ways(double d, std::optional<double> period) {
  if (!period) return {d};
  const double nearer = d - *period * std::round(d / *period);
  return {nearer, nearer - std::copysign(*period, nearer)};
}

bool same(const Connection& a, const Connection& b) {
  return std::abs(a.length - b.length) <= kSameLength * std::max(a.length, b.length) &&
         std::abs(std::remainder(a.angle - b.angle, 2.0 * M_PI)) <= kSameAngle;
}

void keep(std::vector<Connection>& all, const Connection& c) {
  if (c.status != ConnectStatus::Converged) return;
  const bool known = std::any_of(all.begin(), all.end(), [&](const Connection& a) { return same(a, c); });
  if (!known) all.push_back(c);
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

double straight_length(const Surface& surface, Uv from, Uv to) {
  constexpr int kPieces = 16;
  double length = 0.0;
  Xyz last = surface.position(from);
  for (int i = 1; i <= kPieces; ++i) {
    const Xyz next = surface.position(lerp(from, to, double(i) / kPieces));
    length += (next - last).norm();
    last = next;
  }
  return length;
}

void try_grid(const Surface& surface, Uv from, Uv to, const DistanceOptions& options, std::vector<Connection>& all) {
  constexpr int kFewestCells = 4;
  const Ends ends(surface, from, to);
  double length = straight_length(surface, from, to);
  for (const Connection& c : all) length = std::min(length, c.length);
  const UvBox box = search_box(surface, ends, length);
  if (!(box.u.length() > 0.0 && box.v.length() > 0.0 && box.u.length() < kInf && box.v.length() < kInf)) return;
  const auto path = graph_path(surface, from, to, box, std::max(options.grid, kFewestCells));
  if (path.empty()) return;
  keep(all, connect_along(surface, Ends(surface, from, path.back()), path, options.connect));
}

void sort_by_length(std::vector<Connection>& all) {
  std::stable_sort(all.begin(), all.end(),
                   [](const Connection& a, const Connection& b) { return a.length < b.length; });
}

// Lengths that differ by less are equal as far as two runs of the solver can tell.
double tie(const DistanceOptions& options) {
  constexpr double kErrors = 10.0;
  return kErrors * options.connect.tolerance;
}

std::optional<DomainExit> first_exit(const Surface& surface, Uv from, const Connection& c) {
  if (!c.leaves_domain) return std::nullopt;
  const TraceResult path = trace_geodesic(surface, from, c.start_direction, c.length);
  return DomainExit{path.end.p, path.length};
}

void conclude(const Surface& surface, Uv from, const DistanceOptions& options, DistanceResult& result) {
  sort_by_length(result.candidates);
  if (result.candidates.empty()) return;
  result.shortest = result.candidates.front();
  result.status = result.shortest.status;
  for (const Connection& c : result.candidates)
    if (c.length <= result.shortest.length * (1.0 + tie(options))) result.shortest_paths.push_back(c);
  result.leaves_at = first_exit(surface, from, result.shortest);
}

}  // namespace

DistanceFinder::DistanceFinder(SurfacePtr surface, const DistanceOptions& options)
    : surface_(std::move(surface)), options_(options) {}

DistanceFinder::DistanceFinder(const Surface& surface, const DistanceOptions& options)
    : DistanceFinder(SurfacePtr(std::shared_ptr<const Surface>(), &surface), options) {}

DistanceResult DistanceFinder::distance(Uv from, Uv to, std::optional<Polar> guess) const {
  const Surface& surface = *surface_;
  const DistanceOptions& options = options_;
  DistanceResult result;
  if (auto closed = connections_closed_form(surface, from, to)) {
    result.candidates = std::move(*closed);
    result.certainty = Certainty::ClosedForm;
    result.doubt = Doubt::None;
    conclude(surface, from, options, result);
    return result;
  }
  const auto ways_u = both_ways(to.u - from.u, surface.u_period());
  const auto ways_v = both_ways(to.v - from.v, surface.v_period());
  const Uv nearest = from + UvVec{ways_u.front(), ways_v.front()};
  const Connection straight = connect(surface, from, nearest, std::nullopt, options.connect);
  if (guess) keep(result.candidates, connect(surface, from, to, guess, options.connect));
  keep(result.candidates, straight);
  result.shortest = straight;
  result.status = straight.status;
  result.doubt = Doubt::NotSearched;
  const bool zero = straight.status == ConnectStatus::Converged && straight.length == 0.0;
  if (straight.status != ConnectStatus::DegenerateMetric && !zero) {
    for (const double du : ways_u)
      for (const double dv : ways_v) {
        const Ends ends(surface, from, from + UvVec{du, dv});
        if (ends.to == nearest) continue;
        keep(result.candidates, connect(surface, from, ends.to, guess_from_parameters(surface, ends), options.connect));
      }
    if (options.grid > 0) try_grid(surface, from, nearest, options, result.candidates);
  }
  conclude(surface, from, options, result);
  for (const Connection& c : result.candidates) result.evaluations += c.evaluations;
  if (result.status == ConnectStatus::DegenerateMetric) result.doubt = Doubt::Degenerate;
  if (result.status == ConnectStatus::NotConverged) result.doubt = Doubt::NotConverged;
  return result;
}

DistanceResult distance(const Surface& surface, Uv from, Uv to, const DistanceOptions& options) {
  return DistanceFinder(surface, options).distance(from, to);
}

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
      return "not certain: a place without tangent plane stands in the way";
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
