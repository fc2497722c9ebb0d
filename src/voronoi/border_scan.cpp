#include "voronoi/border_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "surface/forms.h"
#include "voronoi/edge_on_border.h"

namespace geovor {
namespace {

// Steps along the border as parts of the distance to the owner, or of the owner's distance to its nearest neighbour:
// within half of that there is no other's cell. None is shorter than a part of the border, which the site may lie on.
constexpr double kStep = 0.5;
constexpr double kStepNearSite = 0.2;
constexpr double kLeastStep = 1e-4;
constexpr double kOwnDisk = 0.5;

// Where the owner may have several geodesics, one must be told from the next: steps in which a ray's angle or the
// surface's normal turns by no more than this (radians).
constexpr double kStepAmongBranches = 0.5;

// In least steps: how exactly the ends of a stretch of border that no ray reaches are found. There each search costs
// most, a hundred times one that finds its geodesic.
constexpr double kEndOfUnseen = 40.0;

constexpr double kInf = std::numeric_limits<double>::infinity();

// As a part of the least step.
constexpr double kBesideSite = 0.1;

// Between two places an angle changes by what its slopes at both say, but for this part of it; more means another
// geodesic of the same site. A change too small to tell is none.
constexpr double kJump = 0.25;
constexpr double kNoChange = 1e-6;

// Where the middle of a step is seen under so many times the angle that its ends are, or where y has so many times the
// size at one end that it has at the other, rays may have run together in it.
constexpr double kDip = 2.0;

// How often a step is halved where an owner can't be followed over it, or its geodesic is another one afterwards: to a
// millionth. The two rays of a cut locus that meets the border a little beyond its free end both go on along the border
// for the width of their swallowtail only, which falls like the power 3/2 of that way.
constexpr int kMostHalvings = 20;

// How often a step is halved where a third generator may own a piece between two labels.
constexpr int kDeepestSplit = 6;

// Changes between two labels: each adds one that was not known; more than this many are noise.
constexpr int kMostChanges = 24;

// Bisections and false-position steps of one root together.
constexpr int kMostRootSteps = 100;

// A root is one where the two distances agree to this part; differences cancel most of the noise of one distance.
constexpr double kRoot = 1e-13;

// Up to here rough rays will do; from there a few secants lead to the root, where the border has no corner.
constexpr double kRoughRoot = 10.0 * kRoughly;
constexpr int kMostSecants = 5;

// Distances below this part of the radius are one.
constexpr double kTie = 1e-10;

/// The owner of a place and its ties, then, roughly, the generators that can own something near it.
struct Label {
  double at = 0.0;
  std::vector<SiteRay> candidates;
  const SiteRay& owner() const { return candidates.front(); }
  bool found() const { return !candidates.empty(); }
};

/// Smallest value, at sampled interior points, of the cubic with values g0, g1 and slopes s0, s1 at the ends of a step
/// h.
double cubic_minimum(double g0, double s0, double g1, double s1, double h) {
  constexpr int kSamples = 8;
  double least = std::min(g0, g1);
  for (int i = 1; i < kSamples; ++i) {
    const double t = static_cast<double>(i) / kSamples, r = 1.0 - t;
    const double value = r * r * (1 + 2 * t) * g0 + t * t * (3 - 2 * t) * g1 + h * t * r * (r * s0 - t * s1);
    least = std::min(least, value);
  }
  return least;
}

class CycleScan {
 public:
  CycleScan(const FaceBorder& border, int cycle, const SiteRays& rays, const NearbySites& sites)
      : border_(border), cycle_(cycle), end_(border.segment_count(cycle)), rays_(rays), sites_(sites) {
    for (int k = 0; k < border.segment_count(cycle); ++k) least_step_ += kLeastStep * border.segment_length(cycle, k);
  }

