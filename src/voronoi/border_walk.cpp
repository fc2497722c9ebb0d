#include "voronoi/border_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/gauss_legendre.h"
#include "numeric/worst_of.h"
#include "surface/forms.h"

namespace geovor {
namespace {

// A segment of the border is taken in parts that are seen from the site under so small an angle that of the polynomial
// through the nodes the highest term is this part of the whole: with terms that fall evenly the rule of twice the order
// leaves 1e-8. None is shorter than a part of the segment: the border may run through the site.
constexpr double kFirstPart = 0.1;
constexpr double kLongestPart = 0.5;
constexpr double kShortestPart = 1e-4;
constexpr int kNodes = 5;
constexpr double kHighestTerm = 1e-3;

// Parts twice as long have a term 16 times as large.
constexpr double kMuchLess = 0.05;

// Between two places a ray's angle changes by what its slopes at both say, but for this part of it; more means another
// geodesic of the site. A change too small to tell is none.
constexpr double kJump = 0.25;
constexpr double kNoChange = 1e-6;

// Within so many steps of the site the border passes it by, and its ray may turn about.
constexpr double kBesideSite = 4.0;

/// Legendre's polynomial of degree kNodes - 1.
double highest(double x) { return (35.0 * x * x * x * x - 30.0 * x * x + 3.0) / 8.0; }

bool jumps(const SiteRay& a, const SiteRay& b) {
  const Xyz way = b.x - a.x;
  if (std::min(a.polar.s, b.polar.s) <= kBesideSite * way.norm()) return false;
  const double from = a.N.dot(way) / a.y, to = b.N.dot(way) / b.y;
  const double off = wrap_angle(b.polar.t - a.polar.t - 0.5 * (from + to));
  return !(std::abs(off) <= kJump * (std::abs(from) + std::abs(to)) + kNoChange);
}

class Walker {
 public:
  Walker(const SiteRays& rays, int site) : rays_(rays), site_(site) {}

  /// The ray to the place next to the last one; without one, the shortest. False where the last ray does not go on.
  bool step_to(Uv m);
  void start_with(const SiteRay& ray) { last_ = ray; }
  void segment(const FaceBorder& border, int cycle, int k, Interval part_of_it);
  const std::optional<SiteRay>& last() const { return last_; }
  ChartPiece& seen() { return seen_; }

 private:
  bool take(const FaceBorder& border, int cycle, int k, Interval part);

