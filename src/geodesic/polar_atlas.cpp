#include "geodesic/polar_atlas.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "geodesic/extended_state.h"
#include "surface/tangent_frame.h"

namespace geovor {
namespace {

constexpr double kTwoPi = 2.0 * M_PI;

// Of the rays; hits need to be good to some percent of a curvature radius only.
constexpr double kRayTolerance = 1e-4;

// Samples lie this many curvature radii apart, which is a step of the integrator at that tolerance; flat pieces are cut
// into parts of the length all the same.
constexpr double kSampleStep = 0.8;
constexpr int kFewestSamples = 8;
constexpr int kMostSamples = 1000;

// Neighbouring rays are no farther apart than this part of a sample's step.
constexpr double kSpread = 0.7;

constexpr int kFirstRays = 16;
constexpr int kMostHalvings = 9;

// Where rays run wild, halving goes on for ever: with so many samples in all the atlas is given up, and says so.
constexpr int kMostSamplesInAll = 400000;

// What interpolation may put a point beside its ray, in parts of the way between samples.
constexpr double kSlack = 0.02;

// The ends' own neighbourhoods, in parts of the interval, count to both intervals: a foot may fall between the two
// where the ray bends.
constexpr double kOverlap = 0.1;

// The integrator stops a little before a side on which the metric vanishes; this part of the last step before the stop
// the jets still tell where the ray goes.
constexpr double kBeforeStop = 1e-2;

// So it is the side that stopped the ray: by the third power of the parameter a millionth of the length is a hundredth
// of the domain's extents.
constexpr double kBesideSide = 0.05;

// From there a ray goes on by Taylor's formula, by this part of a sample's step: a target on the side, above all in a
// corner, may have its foot on a neighbour's ray only beyond the side.
constexpr double kBeyondSide = 0.7;

// Of the two parameters' directions.
constexpr double kNoPlane = 1e-10;

// A target that is more sample steps above the ray's surface than the first lies on another sheet of it, perhaps; more
// than the second, certainly.
constexpr double kPlain = 0.5;
constexpr double kOtherSheet = 1.0;

// The cubic through the ends of an interval of length h, with their slopes, at the part k of it.
template <class T>
T cubic(const T& x0, const T& slope0, const T& x1, const T& slope1, double h, double k) {
  const double a = (1.0 - k) * (1.0 - k), b = k * k;
  return T(a * (1.0 + 2.0 * k) * x0 + b * (3.0 - 2.0 * k) * x1 + h * k * (1.0 - k) * ((1.0 - k) * slope0 - k * slope1));
}

double turn_from(double a, double b) { return std::abs(std::remainder(b - a, kTwoPi)); }

// Polynomials that are continued by more than the width of their piece are no guide to anything.
Interval widened(Interval domain, double beyond, const Interval& first, const Interval& last) {
  const double most = beyond > 0.0 ? beyond * domain.length() : 0.0;
  return {domain.lo - std::min(most, first.length()), domain.hi + std::min(most, last.length())};
}

UvBox rim_of(const Surface& surface, double beyond) {
  const UvBox d = surface.domain();
  // Of an infinite range no end is asked for.
  const auto end = [](double x) { return std::isfinite(x) ? x : 0.0; };
  const Uv lo{end(d.u.lo), end(d.v.lo)}, hi{end(d.u.hi), end(d.v.hi)};
  const UvBox first = surface.span(lo, {1.0, 1.0}).box, last = surface.span(hi, {-1.0, -1.0}).box;
  return {widened(d.u, beyond, first.u, last.u), widened(d.v, beyond, first.v, last.v)};
}

bool in_box(const Surface& surface, const UvBox& box, Uv p) {
  return (surface.u_period() || box.u.contains(p.u)) && (surface.v_period() || box.v.contains(p.v));
}

// Whether the metric vanishes on a side of the domain that is as near as that.
bool beside_vanishing_side(const Surface& surface, Uv p) {
  const UvBox d = surface.domain();
  const auto vanishes = [&](Uv side) {
    const SurfaceJet j = surface.jet(side);
    return !(j.Su.cross(j.Sv).norm() > kNoPlane * std::max(j.Su.squaredNorm(), j.Sv.squaredNorm()));
  };
  const auto beside = [](double x, double end, double extent) { return std::abs(x - end) <= kBesideSide * extent; };
  for (const double u : {d.u.lo, d.u.hi})
    if (beside(p.u, u, d.u.length()) && vanishes({u, p.v})) return true;
  for (const double v : {d.v.lo, d.v.hi})
    if (beside(p.v, v, d.v.length()) && vanishes({p.u, v})) return true;
  return false;
}

}  // namespace

bool is_meant(const AtlasHit& hit, const Polar& geodesic) {
  return hit.plain && std::abs(geodesic.s - hit.at.s) <= hit.error && turn_from(geodesic.t, hit.at.t) <= 0.5 * hit.turn;
}

double PolarAtlas::Ray::y_at(double s) const {
  const auto after =
      std::lower_bound(samples.begin(), samples.end(), s, [](const Sample& x, double at) { return x.s < at; });
  if (after == samples.begin()) return 0.0;
  if (after == samples.end()) return samples.back().y;
  const Sample &a = *(after - 1), &b = *after;
  return cubic(a.y, a.dy, b.y, b.dy, b.s - a.s, (s - a.s) / (b.s - a.s));
}

/// Follows rays and halves the angles between them.
class PolarAtlas::Builder {
 public:
  Builder(const Surface& surface, Uv from, PolarAtlas& atlas)
      : surface_(surface),
        from_(from),
        frame_(tangent_frame(surface, from)),
        rim_(rim_of(surface, atlas.options_.beyond)),
        atlas_(atlas) {}