  BorderScan run() {
    Label last = label(beside_sites(0.0), 0.0);
    const double end = last.at + end_;
    if (!last.found()) begin_unseen(last);
    double step = next_step(last, 0.0), turns_by = kInf;
    while (last.at < end) {
      double at = std::min(beside_sites(next_place(last.at, step)), end);
      if (at >= turns_by) at = std::min(beside_sites(0.5 * (last.at + turns_by)), turns_by);
      Label here = label(at, step);
      const bool turns = here.found() != last.found();
      if (turns && at < turns_by && (border_.xyz(place(at)) - border_.xyz(place(last.at))).norm() > end_of_unseen()) {
        turns_by = at;
        continue;
      }
      if (last.found() && here.found()) between(last, here, step, 0);
      if (turns) turns_by = kInf, here.found() ? end_unseen(here) : begin_unseen(last);
      step = next_step(here, turns ? 0.0 : step);
      last = std::move(here);
    }
    if (!last.found()) scan_.unseen.back().to = place(last.at);
    return std::move(scan_);
  }

 private:
  /// A place of the border; it goes round as often as one likes.
  BorderPlace place(double at) const { return {cycle_, at - end_ * std::floor(at / end_)}; }
  Uv uv(double at) const { return border_.uv(place(at)); }

  /// Ends of unseen stretches are found to this length.
  double end_of_unseen() const { return kEndOfUnseen * least_step_; }
  void begin_unseen(const Label& before) {
    scan_.unseen.push_back({place(before.at), {}, before.found() ? before.owner().site : -1, -1});
  }
  void end_unseen(const Label& after) {
    scan_.unseen.back().to = place(after.at);
    scan_.unseen.back().after = after.owner().site;
  }

  /// The place, or one a little further on where a site lies in it: from there its own ray can't be told.
  double beside_sites(double at) const {
    while (!sites_.in_ball(border_.xyz(place(at)), kBesideSite * least_step_).empty()) {
      at = next_place(at, least_step_);
    }
    return at;
  }

  Label label(double at, double reach) const {
    Label l{at, sites_.nearest(uv(at))};
    if (l.candidates.empty() || !(reach > 0.0)) return l;
    const auto more = sites_.roughly_nearer_than(l.owner().polar.s + 2.0 * reach, uv(at), l.candidates);
    l.candidates.insert(l.candidates.end(), more.begin(), more.end());
    return l;
  }

  /// From a place that no ray reaches, where each search costs most, twice the last step.
  double next_step(const Label& l, double step) const {
    return l.found() ? step_from(l) : std::max(2.0 * step, end_of_unseen());
  }

  /// Length in space.
  double step_from(const Label& l) const {
    const SiteRay& owner = l.owner();
    const double step = std::max(kStep * owner.polar.s, kStepNearSite * apart(owner.site));
    if (sites_.unique_to(owner.site, owner.polar.s + 2.0 * step)) return std::max(step, least_step_);
    return std::max(std::min({kStep * owner.polar.s, kStepAmongBranches * std::abs(owner.y),
                              kStepAmongBranches * rays_.curvature_map().radius(owner.uv)}),
                    least_step_);
  }

  /// From a site to its nearest neighbour, in a straight line.
  double apart(int site) const {
    const int other = sites_.nearest_other(site);
    return other < 0 ? 0.0 : (sites_.position(other) - sites_.position(site)).norm();
  }

  /// Whether the ray ends so near to its site that no other site can be nearer.
  bool in_own_disk(const SiteRay& ray) const {
    return ray.polar.s < std::max(kOwnDisk * apart(ray.site), 2.0 * least_step_);
  }

  /// As far along the border, never beyond a corner where steps are longer than segments are: those that bend are
  /// short.
  double next_place(double at, double step) const {
    const int n = static_cast<int>(end_);
    double left = step;
    for (int i = 0; i < n; ++i) {
      const double k = std::floor(at);
      const double length = border_.segment_length(cycle_, static_cast<int>(k) % n);
      const double rest = (k + 1.0 - at) * length;
      if (rest > left) return at + left / length;
      left -= rest;
      at = k + 1.0;
    }
    return at;
  }

  void between(const Label& from, const Label& to, double step, int depth) {
    if (depth < kDeepestSplit && may_hide(from, to)) {
      const Label middle = label(0.5 * (from.at + to.at), 0.5 * step);
      if (!middle.candidates.empty()) {
        between(from, middle, 0.5 * step, depth + 1);
        between(middle, to, 0.5 * step, depth + 1);
        return;
      }
    }
    collect(from.at, from.owner(), to.at, to.owner(), 0);
  }

