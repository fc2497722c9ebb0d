#include "voronoi/nearby_sites.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "geodesic/closed_forms.h"

namespace geovor {
namespace {

// Cells of the survey in each direction.
constexpr int kSurveyCells = 96;

// What is asked of the survey: more than is needed now, for the next query.
constexpr double kAhead = 2.0;

// A rough ray's length is good to kRoughly: beyond some of these it is not shorter than the limit.
constexpr double kClearly = 1.0 + 3.0 * kRoughly;

std::vector<Xyz> positions(const SiteRays& rays) {
  std::vector<Xyz> all;
  for (int i = 0; i < rays.count(); ++i) all.push_back(rays.surface().position(rays.site(i)));
  return all;
}

bool holds(const std::vector<SiteRay>& rays, const SiteRay& ray) {
  return std::any_of(rays.begin(), rays.end(), [&](const SiteRay& r) { return same_generator(r, ray); });
}

void sort_by_length(std::vector<SiteRay>& rays) {
  std::sort(rays.begin(), rays.end(), [](const SiteRay& a, const SiteRay& b) {
    return std::tie(a.polar.s, a.site, a.polar.t) < std::tie(b.polar.s, b.site, b.polar.t);
  });
}

}  // namespace

NearbySites::NearbySites(const SiteRays& rays)
    : rays_(rays),
      closed_form_(has_closed_form(rays.surface())),
      tree_(positions(rays)),
      known_(static_cast<std::size_t>(rays.count())) {
  if (closed_form_) return;
  survey_.emplace(rays.surface(), kSurveyCells);
  finder_.emplace(rays.surface());
  for (int i = 0; i < rays.count(); ++i) frames_.push_back(tangent_frame(rays.surface(), rays.site(i)));
}

// Any two geodesics of the length make less than what the survey says of a second one.
bool NearbySites::unique_to(int site, double limit) const {
  Knowledge& k = known_[site];
  if (limit <= k.certain) return true;
  if (!(limit < k.open)) return false;
  const auto holds_to = [&](double r) {
    const auto region = survey_->ball(rays_.site(site), r);
    const bool unique = region && second_geodesic_at_least(*region, r) >= r;
    (unique ? k.certain : k.open) = r;
    return unique;
  };
  return (kAhead * limit < k.open && holds_to(kAhead * limit)) || holds_to(limit);
}

std::vector<SiteRay> NearbySites::nearer_than(double limit, Uv m, const std::vector<SiteRay>& known) const {
  const Query q{m, rays_.surface().position(m), limit};
  std::vector<int> near;
  tree_.collect(q.x, limit, near);
  std::vector<SiteRay> found;
  for (const int site : near) add(q, site, known, found);
  sort_by_length(found);
  return found;
}

void NearbySites::add(const Query& q, int site, const std::vector<SiteRay>& known, std::vector<SiteRay>& found) const {
  if (closed_form_) return add_closed_form(q, site, known, found);
  if (unique_to(site, q.limit)) {
    if (std::any_of(known.begin(), known.end(), [site](const SiteRay& r) { return r.site == site; })) return;
    if (add_unique(q, site, found)) return;
  }
  add_searched(q, site, known, found);
}

// The only geodesic, if it is shorter than the limit; false where that is not settled.
bool NearbySites::add_unique(const Query& q, int site, std::vector<SiteRay>& found) const {
  const Xyz chord = q.x - tree_.point(site);
  const Polar guess{chord.norm(), frames_[site].angle_of(chord)};
  auto ray = rays_.roughly_to(site, q.m, guess);
  if (!ray) ray = rays_.to(site, q.m);
  if (!ray) return false;
  // A longer geodesic says something of shorter ones only if it is unique itself.
  if (ray->polar.s > kClearly * q.limit) return unique_to(site, ray->polar.s);
  ray = rays_.to(site, q.m, ray->polar);
  if (!ray) return false;
  if (ray->polar.s < q.limit) found.push_back(*ray);
  return true;
}

void NearbySites::add_closed_form(const Query& q, int site, const std::vector<SiteRay>& known,
                                  std::vector<SiteRay>& found) const {
  const auto all = connections_closed_form(rays_.surface(), rays_.site(site), q.m);
  for (const Connection& c : *all) {
    if (!(c.length < q.limit && c.y > 0.0)) continue;
    const auto ray = rays_.to(site, q.m, Polar{c.length, c.angle});
    if (ray && !holds(known, *ray) && !holds(found, *ray)) found.push_back(*ray);
  }
}

void NearbySites::add_searched(const Query& q, int site, const std::vector<SiteRay>& known,
                               std::vector<SiteRay>& found) const {
  const DistanceResult r = finder_->distance(rays_.site(site), q.m);
  for (const Connection& c : r.candidates) {
    if (!(c.length < q.limit && c.y > 0.0)) continue;
    const auto ray = rays_.to(site, q.m, Polar{c.length, c.angle});
    if (ray && !holds(known, *ray) && !holds(found, *ray)) found.push_back(*ray);
  }
}

// The first site that can be reached gives a bound; each nearer one betters it.
std::vector<SiteRay> NearbySites::nearest(Uv m) const {
  const Xyz x = rays_.surface().position(m);
  double bound = std::numeric_limits<double>::infinity();
  for (const int site : in_ball(x, bound)) {
    if (const auto ray = rays_.to(site, m)) bound = ray->polar.s;
    if (bound < std::numeric_limits<double>::infinity()) break;
  }
  if (!(bound < std::numeric_limits<double>::infinity())) return {};
  std::vector<SiteRay> found;
  for (const int site : in_ball(x, (1.0 + 2.0 * kTie) * bound)) {
    add({m, x, (1.0 + 2.0 * kTie) * bound}, site, {}, found);
    for (const SiteRay& r : found) bound = std::min(bound, r.polar.s);
  }
  sort_by_length(found);
  std::erase_if(found, [&](const SiteRay& r) { return r.polar.s > (1.0 + kTie) * bound; });
  return found;
}

bool NearbySites::complete_to(int site, double limit) const { return limit < known_[site].doubtful; }

}  // namespace geovor
