#include "voronoi/nearby_sites.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "geodesic/closed_forms.h"

namespace geovor {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// Cells of the survey in each direction.
constexpr int kSurveyCells = 96;

// What is asked of the survey: more than is needed now, for the next query.
constexpr double kAhead = 2.0;

constexpr double kAtlasAhead = 1.25;

// Lengths of balls that are looked at for the nearest site, in chords: neighbours' geodesics are hardly longer.
constexpr double kHardlyLonger = 1.02, kGrowth = 1.4, kFarLonger = 4.0;

// A rough ray longer than the limit by this is longer. Its length is good to kRoughly as a rule, but from a shot that
// is one step of low order it may err by some 1e-4 where the curvature has its peak half way.
constexpr double kClearly = 1.01;

std::vector<Xyz> positions(const SiteRays& rays) {
  std::vector<Xyz> all;
  for (int i = 0; i < rays.count(); ++i) all.push_back(rays.surface().position(rays.site(i)));
  return all;
}

// What of an infinite domain is surveyed: the sites, and as much again on either side.
Interval surveyed(Interval domain, double first, double last, double reach) {
  return {std::isfinite(domain.lo) ? domain.lo : first - reach, std::isfinite(domain.hi) ? domain.hi : last + reach};
}

UvBox survey_box(const SiteRays& rays) {
  const UvBox d = rays.surface().domain();
  if (rays.count() == 0) return d;
  UvBox sites{{rays.site(0).u, rays.site(0).u}, {rays.site(0).v, rays.site(0).v}};
  for (int i = 1; i < rays.count(); ++i) {
    const Uv p = rays.site(i);
    sites = {{std::min(sites.u.lo, p.u), std::max(sites.u.hi, p.u)},
             {std::min(sites.v.lo, p.v), std::max(sites.v.hi, p.v)}};
  }
  return {surveyed(d.u, sites.u.lo, sites.u.hi, sites.u.length()),
          surveyed(d.v, sites.v.lo, sites.v.hi, sites.v.length())};
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
  for (int i = 0; i < rays.count(); ++i) extent_ = std::max(extent_, (tree_.point(i) - tree_.point(0)).norm());
  if (closed_form_) return;
  survey_.emplace(rays.surface(), survey_box(rays), kSurveyCells);
  atlases_.resize(known_.size());
  for (int i = 0; i < rays.count(); ++i) frames_.push_back(tangent_frame(rays.surface(), rays.site(i)));
}

// Any two geodesics of the length make less than what the survey says of a second one. On a cylinder two together wind
// round it, on a sphere they make a great circle: one is half of that. A cone's tip is curved beyond any bound.
bool NearbySites::unique_to(int site, double limit) const {
  if (closed_form_) return rays_.surface().kind() != SurfaceKind::Cone && limit * rays_.curvature() < std::numbers::pi;
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
  return nearer_than({m, rays_.surface().position(m), limit}, known);
}

std::vector<SiteRay> NearbySites::roughly_nearer_than(double limit, Uv m, const std::vector<SiteRay>& known) const {
  return nearer_than({m, rays_.surface().position(m), limit, true}, known);
}

std::vector<SiteRay> NearbySites::nearer_than(const Query& q, const std::vector<SiteRay>& known) const {
  std::vector<int> near;
  tree_.collect(q.x, q.limit, near);
  std::vector<SiteRay> found;
  for (const int site : near) add(q, site, known, found);
  sort_by_length(found);
  return found;
}

void NearbySites::add(const Query& q, int site, const std::vector<SiteRay>& known, std::vector<SiteRay>& found) const {
  if (q.x == tree_.point(site)) return found.push_back(no_way(q, site));
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
  if (!q.roughly) ray = rays_.to(site, q.m, ray->polar);
  if (!ray) return false;
  if (ray->polar.s < q.limit) found.push_back(*ray);
  return true;
}

SiteRay NearbySites::no_way(const Query& q, int site) const {
  const TangentFrame frame = tangent_frame(rays_.surface(), rays_.site(site));
  return {site, {0.0, 0.0}, q.m, q.x, frame.e1, frame.e2, 0.0};
}

void NearbySites::add_closed_form(const Query& q, int site, const std::vector<SiteRay>& known,
                                  std::vector<SiteRay>& found) const {
  const auto all = geodesics_closed_form(rays_.surface(), rays_.site(site), q.m, q.limit);
  for (const Connection& c : all) {
    if (!(c.length < q.limit && c.y > 0.0)) continue;
    const auto ray = rays_.to(site, q.m, Polar{c.length, c.angle});
    if (ray && !holds(known, *ray) && !holds(found, *ray)) found.push_back(*ray);
  }
}

// Made for more than is needed now, for the next query.
const PolarAtlas& NearbySites::atlas(int site, double limit) const {
  auto& atlas = atlases_[site];
  if (!atlas || atlas->length() < limit)
    atlas = std::make_unique<PolarAtlas>(rays_.surface(), rays_.site(site),
                                         AtlasOptions{kAtlasAhead * limit, kBeyond, std::nullopt});
  return *atlas;
}

// The ray that a hit stands for, roughly where it is too long to count.
std::optional<SiteRay> NearbySites::settle(const Query& q, int site, const AtlasHit& hit) const {
  auto ray = rays_.roughly_to(site, q.m, hit.at);
  if (ray && (q.roughly || ray->polar.s > kClearly * q.limit)) return ray;
  ray = rays_.to(site, q.m, ray ? ray->polar : hit.at);
  if (ray) return ray;
  ConnectOptions once;
  once.persist = false;
  const Connection c = connect(rays_.surface(), rays_.site(site), q.m, hit.at, once);
  if (c.status != ConnectStatus::Converged) return std::nullopt;
  ray = rays_.at(site, Polar{c.length, c.angle});
  if (!ray) return std::nullopt;
  ray->uv = q.m;
  ray->x = q.x;
  return ray;
}

// Hits beside a geodesic that is at hand already are not shot at.
void NearbySites::add_searched(const Query& q, int site, const std::vector<SiteRay>& known,
                               std::vector<SiteRay>& found) const {
  known_[site].searched = std::max(known_[site].searched, q.limit);
  std::vector<SiteRay> settled;
  std::copy_if(known.begin(), known.end(), std::back_inserter(settled),
               [site](const SiteRay& r) { return r.site == site; });
  const auto is_settled = [&](const AtlasHit& hit) {
    return std::any_of(settled.begin(), settled.end(), [&](const SiteRay& r) { return is_meant(hit, r.polar); });
  };
  std::vector<AtlasHit> open;
  for (const AtlasHit& hit : atlas(site, q.limit).hits(q.x, q.limit)) {
    if (is_settled(hit)) continue;
    const auto ray = settle(q, site, hit);
    if (!ray && hit.plain) open.push_back(hit);
    if (!ray || holds(settled, *ray)) continue;
    settled.push_back(*ray);
    if (ray->polar.s < q.limit && ray->y > 0.0) found.push_back(*ray);
  }
  for (const AtlasHit& hit : open)
    if (!is_settled(hit)) known_[site].doubtful = std::min(known_[site].doubtful, hit.at.s - hit.error);
}

// A way from the nearest site in space that can be reached; infinite if there is none.
double NearbySites::some_way(Uv m, const Xyz& x) const {
  const auto way = [&](int site) {
    if (tree_.point(site) == x) return 0.0;
    const auto ray = rays_.to(site, m);
    return ray ? ray->polar.s : kInf;
  };
  const int next = tree_.nearest(x);
  double shortest = next < 0 ? kInf : way(next);
  if (next < 0 || shortest < kInf) return shortest;
  for (const int site : in_ball(x, kInf)) {
    if (shortest < kInf) break;
    shortest = way(site);
  }
  return shortest;
}

// The nearest and its ties if it is nearer than the limit, else nothing. Every nearer one that is found leaves less to
// be searched.
std::vector<SiteRay> NearbySites::tied_within(double limit, Uv m) const {
  Query q{m, rays_.surface().position(m), limit};
  std::vector<SiteRay> found;
  double tied = kInf;
  for (const int site : in_ball(q.x, limit)) {
    if ((q.x - tree_.point(site)).norm() > tied) break;
    add(q, site, {}, found);
    for (const SiteRay& r : found) tied = std::min(tied, (1.0 + kTie) * r.polar.s);
    // A length may differ from one computation to the next by less than a tie.
    q.limit = std::min(limit, (1.0 + kTie) * tied);
  }
  if (tied > limit) return {};
  sort_by_length(found);
  std::erase_if(found, [tied](const SiteRay& r) { return r.polar.s > tied; });
  return found;
}

// The ball grows from the nearest site in space on. Where that leads nowhere, as on a sheet rolled up many times, the
// length of any geodesic tells how far to look.
std::vector<SiteRay> NearbySites::nearest(Uv m) const {
  const Xyz x = rays_.surface().position(m);
  const int next = tree_.nearest(x);
  if (next < 0) return {};
  const double chord = (x - tree_.point(next)).norm();
  for (double limit = kHardlyLonger * chord; limit <= kFarLonger * std::max(chord, extent_); limit *= kGrowth) {
    auto found = tied_within(limit, m);
    if (!found.empty()) return found;
    if (chord == 0.0) break;
  }
  const double way = some_way(m, x);
  return way < kInf ? tied_within((1.0 + 2.0 * kTie) * way, m) : std::vector<SiteRay>{};
}

bool NearbySites::complete_as_asked(int site, double limit) const {
  const double asked = std::min(limit, known_[site].searched);
  return !(asked > 0.0) || unique_to(site, asked) || atlases_[site]->complete_to() >= asked;
}

bool NearbySites::complete_to(int site, double limit) const {
  if (closed_form_) return true;
  if (!(limit <= known_[site].doubtful)) return false;
  return unique_to(site, limit) || atlas(site, limit).complete_to() >= limit;
}

}  // namespace geovor