  /// Whether a generator that is nearest at neither place may be nearest in between.
  static bool may_hide(const Label& from, const Label& to) {
    const SiteRay &a = from.owner(), &b = to.owner();
    const Xyz way = b.x - a.x;
    const double h = way.norm();
    for (const SiteRay& c : from.candidates) {
      for (const SiteRay& d : to.candidates) {
        if (c.site != d.site || same_generator(c, a) || same_generator(d, b)) continue;
        if ((c.site == a.site || d.site == b.site) && turns_over(c, d)) continue;
        const double falls = (c.T - a.T).dot(way) / h, rises = (d.T - b.T).dot(way) / h;
        if (cubic_minimum(c.polar.s - a.polar.s, falls, d.polar.s - b.polar.s, rises, h) < 0.0) return true;
      }
    }
    return false;
  }

  /// Whether the site of both has one geodesic only to each place between their ends.
  bool unique(const SiteRay& a, const SiteRay& b) const {
    return sites_.unique_to(a.site, std::max(a.polar.s, b.polar.s) + (b.x - a.x).norm());
  }

  /// Whether two rays of one site may be different geodesics.
  static bool turns_over(const SiteRay& a, const SiteRay& b) {
    if (a.site != b.site) return false;
    const Xyz way = b.x - a.x;
    const double from = a.N.dot(way) / a.y, to = b.N.dot(way) / b.y;
    const double off = wrap_angle(b.polar.t - a.polar.t - 0.5 * (from + to));
    return std::abs(off) > kJump * (std::abs(from) + std::abs(to)) + kNoChange;
  }

  /// Whether rays of one site may have run together between two places: where the angle, as a cubic of the place with
  /// the slopes at both, is steepest in the middle, or y changes too much to tell. From a cut locus that
  /// ends next to the border y grows so fast that Newton's method goes over it both ways.
  static bool dips(const SiteRay& a, const SiteRay& b) {
    const Xyz way = b.x - a.x;
    const double from = a.N.dot(way) / a.y, to = b.N.dot(way) / b.y;
    const double middle = 1.5 * wrap_angle(b.polar.t - a.polar.t) - 0.25 * (from + to);
    const double steeper = std::max(std::abs(from), std::abs(to)), y = std::min(std::abs(a.y), std::abs(b.y));
    return std::abs(middle) > kDip * steeper + kNoChange || std::max(std::abs(a.y), std::abs(b.y)) > kDip * y;
  }

  /// The generator's ray to another place.
  std::optional<SiteRay> follow(const SiteRay& ray, double at) const {
    return rays_.to(ray.site, uv(at), carry(ray, rays_.surface().position(uv(at))));
  }

  std::optional<SiteRay> follow_roughly(const SiteRay& ray, double at) const {
    return rays_.roughly_to(ray.site, uv(at), carry(ray, rays_.surface().position(uv(at))));
  }

  /// The changes between two owners. A step on which one of them can't be followed is too long.
  void collect(double lo, const SiteRay& a, double hi, const SiteRay& b, int depth) {
    if (depth > kMostChanges) return;
    if (a.site == b.site && unique(a, b) && ((in_own_disk(a) && in_own_disk(b)) || !turns_over(a, b))) return;
    const auto a_there = follow(a, hi), b_here = follow(b, lo);
    const bool followed = a_there && b_here && (depth >= kMostHalvings || !turns_over(a, b));
    const bool there = followed && same_generator(*a_there, b), back = followed && same_generator(*b_here, a);
    if (there && back && (depth >= kMostHalvings || !dips(a, b))) return;
    // One way only: near a conjugate point Newton's method has gone over to the other.
    const auto change = followed && !there && !back ? root(lo, a, *b_here, hi, *a_there, b) : std::nullopt;
    if (!change) {
      const double middle = 0.5 * (lo + hi);
      const auto owner = depth < kMostHalvings ? sites_.nearest(uv(middle)) : std::vector<SiteRay>{};
      if (owner.empty()) return;
      collect(lo, a, middle, owner.front(), depth + 1);
      collect(middle, owner.front(), hi, b, depth + 1);
      return;
    }
    const double radius = change->before.polar.s, at = change->at;
    const auto nearer = sites_.nearer_than(radius * (1.0 - kTie), uv(at), {change->before, change->after});
    if (!nearer.empty()) {
      collect(lo, a, at, nearer.front(), depth + 1);
      collect(at, nearer.front(), hi, b, depth + 1);
      return;
    }
    // The two may have changed to other geodesics of theirs on the way to here.
    if (turns_over(a, change->before)) collect(lo, a, at, change->before, depth + 1);
    const BisectorPoint exact = settled_on_border(rays_, border_, place(at), {change->after, change->before});
    scan_.changes.push_back({place(at), exact.right, exact.left});
    if (turns_over(change->after, b)) collect(at, change->after, hi, b, depth + 1);
  }

