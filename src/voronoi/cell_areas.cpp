#include "voronoi/cell_areas.h"

#include <array>
#include <cmath>
#include <limits>

#include "geodesic/trace.h"
#include "surface/forms.h"
#include "voronoi/site_ray.h"

namespace geovor {
namespace {

// Gauss-Legendre nodes and weights on [0, 1].
constexpr std::array<double, 3> kNodes = {0.1127016653792583, 0.5, 0.8872983346207417};
constexpr std::array<double, 3> kWeights = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

// Pieces of a ray for Boole's rule (a multiple of four), which leaves 1e-9 over one radius of curvature.
constexpr int kRayPieces = 16;

// A segment of the border is taken in parts that are seen from the site under no more than about this angle, but none
// shorter than a part of the segment: the border may run through the site.
constexpr double kBorderPart = 0.25;
constexpr double kShortestPart = 1e-3;

class AreaRule {
 public:
  AreaRule(const SiteRays& rays, const VoronoiDiagram& diagram) : rays_(rays), diagram_(diagram) {}

  double cell(const DiagramCell& cell) const {
    double sum = 0.0;
    for (const auto& loop : cell.loops) {
      for (const CellPiece& piece : loop)
        sum += piece.edge >= 0 ? along_edge(cell.site, piece) : along_border(cell.site, piece);
    }
    return sum;
  }

 private:
  /// The integral of y along the ray.
  double sector(int site, Polar p) const {
    TraceOptions options;
    options.stop_at_domain = false;
    const Uv uv = rays_.site(site);
    const UvVec d = direction_at_angle(first_form(rays_.surface().jet(uv)), p.t);
    const auto states = sample_geodesic(rays_.surface(), uv, d, p.s, kRayPieces, options);
    if (states.size() != kRayPieces + 1) return std::numeric_limits<double>::quiet_NaN();
    double sum = 0.0;
    for (int i = 0; i < kRayPieces; i += 4) {
      sum += 7 * states[i].y + 32 * states[i + 1].y + 12 * states[i + 2].y + 32 * states[i + 3].y + 7 * states[i + 4].y;
    }
    return sum * (p.s / kRayPieces) * 2.0 / 45.0;
  }

  // Between stored points radius and angle are cubics, by their values and slopes.
  double along_edge(int site, const CellPiece& piece) const {
    const DiagramEdge& e = diagram_.edges[piece.edge];
    double sum = 0.0;
    for (size_t i = 0; i + 1 < e.points.size(); ++i) {
      const EdgePoint &a = e.points[i], &b = e.points[i + 1];
      const double t0 = piece.reversed ? a.right_angle : a.left_angle,
                   d0 = piece.reversed ? a.right_slope : a.left_slope;
      const double t1 = t0 + wrap_angle((piece.reversed ? b.right_angle : b.left_angle) - t0);
      const double d1 = piece.reversed ? b.right_slope : b.left_slope;
      const double h = (b.xyz - a.xyz).norm();
      for (int k = 0; k < 3; ++k) {
        const double x = kNodes[k], z = 1.0 - x;
        const auto cubic = [&](double f0, double s0, double f1, double s1) {
          return z * z * (1 + 2 * x) * f0 + x * x * (3 - 2 * x) * f1 + h * x * z * (z * s0 - x * s1);
        };
        const double slope = 6 * x * z * (t1 - t0) + h * (z * (1 - 3 * x) * d0 + x * (3 * x - 2) * d1);
        const Polar p = {cubic(a.radius, a.radius_slope, b.radius, b.radius_slope), cubic(t0, d0, t1, d1)};
        sum += kWeights[k] * slope * sector(site, p);
      }
    }
    return piece.reversed ? -sum : sum;
  }

  // A segment's slope in t is its way along N divided by y.
  double along_border(int site, const CellPiece& piece) const {
    double sum = 0.0;
    std::optional<SiteRay> last = start_of(site, piece);
    for (size_t i = 0; i + 1 < piece.border_uv.size(); ++i) {
      const Uv a = piece.border_uv[i];
      const UvVec way = piece.border_uv[i + 1] - a;
      const UvVec rest = nearest_copy(rays_.surface(), a, piece.border_uv[i + 1]);
      if (!(std::hypot(rest.u, rest.v) > 0.5 * std::hypot(way.u, way.v)))
        continue;  // from one side of a seam to the other
      const double length = norm(first_form(rays_.surface().jet(lerp(a, a + way, 0.5))), way);
      // Parts as long as a fraction of the distance to the site, which changes no faster than they go on.
      for (double done = 0.0; done < 1.0;) {
        const double off = last ? last->polar.s : length;
        const double part = std::min(1.0 - done, std::max(kBorderPart * off / length, kShortestPart));
        for (int k = 0; k < 3; ++k) {
          const Uv m = a + (done + kNodes[k] * part) * way;
          const SurfaceJet j = rays_.surface().jet(m);
          auto ray = last ? rays_.to(site, m, carry(*last, j.S)) : rays_.to(site, m);
          if (!ray) ray = rays_.to(site, m);
          if (!ray) return std::numeric_limits<double>::quiet_NaN();
          sum += kWeights[k] * part * ray->N.dot(push_forward(j, way)) / ray->y * sector(site, ray->polar);
          last = ray;
        }
        done += part;
      }
    }
    return sum;
  }

  std::optional<SiteRay> start_of(int site, const CellPiece& piece) const {
    if (piece.from_vertex < 0) return rays_.to(site, piece.border_uv.front());
    const DiagramVertex& v = diagram_.vertices[piece.from_vertex];
    return rays_.to(site, v.uv, Polar{v.radius, v.angles.front()});  // generator 0 owns the border that leaves
  }

  const SiteRays& rays_;
  const VoronoiDiagram& diagram_;
};

}  // namespace

void measure_cells(const Surface& surface, VoronoiDiagram& diagram) {
  std::vector<Uv> sites;
  for (const DiagramSite& s : diagram.sites) sites.push_back(s.uv);
  const SiteRays rays(surface, sites);
  const AreaRule rule(rays, diagram);
  for (DiagramCell& cell : diagram.cells) cell.area = rule.cell(cell);
}

}  // namespace geovor
