#include "voronoi/near_ties.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "surface/forms.h"
#include "voronoi/bisector.h"

namespace geovor {
namespace {

// A place is where the tangent plane says if it is no farther from there than this part of the radius; beside a pole
// of the parameters it is not.
constexpr double kInPlane = 1e-14;

class Envelope {
 public:
  Envelope(const SiteRays& rays, const std::vector<SiteRay>& generators) : rays_(rays), g_(generators) {}

  /// The part of the triangulation beyond the edge of generators i and j, on the side of those in between.
  void triangulate(int i, int j, int parent) {
    if (j - i < 2) return;
    const std::vector<int> corners = next_polygon(i, j);
    const Xyz way = meeting_point(corners);
    int self = -1;
    if (way.norm() <= kTiedDisk * g_[0].polar.s) {
      if (auto there = rays_at(corners, way); !there.empty()) {
        self = static_cast<int>(found_.size());
        found_.push_back({std::move(there), parent});
      }
    }
    for (std::size_t k = 0; k + 1 < corners.size(); ++k) triangulate(corners[k], corners[k + 1], self);
  }

  std::vector<TiedVertex> take() { return std::move(found_); }

 private:
  double distance(int k, const Xyz& way) const { return g_[k].polar.s + g_[k].T.dot(way); }

  // The bisector of i and j passes the point `base` and goes on along `tangent`, where the others lie ahead: the first
  // one that it meets, and all that tie with it.
  std::vector<int> next_polygon(int i, int j) const {
    const Xyz across = g_[i].T - g_[j].T, tangent = BisectorPoint{g_[j], g_[i]}.tangent();
    const Xyz base = (g_[j].polar.s - g_[i].polar.s) / across.squaredNorm() * across;
    double first = 0.0;
    for (int k = i + 1; k < j; ++k) {
      const double a = (distance(k, base) - distance(i, base)) / (g_[i].T - g_[k].T).dot(tangent);
      if (k == i + 1 || a < first) first = a;
    }
    const Xyz meeting = base + first * tangent;
    const double reach = distance(i, meeting) + kOneVertex * g_[0].polar.s;
    std::vector<int> corners = {i};
    for (int k = i + 1; k < j; ++k) {
      if (distance(k, meeting) <= reach) corners.push_back(k);
    }
    corners.push_back(j);
    return corners;
  }

  // d_k + <T_k, way> = radius for all corners, in the sense of least squares: more than three are balanced.
  Xyz meeting_point(const std::vector<int>& corners) const {
    const SiteRay& g = g_[corners.front()];
    Eigen::MatrixX3d A(corners.size(), 3);
    Eigen::VectorXd b(corners.size());
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Xyz& T = g_[corners[k]].T;
      A.row(static_cast<Eigen::Index>(k)) << T.dot(g.T), T.dot(g.N), -1.0;
      b[static_cast<Eigen::Index>(k)] = g.polar.s - g_[corners[k]].polar.s;
    }
    const Eigen::Vector3d way = A.colPivHouseholderQr().solve(b);
    return way[0] * g.T + way[1] * g.N;
  }

  std::vector<SiteRay> rays_at(const std::vector<int>& corners, const Xyz& way) const {
    const SiteRay& g = g_[corners.front()];
    Uv m = g.uv + tangent_components(rays_.surface().jet(g.uv), way);
    if (!((rays_.surface().position(m) - g.x - way).norm() <= kInPlane * g.polar.s)) {
      const auto ray = rays_.at(g.site, carry(g, g.x + way));
      if (!ray) return {};
      m = ray->uv;
    }
    const SurfaceJet j = rays_.surface().jet(m);
    std::vector<SiteRay> there;
    for (int k : corners) there.push_back(moved(g_[k], m, j));
    return there;
  }

  const SiteRays& rays_;
  const std::vector<SiteRay>& g_;
  std::vector<TiedVertex> found_;
};

}  // namespace

std::vector<TiedVertex> resolve_ties(const SiteRays& rays, const std::vector<SiteRay>& generators) {
  Envelope envelope(rays, generators);
  envelope.triangulate(0, static_cast<int>(generators.size()) - 1, -1);
  return envelope.take();
}

void sort_around(std::vector<SiteRay>& g) {
  const Xyz first = -g.front().T, n = g.front().T.cross(g.front().N);
  const auto angle = [&](const SiteRay& ray) { return turn_between(first, -ray.T, n); };
  std::stable_sort(g.begin() + 1, g.end(), [&](const auto& a, const auto& b) { return angle(a) < angle(b); });
}

}  // namespace geovor
