#include "voronoi/cell_areas.h"

#include <Eigen/Geometry>
#include <algorithm>
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
    const UvVec d = direction_at_angle(rays_.surface().jet(uv), p.t);
    const auto states = sample_geodesic(rays_.surface(), uv, d, p.s, kRayPieces, options);
    if (states.size() != kRayPieces + 1) return std::numeric_limits<double>::quiet_NaN();
    double sum = 0.0;
    for (int i = 0; i < kRayPieces; i += 4) {
      sum += 7 * states[i].y + 32 * states[i + 1].y + 12 * states[i + 2].y + 32 * states[i + 3].y + 7 * states[i + 4].y;
    }
    return sum * (p.s / kRayPieces) * 2.0 / 45.0;
  }

  // The integrand A dt/dsigma is known exactly at the stored points and is smooth in the arc length sigma even where
  // the edge runs close by its site and t changes fast (on a plane it is constant): the trapezoidal rule with end
  // corrections.
  double along_edge(int site, const CellPiece& piece) const {
    const DiagramEdge& e = diagram_.edges[piece.edge];
    std::vector<double> f, way = {0.0};
    for (size_t i = 0; i < e.points.size(); ++i) {
      const EdgePoint& p = e.points[i];
      const double t = piece.reversed ? p.right_angle : p.left_angle;
      f.push_back((piece.reversed ? -p.right_slope : p.left_slope) * sector(site, {p.radius, t}));
      if (i > 0) way.push_back(way.back() + arc_length(e, i - 1));
    }
    double sum = 0.0;
    for (size_t i = 0; i + 1 < f.size(); ++i) {
      const double h = way[i + 1] - way[i];
      sum += h * (0.5 * (f[i] + f[i + 1]) + h / 12.0 * (slope(way, f, i) - slope(way, f, i + 1)));
    }
    return sum;
  }

  /// Of the edge between points i and i + 1: the chord, and what a circle through three points adds to it.
  static double arc_length(const DiagramEdge& e, size_t i) {
    const double chord = (e.points[i + 1].xyz - e.points[i].xyz).norm();
    if (e.points.size() < 3) return chord;
    const size_t k = std::min(i, e.points.size() - 3);
    const Xyz a = e.points[k + 1].xyz - e.points[k].xyz, b = e.points[k + 2].xyz - e.points[k + 1].xyz;
    const double curvature = 2.0 * a.cross(b).norm() / (a.norm() * b.norm() * (a + b).norm());
    const double bend = curvature * chord;
    return chord * (1.0 + (std::isfinite(bend) ? bend * bend / 24.0 : 0.0));
  }

  /// Derivative of f at place i, of the parabola through three neighbouring places.
  static double slope(const std::vector<double>& x, const std::vector<double>& f, size_t i) {
    if (x.size() < 3) return 0.0;
    const size_t k = std::clamp<size_t>(i, 1, x.size() - 2);
    const double h0 = x[k] - x[k - 1], h1 = x[k + 1] - x[k];
    if (!(h0 > 0.0 && h1 > 0.0)) return 0.0;
    const double d0 = (f[k] - f[k - 1]) / h0, d1 = (f[k + 1] - f[k]) / h1, second = (d1 - d0) / (h0 + h1);
    return d0 + second * (2.0 * (x[i] - x[k - 1]) - h0);
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
      const double length = norm(rays_.surface().jet(lerp(a, a + way, 0.5)), way);
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
