#include "voronoi/border_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/gauss_legendre.h"
#include "surface/forms.h"

namespace geovor {
namespace {

// A segment of the border is taken in parts that are seen from the site under no more than about this angle, where the
// cell is flat for its size and where it is not, but none shorter than a part of the segment: the border may run
// through the site. Five nodes leave 1e-9 of such a part.
constexpr double kBorderPart = 0.1;
constexpr double kLongestPart = 0.5;
constexpr double kShortestPart = 1e-3;
constexpr int kNodes = 5;

class Walker {
 public:
  Walker(const SiteRays& rays, int site) : rays_(rays), site_(site) {}

  /// The ray to the place next to the last one; without one, the shortest.
  bool step_to(Uv m);
  void start_with(const SiteRay& ray) { last_ = ray; }
  void segment(const FaceBorder& border, int cycle, int k, Interval part_of_it);
  const std::optional<SiteRay>& last() const { return last_; }
  ChartPiece& seen() { return seen_; }

 private:
  const SiteRays& rays_;
  int site_;
  std::optional<SiteRay> last_;
  double bend_ = 1.0;  ///< what the last sector lacks of s^2 / 2, as a part of it
  ChartPiece seen_;
};

bool Walker::step_to(Uv m) {
  std::optional<SiteRay> ray;
  if (last_) ray = rays_.to(site_, m, carry(*last_, rays_.surface().position(m)));
  if (!ray) ray = rays_.to(site_, m);
  if (!ray) return false;
  if (last_) {
    const double turn = wrap_angle(ray->polar.t - last_->polar.t);
    seen_.turn += turn;
    seen_.back = std::max(seen_.back, -turn * std::abs(ray->y) / ray->polar.s);
  }
  seen_.least_y = std::min(seen_.least_y, ray->y / ray->polar.s);
  seen_.shortest = seen_.shortest > 0.0 ? std::min(seen_.shortest, ray->polar.s) : ray->polar.s;
  last_ = ray;
  return true;
}

// A segment's slope in t is its way along N divided by y. Parts are as long as a fraction of the distance to the site,
// which changes no faster than they go on.
void Walker::segment(const FaceBorder& border, int cycle, int k, Interval f) {
  const GaussRule& rule = gauss_legendre(kNodes);
  const Surface& surface = rays_.surface();
  const double length =
      norm(surface.jet(border.uv_in_segment(cycle, k, f.middle())), border.direction({cycle, k + f.middle()}));
  for (double done = f.lo; done < f.hi && seen_.found;) {
    // Where y is small, angles change faster than the distance tells.
    const double off = last_ ? std::min(last_->polar.s, std::abs(last_->y)) : length;
    const double angle = std::min(kLongestPart, kBorderPart / std::sqrt(std::sqrt(bend_)));
    const double part = std::min(f.hi - done, std::max(angle * off / length, kShortestPart));
    for (int i = 0; i < kNodes; ++i) {
      const double at = done + 0.5 * (1.0 + rule.nodes[i]) * part;
      const Uv m = border.uv_in_segment(cycle, k, at);
      seen_.found = step_to(m);
      if (!seen_.found) return;
      const RayEnd end = trace_ray(surface, rays_.site(site_), last_->polar, rays_.curvature(), RayParts::WithSector);
      bend_ = std::abs(2.0 * end.sector / (end.polar.s * end.polar.s) - 1.0);
      const Xyz along = push_forward(surface.jet(m), border.direction({cycle, k + at}));
      seen_.area += 0.5 * rule.weights[i] * part * last_->N.dot(along) / last_->y * end.sector;
    }
    done += part;
  }
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
  if (const auto ray = rays.to(site, border.uv({cycle, from}), leaving)) walker.start_with(*ray);
  if (walker.last()) seen.first = walker.last()->polar;
  for (double k = std::floor(from); k < to && seen.found; k += 1.0) {
    const Interval part = {std::max(from - k, 0.0), std::min(to - k, 1.0)};
    walker.segment(border, cycle, static_cast<int>(k) % segments, part);
  }
  BorderWalk out;
  auto arriving = known_at(diagram, piece.to_vertex, false);
  if (seen.found && walker.step_to(border.uv({cycle, to < segments ? to : to - segments}))) {
    if (!arriving && leaving == std::nullopt) arriving = seen.first;
    seen.last = walker.last()->polar;
    if (arriving && arriving->s > 0.0) out.arrival_gap = gap_between(*walker.last(), *arriving);
  } else if (walker.last()) {
    seen.last = walker.last()->polar;  // the stretch ends in the site itself
  }
  if (walker.last()) seen.last_y = walker.last()->y;
  if (!std::isfinite(seen.area)) seen.found = false;
  out.seen = seen;
  return out;
}

}  // namespace geovor