  struct Root {
    double at;
    SiteRay before, after;
  };
  static bool is_root(const Root& r) {
    return std::abs(r.before.polar.s - r.after.polar.s) <= kRoot * r.before.polar.s;
  }

  /// Root of d_a - d_b on [lo, hi].
  std::optional<Root> root(double lo, const SiteRay& a_lo, const SiteRay& b_lo, double hi, const SiteRay& a_hi,
                           const SiteRay& b_hi) const {
    const Root from{lo, a_lo, b_lo}, to{hi, a_hi, b_hi};
    if (is_root(from)) return from;
    if (is_root(to)) return to;
    const auto roughly = bracketed_root(from, to, kRoughRoot);
    if (roughly) {
      if (const auto exact = secant_root(*roughly, lo, hi)) return exact;
    }
    return bracketed_root(from, to, kRoot);
  }

  /// From a place very near to a root.
  std::optional<Root> secant_root(const Root& start, double lo, double hi) const {
    Root r = start;
    double last_at = 0.0, last_f = 0.0;
    for (int i = 0; i < kMostSecants; ++i) {
      const auto a = follow(r.before, r.at), b = follow(r.after, r.at);
      if (!a || !b) return std::nullopt;
      r.before = *a, r.after = *b;
      if (is_root(r)) return r;
      const double f = a->polar.s - b->polar.s;
      const double slope =
          i == 0 ? (a->T - b->T).dot(push_forward(rays_.surface().jet(a->uv), border_.direction(place(r.at))))
                 : (f - last_f) / (r.at - last_at);
      last_at = r.at, last_f = f;
      r.at -= f / slope;
      if (!(r.at > lo && r.at < hi)) return std::nullopt;
    }
    return std::nullopt;
  }

  /// By the Illinois variant of false position, which needs no derivative and so does not mind the corners of the
  /// border.
  std::optional<Root> bracketed_root(const Root& from, const Root& to, double tolerance) const {
    double lo = from.at, hi = to.at;
    double f_lo = from.before.polar.s - from.after.polar.s, f_hi = to.before.polar.s - to.after.polar.s;
    if (!(f_lo < 0.0 && f_hi > 0.0)) return std::nullopt;
    SiteRay a = from.before, b = from.after;
    double k = lo;
    int last_side = 0;
    for (int i = 0; i < kMostRootSteps; ++i) {
      k = (lo * f_hi - hi * f_lo) / (f_hi - f_lo);
      if (!(k > lo && k < hi)) k = 0.5 * (lo + hi);
      const bool rough = tolerance > kRoughly;
      const auto next_a = rough ? follow_roughly(a, k) : follow(a, k),
                 next_b = rough ? follow_roughly(b, k) : follow(b, k);
      if (!next_a || !next_b) return std::nullopt;
      a = *next_a, b = *next_b;
      const double f = a.polar.s - b.polar.s;
      if (std::abs(f) <= tolerance * a.polar.s || k == lo || k == hi) break;
      const int side = f < 0.0 ? -1 : 1;
      (side < 0 ? lo : hi) = k;
      (side < 0 ? f_lo : f_hi) = f;
      if (side == last_side) (side < 0 ? f_hi : f_lo) *= 0.5;
      last_side = side;
    }
    return Root{k, a, b};
  }

  const FaceBorder& border_;
  int cycle_;
  double end_;
  const SiteRays& rays_;
  const NearbySites& sites_;
  double least_step_ = 0.0;
  BorderScan scan_;
};

}  // namespace

BorderScan scan_border(const FaceBorder& border, int cycle, const SiteRays& rays, const NearbySites& sites) {
  return CycleScan(border, cycle, rays, sites).run();
}

}  // namespace geovor
