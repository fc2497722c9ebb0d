#include "voronoi/cell_start.h"

#include <cmath>

#include "surface/tangent_frame.h"

namespace geovor {
namespace {

constexpr int kMostSteps = 200;

// A ray that meets no rival is followed on by this part of its length.
constexpr double kGrowth = 0.5;

// A rival's ray has the same length where the two agree to this part; the diagram's promise is 1e-12.
constexpr double kAgree = 1e-13;
constexpr double kTie = 1e-10;

// The directions in which a site that is alone looks for the end of its cell; none is a symmetry of anything.
constexpr double kDirections[] = {1.0, 2.4, 3.9, 5.5};

// First length of those rays, as a part of the domain's extent in space.
constexpr double kFirstLength = 0.1;

// Ends of different rays that are one point agree to this part of the length.
constexpr double kOnePoint = 1e-7;

double extent(const FaceDomain& domain) {
  const UvBox& box = domain.box();
  const Surface& s = domain.surface();
  const Xyz middle = s.position({box.u.middle(), box.v.middle()});
  return (s.position({box.u.lo, box.v.lo}) - middle).norm() + (s.position({box.u.hi, box.v.middle()}) - middle).norm();
}

/// A geodesic next to the chord, if there is one: across a seam others may lead far round.
std::optional<SiteRay> to_neighbour(const SiteRays& rays, int site, int other) {
  const Surface& surface = rays.surface();
  const Uv from = rays.site(site), to = rays.site(other);
  const Xyz chord = surface.position(to) - surface.position(from);
  const auto ray = rays.to(site, to, Polar{chord.norm(), tangent_frame(surface, from).angle_of(chord)});
  return ray ? ray : rays.to(site, to);
}

class RaySearch {
 public:
  RaySearch(const FaceDomain& domain, const SiteRays& rays, const NearbySites& sites, int site)
      : domain_(domain), rays_(rays), sites_(sites), site_(site) {}

  /// Grows the ray until a rival is nearer, then goes back to where the nearest rival is as near.
  CellStart along(double t, double s) {
    double clear = 0.0;
    for (int i = 0; i < kMostSteps; ++i) {
      const auto ray = rays_.at(site_, {s, t});
      if (!ray) return at_conjugate_point(t, clear, s);
      const auto nearer = sites_.nearer_than(s * (1.0 - kTie), ray->uv, {*ray});
      if (!nearer.empty()) {
        const auto back = back_to(nearer.front(), *ray);
        s = back && *back > clear ? *back : 0.5 * (clear + s);
        continue;
      }
      const auto tied = sites_.nearer_than(s * (1.0 + kTie), ray->uv, {*ray});
      if (!tied.empty()) return meet(*ray, tied.front());
      if (!domain_.contains(domain_.to_principal(ray->uv))) return {CellStart::OffFace, {}};
      clear = s;
      s *= 1.0 + kGrowth;
    }
    return {};
  }

 private:
  /// f(s) = d(rival, O(s,t)) - s falls at the rate 1 - <T_rival, T>; Newton's method from a place where it is negative.
  std::optional<double> back_to(SiteRay rival, SiteRay ray) const {
    for (int i = 0; i < kMostSteps; ++i) {
      const double f = rival.polar.s - ray.polar.s;
      if (std::abs(f) <= kAgree * ray.polar.s) return ray.polar.s;
      const double s = ray.polar.s + f / (1.0 - rival.T.dot(ray.T));
      if (!(s > 0.0)) return std::nullopt;
      const auto next = rays_.at(site_, {s, ray.polar.t});
      if (!next) return s;
      const auto there = rays_.to(rival.site, next->uv, carry(rival, next->x));
      if (!there) return std::nullopt;
      ray = *next, rival = *there;
    }
    return std::nullopt;
  }

  CellStart meet(const SiteRay& ray, const SiteRay& rival) const {
    const Uv place = domain_.to_principal(ray.uv);
    if (!domain_.contains(place)) return {CellStart::OffFace, {}};
    return {CellStart::OnBisector, {ray, rival}};
  }

  /// The ray can't be told at this length: y = 0, or the surface ends.
  CellStart at_conjugate_point(double t, double clear, double s) const {
    const auto before = rays_.at(site_, {s * (1.0 - kOnePoint), t});
    if (!before) return {clear > 0.0 ? CellStart::OffFace : CellStart::NotFound, {}};
    if (!domain_.contains(domain_.to_principal(before->uv))) return {CellStart::OffFace, {}};
    return {CellStart::AtPoint, {*before, *before}};
  }

  const FaceDomain& domain_;
  const SiteRays& rays_;
  const NearbySites& sites_;
  int site_;
};

// Where the two rays of a cut locus nearly agree (radians) its end is beside, and no step leads away from it.
constexpr double kTwoRays = 0.1;

bool beside_free_end(const CellStart& start) {
  const SiteRay &one = start.point.left, &other = start.point.right;
  return start.kind == CellStart::OnBisector && one.site == other.site &&
         std::abs(wrap_angle(one.polar.t - other.polar.t)) < kTwoRays;
}

}  // namespace

CellStart start_of_cell(const FaceDomain& domain, const SiteRays& rays, const NearbySites& sites, int site) {
  RaySearch search(domain, rays, sites, site);
  const int other = sites.nearest_other(site);
  if (other >= 0) {
    if (const auto ray = to_neighbour(rays, site, other)) {
      const CellStart start = search.along(ray->polar.t, 0.5 * ray->polar.s);
      const bool found = start.kind == CellStart::OnBisector || start.kind == CellStart::OffFace;
      if (found && !beside_free_end(start)) return start;
    }
  }
  // Alone, or nothing to be had that way: any ray. One may run into the end of the cut locus, several only into a cut
  // locus that is a point.
  CellStart start;
  for (double t : kDirections) {
    start = search.along(t, kFirstLength * extent(domain));
    const bool found = start.kind == CellStart::OnBisector || start.kind == CellStart::OffFace;
    if (found && !beside_free_end(start)) return start;
  }
  return start;
}

}  // namespace geovor
