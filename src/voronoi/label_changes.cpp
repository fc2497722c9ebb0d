#include "voronoi/label_changes.h"

#include <cmath>

#include "voronoi/rival_watch.h"

namespace geovor {
namespace {

// Bisections and false-position steps of one root together.
constexpr int kMostSteps = 100;

// Each split adds a label that was not known; more than this many in one step of a lattice are noise.
constexpr int kDeepest = 24;

// See kSameGuess in site_ray.h: the same rule, at one step's distance.
constexpr double kSameLabel = 0.5;

/// The generator's ray to another place of the path.
std::optional<SiteRay> follow(const CandidateLabels& labels, const SiteRay& ray, Uv m) {
  return labels.rays().to(ray.site, m, carry(ray, labels.rays().surface().position(m)));
}

/// Root of d_before - d_after on [lo, hi] by the Illinois variant of false position, which needs no derivative and so
/// does not mind the corners of a polyline.
std::optional<LabelChange> find_change(const CandidateLabels& labels, const UvPath& path, double lo, double hi,
                                       SiteRay before, SiteRay after) {
  const auto difference = [&](double k) -> std::optional<double> {
    const auto a = follow(labels, before, path(k)), b = follow(labels, after, path(k));
    if (!a || !b) return std::nullopt;
    before = *a, after = *b;
    return a->polar.s - b->polar.s;
  };
  const auto f_hi = difference(hi), f_lo = difference(lo);
  if (!f_lo || !f_hi) return std::nullopt;
  constexpr double kOfNoise = 0.05;  // differences cancel most of the noise of one distance
  const auto root = [&](double f) { return std::abs(f) <= kOfNoise * kDistanceNoise * before.polar.s; };
  double a = lo, b = hi, fa = *f_lo, fb = *f_hi, k = lo;
  int last_side = 0;
  if (!root(fa) && root(fb)) {
    k = hi;
    if (!difference(k)) return std::nullopt;
  } else if (!root(fa)) {
    if (!(fa < 0.0 && fb > 0.0)) return std::nullopt;
    for (int i = 0; i < kMostSteps; ++i) {
      k = (a * fb - b * fa) / (fb - fa);
      if (!(k > a && k < b)) k = 0.5 * (a + b);
      const auto f = difference(k);
      if (!f) return std::nullopt;
      if (root(*f) || k == a || k == b) break;
      const int side = *f < 0.0 ? -1 : 1;
      (side < 0 ? a : b) = k;
      (side < 0 ? fa : fb) = *f;
      if (side == last_side) (side < 0 ? fb : fa) *= 0.5;
      last_side = side;
    }
  }
  return LabelChange{k, before, after};
}

void collect(const CandidateLabels& labels, const UvPath& path, const LabelledPlace& from, const LabelledPlace& to,
             int depth, std::vector<LabelChange>& out) {
  if (from.candidates.empty() || to.candidates.empty() || depth > kDeepest) return;
  const SiteRay &a = from.candidates.front(), &b = to.candidates.front();
  const auto a_there = follow(labels, a, b.uv), b_here = follow(labels, b, a.uv);
  if (a_there && same_generator(*a_there, b)) return;
  if (!a_there || !b_here) return;
  const auto change = find_change(labels, path, from.at, to.at, *a_there, b);
  if (!change) return;
  LabelledPlace middle{change->at, labels.around(path(change->at))};
  if (middle.candidates.empty()) return;
  const double gap = change->before.polar.s - middle.candidates.front().polar.s;
  if (gap <= kDistanceNoise * change->before.polar.s) {
    out.push_back(*change);
    return;
  }
  collect(labels, path, from, middle, depth + 1, out);
  collect(labels, path, middle, to, depth + 1, out);
}

}  // namespace

std::vector<LabelChange> label_changes(const CandidateLabels& labels, const UvPath& path, const LabelledPlace& from,
                                       const LabelledPlace& to) {
  std::vector<LabelChange> out;
  collect(labels, path, from, to, 0, out);
  return out;
}

bool same_label(const SiteRay& a, const SiteRay& b, double step) {
  if (a.site != b.site) return false;
  const Polar guess = carry(a, b.x);
  return std::abs(b.polar.s - guess.s) + std::abs(b.y * wrap_angle(b.polar.t - guess.t)) < kSameLabel * step;
}

}  // namespace geovor
