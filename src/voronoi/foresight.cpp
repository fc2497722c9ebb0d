#include "voronoi/foresight.h"

#include <Eigen/Geometry>
#include <cmath>

namespace geovor {
namespace {

// A site that the bisector would reach after less than this part of the radius is one of the vertex that it leaves.
constexpr double kBehind = 1e-11;

/// log_m of a point of space X: its direction in the tangent plane, its distance along a circle through both that is
/// tangent to the plane. c the chord, h its height: c (1 + (h/c)^2 / 6) to fourth order in c.
Xyz along_plane(const Xyz& chord, const Xyz& n) {
  const double c = chord.norm(), h = n.dot(chord);
  const Xyz flat = chord - h * n;
  return (c + h * h / (6.0 * c)) / flat.norm() * flat;
}

}  // namespace

// The circle about a T through the left site passes the image L of a third where |a T - L| = |a T + r T_left|, so that
// a = (|L|^2 - r^2) / (2 <T, L + r T_left>). A site that the bisector moves away from has a negative denominator. The
// ball that is searched shrinks with every site found: the last one left has an empty circle.
std::optional<ForeseenVertex> foresee(const NearbySites& sites, const SiteRays& rays, const BisectorPoint& m,
                                      double reach) {
  const Xyz T = m.tangent(), n = m.left.T.cross(m.left.N);
  const double r = m.radius();
  const Xyz left = -r * m.left.T;
  std::optional<ForeseenVertex> best;
  double way = reach;
  for (bool shrunk = true; shrunk;) {
    shrunk = false;
    const double radius = (way * T - left).norm();
    for (int site : sites.in_ball(m.position() + way * T, radius)) {
      if (site == m.left.site || site == m.right.site) continue;
      const Xyz L = along_plane(rays.surface().position(rays.site(site)) - m.position(), n);
      const double a = (L.squaredNorm() - r * r) / (2.0 * T.dot(L - left));
      if (!(a > kBehind * r && a < way) || !(T.dot(L - left) > 0.0)) continue;
      way = a;
      best = ForeseenVertex{site, a};
      shrunk = true;
    }
  }
  return best;
}

}  // namespace geovor