  void run() {
    constexpr int kStep = kCircle / kFirstRays;
    for (int i = 0; i < kCircle; i += kStep) refine(i, i + kStep, kMostHalvings);
    for (auto& [index, ray] : rays_) atlas_.rays_.push_back(std::move(ray));
  }

 private:
  Ray& ray(int index);
  Ray follow(double t);
  bool done(const GeodesicIntegrator& path, const Sample& x) const;
  std::optional<Sample> sample(const GeodesicIntegrator& path, const Ray& ray) const;
  GeodesicIntegrator path_at(double t) const;
  bool end_where_stopped(Ray& ray, const GeodesicIntegrator& stopped) const;
  double apart_at(const Ray& ray, const Ray& next) const;
  void refine(int index, int next, int halvings);

  // Rays by index: kFirstRays * 2^kMostHalvings of them would fill the circle.
  static constexpr int kCircle = kFirstRays << kMostHalvings;

  const Surface& surface_;
  Uv from_;
  TangentFrame frame_;
  UvBox rim_;
  PolarAtlas& atlas_;
  std::map<int, Ray> rays_;
  int samples_ = 0;
};

// Where the parameters do not tell the curvature, at a pole, the step is that of the sample before.
std::optional<PolarAtlas::Sample> PolarAtlas::Builder::sample(const GeodesicIntegrator& path, const Ray& ray) const {
  const SpaceState at = path.at();
  const double k = curvatures(path.jet()).largest(), length = atlas_.options_.length;
  const double shortest = length / kMostSamples, longest = length / kFewestSamples;
  const double before = ray.samples.empty() ? longest : ray.samples.back().step;
  const double step = std::isfinite(k) ? std::clamp(kSampleStep / k, shortest, longest) : before;
  const bool inside = in_box(surface_, surface_.domain(), path.state().p);
  const Sample x{path.covered(), at.S, at.tangent, at.normal, at.y, at.dy, step, inside};
  if (!(x.X.allFinite() && x.T.allFinite() && x.n.allFinite())) return std::nullopt;
  return x;
}

bool PolarAtlas::Builder::done(const GeodesicIntegrator& path, const Sample& x) const {
  const double end = kReach * atlas_.options_.length;
  const auto& target = atlas_.options_.target;
  const bool conjugate = x.s > 0.0 && !(x.y > 0.0);
  const bool too_far = target && x.s + (*target - x.X).norm() > end + x.step;
  return conjugate || too_far || x.s >= end || !in_box(surface_, rim_, path.state().p);
}

GeodesicIntegrator PolarAtlas::Builder::path_at(double t) const {
  TraceOptions options;
  options.tolerance = kRayTolerance;
  options.stop_at_domain = false;
  options.max_steps = 2 * kMostSamples;
  return {surface_, from_, frame_.at_angle(t), kReach * atlas_.options_.length, options};
}

// A ray can't be followed onto a side on which the metric vanishes, or, far beyond the domain, to where its polynomials
// run off. What lies between its last sample and the stop, the domain's own rim with it, is no less reached. Whether
// the ray has ended there for good.
bool PolarAtlas::Builder::end_where_stopped(Ray& ray, const GeodesicIntegrator& stopped) const {
  const double last = ray.samples.back().s, stop = stopped.covered();
  const double before = stop - kBeforeStop * (stop - last);
  GeodesicIntegrator path = path_at(ray.t);
  if (!(stop > last) || path.advance(before) != TraceStatus::Converged) return false;
  const auto x = sample(path, ray);
  if (!x) return false;
  const Uv p = stopped.state().p;
  const auto add = [&](double s, bool inside) {
    const SpaceState end = extended(path.at(), path.jet(), s - before);
    if (!(end.S.allFinite() && end.tangent.allFinite() && end.normal.allFinite())) return false;
    ray.samples.push_back({s, end.S, end.tangent, end.normal, end.y, end.dy, x->step, inside});
    return true;
  };
  const bool inside = in_box(surface_, surface_.domain(), p);
  if (!add(stop, inside)) return false;
  return !inside || (beside_vanishing_side(surface_, p) && add(stop + kBeyondSide * x->step, false));
}

// A ray that is lost beyond the domain has left it for good, like one that has met the rim.
PolarAtlas::Ray PolarAtlas::Builder::follow(double t) {
  Ray ray;
  ray.t = t;
  const double end = kReach * atlas_.options_.length;
  GeodesicIntegrator path = path_at(t);
  for (int i = 0; i < kMostSamples; ++i) {
    const auto x = sample(path, ray);
    if (!x) break;
    ray.samples.push_back(*x);
    if (done(path, *x)) {
      ray.lost = false;
      break;
    }
    if (path.advance(std::min(x->s + x->step, end)) != TraceStatus::Converged) {
      ray.lost = !end_where_stopped(ray, path);
      break;
    }
  }
  ray.lost = ray.lost && (ray.samples.empty() || ray.samples.back().inside);
  samples_ += static_cast<int>(ray.samples.size());
  atlas_.evaluations_ += path.evaluations() + static_cast<int>(ray.samples.size());
  return ray;
}

PolarAtlas::Ray& PolarAtlas::Builder::ray(int index) {
  const int i = index % kCircle;
  auto known = rays_.find(i);
  if (known == rays_.end()) known = rays_.emplace(i, follow(kTwoPi * i / kCircle)).first;
  return known->second;
}

// The length from which on the two are too far from each other; infinite if they never are.
double PolarAtlas::Builder::apart_at(const Ray& a, const Ray& b) const {
  const double turn = turn_from(a.t, b.t);
  double first = std::numeric_limits<double>::infinity();
  for (const Ray* r : {&a, &b})
    for (const Sample& x : r->samples)
      if (x.inside && turn * std::abs(x.y) > kSpread * x.step) {
        first = std::min(first, x.s);
        break;
      }
  return first;
}

void PolarAtlas::Builder::refine(int index, int next, int halvings) {
  Ray &a = ray(index), &b = ray(next);
  const double apart = apart_at(a, b);
  const bool close = std::isinf(apart);
  if (!close && halvings > 0 && samples_ < kMostSamplesInAll) {
    const int middle = (index + next) / 2;
    ray(middle).from = apart;
    for (Ray* r : {&a, &b}) r->from = std::min(r->from, apart);
    refine(index, middle, halvings - 1);
    refine(middle, next, halvings - 1);
    return;
  }
  atlas_.complete_to_ = std::min(atlas_.complete_to_, apart);
  for (const Ray* r : {&a, &b})
    if (r->lost) atlas_.complete_to_ = std::min(atlas_.complete_to_, r->samples.empty() ? 0.0 : r->samples.back().s);
}

PolarAtlas::PolarAtlas(const Surface& surface, Uv from, const AtlasOptions& options) : options_(options) {
  Builder(surface, from, *this).run();
  index_parts();
}

// Parts begin one sample before a ray is needed, so that there is no gap where its neighbours begin to rely on it.
void PolarAtlas::index_parts() {
  std::vector<BoxTree::Box> boxes;
  for (int r = 0; r < static_cast<int>(rays_.size()); ++r) {
    const Ray& ray = rays_[r];
    for (int i = 1; i < static_cast<int>(ray.samples.size()); ++i) {
      const Sample& end = ray.samples[i];
      if (end.s + end.step < ray.from) continue;
      parts_.push_back(part(r, i));
      if (!options_.target) boxes.push_back(box(parts_.back()));
    }
  }
  tree_ = BoxTree(std::move(boxes));
}

// The next ray, one way round, that is needed at s.
int PolarAtlas::neighbour(int ray, double s, int way) const {
  const int n = static_cast<int>(rays_.size());
  int i = (ray + way + n) % n;
  while (i != ray && rays_[i].from > s) i = (i + way + n) % n;
  return i;
}

PolarAtlas::Part PolarAtlas::part(int ray, int sample) const {
  const double s = rays_[ray].samples[sample - 1].s;
  const int before = neighbour(ray, s, -1), after = neighbour(ray, s, 1);
  const double turn = std::max(turn_from(rays_[before].t, rays_[ray].t), turn_from(rays_[ray].t, rays_[after].t));
  return {ray, sample, before, after, turn};
}

// Near a conjugate point, where y is no measure, what it changes up to the neighbours counts.
double PolarAtlas::change(const Part& part, double s, double y) const {
  return std::max(std::abs(rays_[part.before].y_at(s) - y), std::abs(rays_[part.after].y_at(s) - y));
}

// Every target that look() would take: beside the part as far as the next rays, above and below as far as the sheet.
BoxTree::Box PolarAtlas::box(const Part& part) const {
  // Between samples y, the frame and the ray differ from what they are at both by less than these.
  constexpr double kAllowance = 1.25, kBulge = 0.25;
  const Ray& ray = rays_[part.ray];
  const Sample &p = ray.samples[part.sample - 1], &q = ray.samples[part.sample];
  const double h = q.s - p.s;
  const auto aside = [&](const Sample& x) { return std::abs(x.y) + change(part, x.s, x.y); };
  const double side = part.turn * std::max(aside(p), aside(q)) + kSlack * h, sheet = kOtherSheet * p.step;
  const auto margin = [&](const Sample& x) -> Xyz {
    return kAllowance * (side * x.n.cross(x.T).cwiseAbs() + sheet * x.n.cwiseAbs() + kOverlap * h * x.T.cwiseAbs());
  };
  const double turned = (q.T - p.T).norm() + (q.n - p.n).norm();
  const Xyz m = margin(p).cwiseMax(margin(q)).array() + kBulge * turned * (h + side + sheet);
  return {p.X.cwiseMin(q.X) - m, p.X.cwiseMax(q.X) + m};
}

// Where the ray passes by the target: a foot of the perpendicular between two samples. The geodesic that ends there has
// left a part b / y of a radian beside the ray, which has to be less than the way to the next ray.
std::optional<AtlasHit> PolarAtlas::look(const Part& part, const Xyz& x) const {
  const Ray& ray = rays_[part.ray];
  const Sample &p = ray.samples[part.sample - 1], &q = ray.samples[part.sample];
  const double h = q.s - p.s, a0 = (x - p.X).dot(p.T), a1 = (x - q.X).dot(q.T);
  if (!(a0 >= -kOverlap * h && a1 <= kOverlap * h)) return std::nullopt;
  double k = std::clamp(a0 / (a0 - a1), 0.0, 1.0);
  constexpr int kSecants = 3;
  double lo = 0.0, hi = 1.0;
  for (int n = 0; n < kSecants; ++n) {
    const Xyz T = (1.0 - k) * p.T + k * q.T;
    const double a = (x - cubic(p.X, p.T, q.X, q.T, h, k)).dot(T);
    (a > 0.0 ? lo : hi) = k;
    k = std::clamp(k + a / h, lo, hi);
  }
  const Xyz T = ((1.0 - k) * p.T + k * q.T).normalized(), n = ((1.0 - k) * p.n + k * q.n).normalized();
  const Xyz off = x - cubic(p.X, p.T, q.X, q.T, h, k);
  const double b = off.dot(n.cross(T).normalized()), above = std::abs(off.dot(n));
  const double s = p.s + k * h, y = cubic(p.y, p.dy, q.y, q.dy, h, k), y_change = change(part, s, y);
  const double slack = kSlack * std::min(h, s);
  if (!(std::abs(b) <= part.turn * (std::abs(y) + y_change) + slack)) return std::nullopt;
  if (!(above <= kOtherSheet * p.step)) return std::nullopt;
  const double turn = part.turn + slack / std::max(std::abs(y), slack), aside = std::clamp(b / y, -turn, turn);
  const bool plain = y_change < kPlain * std::abs(y) && above < kPlain * p.step;
  // About the foot geodesic circles have the curvature y'/y.
  const double bend = plain ? 0.5 * b * b * ((1.0 - k) * p.dy + k * q.dy) / y : 0.0;
  const Polar at{std::max(s + bend, 0.5 * s), ray.t + (std::isfinite(aside) ? aside : 0.0)};
  return AtlasHit{at, std::abs(b), kHitError * at.s + 0.5 * std::abs(bend), turn, plain};
}

// For a single target a tree does not pay.
std::vector<AtlasHit> PolarAtlas::hits(const Xyz& x, double limit) const {
  std::vector<AtlasHit> all;
  const auto add = [&](const Part& part) {
    const auto hit = look(part, x);
    if (hit && hit->at.s - hit->error <= limit) all.push_back(*hit);
  };
  if (options_.target) {
    for (const Part& part : parts_) add(part);
  } else {
    for (const int i : tree_.holding(x)) add(parts_[i]);
  }
  std::sort(all.begin(), all.end(), [](const AtlasHit& a, const AtlasHit& b) {
    return std::tie(a.off, a.at.s, a.at.t) < std::tie(b.off, b.at.s, b.at.t);
  });
  return all;
}

}  // namespace geovor