  const SiteRays& rays_;
  int site_;
  std::optional<SiteRay> last_;
  double angle_ = kFirstPart;  ///< under which the next part is to be seen
  double highest_term_ = 0.0;  ///< of the last part, see kHighestTerm
  double run_back_ = 0.0;      ///< by which the angle has fallen since it last grew, as a width in space
  ChartPiece seen_;
};

bool Walker::step_to(Uv m) {
  const Xyz x = rays_.surface().position(m);
  std::optional<SiteRay> ray;
  if (last_) ray = rays_.to(site_, m, carry(*last_, x));
  if (ray && last_ && jumps(*last_, *ray)) ray.reset();
  if (!ray) ray = rays_.to(site_, m);
  if (!ray || (last_ && jumps(*last_, *ray))) return false;
  if (last_) {
    const double turn = wrap_angle(ray->polar.t - last_->polar.t);
    seen_.turn += turn;
    const double back = -turn * std::abs(ray->y);
    seen_.back = larger_of(seen_.back, back / ray->polar.s);
    run_back_ = back > 0.0 ? run_back_ + back : 0.0;
    seen_.hidden = larger_of(seen_.hidden, run_back_);
  }
  if (!(ray->polar.s <= seen_.middle.s)) seen_.middle = ray->polar;
  seen_.least_y = smaller_of(seen_.least_y, ray->y / ray->polar.s);
  seen_.shortest = seen_.shortest > 0.0 ? smaller_of(seen_.shortest, ray->polar.s) : ray->polar.s;
  last_ = ray;
  return true;
}

// The slope of a place in t is the way along N divided by y.
bool Walker::take(const FaceBorder& border, int cycle, int k, Interval part) {
  const GaussRule& rule = gauss_legendre(kNodes);
  const Surface& surface = rays_.surface();
  double sum = 0.0, scale = 0.0, term = 0.0;
  for (int i = 0; i < kNodes; ++i) {
    const double at = part.lo + 0.5 * (1.0 + rule.nodes[i]) * part.length();
    const Uv m = border.uv_in_segment(cycle, k, at);
    if (!step_to(m)) return false;
    const RayEnd end = trace_ray(surface, rays_.site(site_), last_->polar, rays_.curvature_map(), RayParts::WithSector);
    const Xyz along = push_forward(surface.jet(m), border.direction({cycle, k + at}));
    const double f = last_->N.dot(along) / last_->y * end.sector;
    sum += 0.5 * rule.weights[i] * f;
    term += 0.5 * (2 * kNodes - 1) * rule.weights[i] * highest(rule.nodes[i]) * f;
    scale += 0.5 * rule.weights[i] * std::abs(along.norm() / last_->y * end.sector);
  }
  highest_term_ = std::abs(term) / scale;
  seen_.area += sum * part.length();
  return std::isfinite(sum);
}

// Parts are as long as an angle about the site, which changes no faster than they go on.
void Walker::segment(const FaceBorder& border, int cycle, int k, Interval f) {
  const double length =
      norm(rays_.surface().jet(border.uv_in_segment(cycle, k, f.middle())), border.direction({cycle, k + f.middle()}));
  for (double done = f.lo; done < f.hi;) {
    // Where y is small, angles change faster than the distance tells.
    const double off = last_ ? std::min(last_->polar.s, std::abs(last_->y)) : length;
    const double wanted = angle_ * off / length;
    const double part = std::min(f.hi - done, wanted > kShortestPart ? wanted : kShortestPart);
    const auto last = last_;
    const double run_back = run_back_;
    const ChartPiece seen = seen_;
    const bool taken = take(border, cycle, k, {done, done + part});
    if (!(taken && highest_term_ <= kHighestTerm) && part > kShortestPart) {
      last_ = last, seen_ = seen, run_back_ = run_back;
      angle_ = 0.5 * std::min(angle_, part * length / off);
      continue;
    }
    if (!taken) {
      seen_.found = false;
      return;
    }
    if (highest_term_ < kMuchLess * kHighestTerm) angle_ = std::min(2.0 * angle_, kLongestPart);
    done += part;
  }
}

/// Whether the place on the border is the site's own, as near as the border is known: there is no ray to it.
bool is_site(const SiteRays& rays, const FaceBorder& border, int site, Uv m) {
  return (border.xyz_of(m) - border.xyz_of(rays.site(site))).norm() <= border.domain().deflection();
}

double gap_between(const SiteRay& ray, const Polar& known) {
  const double aside = wrap_angle(ray.polar.t - known.t) * ray.y;
  return std::hypot(ray.polar.s - known.s, aside) / known.s;
}

/// The rays by which the vertices at the ends know the site: generator 0 owns the border that leaves, the last one the
/// border that arrives.
std::optional<Polar> known_at(const VoronoiDiagram& d, int vertex, bool leaving) {
  if (vertex < 0) return std::nullopt;
  const DiagramVertex& v = d.vertices[vertex];
  return Polar{v.radius, leaving ? v.angles.front() : v.angles.back()};
}

}  // namespace

BorderWalk walk_border(const SiteRays& rays, const FaceBorder& border, const VoronoiDiagram& diagram, int site,
                       const CellPiece& piece) {
  const auto parameter = [&](int vertex) { return vertex < 0 ? 0.0 : diagram.vertices[vertex].border_parameter; };
  const int cycle = piece.border_cycle, segments = border.segment_count(cycle);
  const double from = parameter(piece.from_vertex);
  double to = parameter(piece.to_vertex);
  if (!(to > from)) to += segments;
  Walker walker(rays, site);
  ChartPiece& seen = walker.seen();
  seen.found = to > from;
  const auto leaving = known_at(diagram, piece.from_vertex, true);
  const Uv start = border.uv({cycle, from}), end = border.uv({cycle, to < segments ? to : to - segments});
  if (const auto ray = rays.to(site, start, leaving)) {
    walker.start_with(*ray);
    seen.first = ray->polar;
  } else if (!is_site(rays, border, site, start)) {
    seen.found = false;
  }
  for (double k = std::floor(from); k < to && seen.found; k += 1.0) {
    const Interval part = {std::max(from - k, 0.0), std::min(to - k, 1.0)};
    walker.segment(border, cycle, static_cast<int>(k) % segments, part);
  }
  BorderWalk out;
  auto arriving = known_at(diagram, piece.to_vertex, false);
  if (seen.found && walker.step_to(end)) {
    if (!arriving && leaving == std::nullopt) arriving = seen.first;
    seen.last = walker.last()->polar;
    if (arriving && arriving->s > 0.0) out.arrival_gap = gap_between(*walker.last(), *arriving);
  } else if (walker.last()) {
    seen.last = walker.last()->polar;
    seen.found = seen.found && is_site(rays, border, site, end);
  }
  if (walker.last()) seen.last_y = walker.last()->y;
  if (!std::isfinite(seen.area)) seen.found = false;
  out.seen = seen;
  return out;
}

}  // namespace geovor
