#include "voronoi/border_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/gauss_legendre.h"
#include "surface/forms.h"

namespace geovor {
namespace {

// A segment of the border is taken in parts that are seen from the site under no more than about this angle, but none
// shorter than a part of the segment: the border may run through the site. Five nodes leave 1e-9 of such a part.
constexpr double kBorderPart = 0.5;
constexpr double kShortestPart = 1e-3;
constexpr int kNodes = 5;

class Walker {
 public:
  Walker(const SiteRays& rays, int site) : rays_(rays), site_(site) {}

  /// The ray to the place next to the last one; without one, the shortest.
  bool step_to(Uv m);
  void start_with(const SiteRay& ray) { last_ = ray; }
  void segment(Uv a, Uv b);
  const std::optional<SiteRay>& last() const { return last_; }
  ChartPiece& seen() { return seen_; }

 private:
  const SiteRays& rays_;
  int site_;
  std::optional<SiteRay> last_;
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
void Walker::segment(Uv a, Uv b) {
  const GaussRule& rule = gauss_legendre(kNodes);
  const UvVec way = b - a;
  const double length = norm(rays_.surface().jet(lerp(a, b, 0.5)), way);
  for (double done = 0.0; done < 1.0 && seen_.found;) {
    const double off = last_ ? last_->polar.s : length;
    const double part = std::min(1.0 - done, std::max(kBorderPart * off / length, kShortestPart));
    for (int k = 0; k < kNodes; ++k) {
      const Uv m = lerp(a, b, done + 0.5 * (1.0 + rule.nodes[k]) * part);
      seen_.found = step_to(m);
      if (!seen_.found) return;
      const RayEnd end = trace_ray(rays_.surface(), rays_.site(site_), last_->polar, RayParts::WithSector);
      const Xyz along = push_forward(rays_.surface().jet(m), way);
      seen_.area += 0.5 * rule.weights[k] * part * last_->N.dot(along) / last_->y * end.sector;
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

BorderWalk walk_border(const SiteRays& rays, const VoronoiDiagram& diagram, int site, const CellPiece& piece) {
  Walker walker(rays, site);
  ChartPiece& seen = walker.seen();
  const auto& line = piece.border_uv;
  auto leaving = known_at(diagram, piece.from_vertex, true);
  if (const auto ray = line.empty() ? std::nullopt : rays.to(site, line.front(), leaving)) walker.start_with(*ray);
  seen.found = line.size() > 1;
  if (walker.last()) seen.first = walker.last()->polar;
  for (std::size_t i = 0; i + 1 < line.size() && seen.found; ++i) {
    const UvVec way = line[i + 1] - line[i], rest = nearest_copy(rays.surface(), line[i], line[i + 1]);
    const bool over_seam = !(std::hypot(rest.u, rest.v) > 0.5 * std::hypot(way.u, way.v));
    if (!over_seam) walker.segment(line[i], line[i + 1]);
  }
  BorderWalk out;
  auto arriving = known_at(diagram, piece.to_vertex, false);
  if (seen.found && walker.step_to(line.back())) {
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
