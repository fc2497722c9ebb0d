#include "geodesic/fan.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "geodesic/integrator.h"
#include "geodesic/shooting.h"

namespace geovor {
namespace {

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

// A ray is given up where the way so far and the chord to the target are longer than this many lengths, and in parts of
// the domain, so far beyond its border: what lies at the rim is between rays as well.
constexpr double kBeyondBorder = 0.05;

struct Sample {
  double s;
  Xyz X, T, n;
  double y, dy;
  double step;
};

struct Ray {
  double t;
  bool lost = false;
  std::vector<Sample> samples;
};

// The cubic through the ends of an interval of length h, with their slopes, at the part k of it.
template <class T>
T cubic(const T& x0, const T& slope0, const T& x1, const T& slope1, double h, double k) {
  const double a = (1.0 - k) * (1.0 - k), b = k * k;
  return T(a * (1.0 + 2.0 * k) * x0 + b * (3.0 - 2.0 * k) * x1 + h * k * (1.0 - k) * ((1.0 - k) * slope0 - k * slope1));
}

double y_at(const Ray& ray, double s) {
  const auto after = std::find_if(ray.samples.begin(), ray.samples.end(), [s](const Sample& x) { return x.s >= s; });
  if (after == ray.samples.begin()) return 0.0;
  if (after == ray.samples.end()) return ray.samples.back().y;
  const Sample &a = *(after - 1), &b = *after;
  return cubic(a.y, a.dy, b.y, b.dy, b.s - a.s, (s - a.s) / (b.s - a.s));
}

class Search {
 public:
  Search(const Surface& surface, Uv from, Uv to, double length)
      : surface_(surface),
        from_(from),
        frame_(tangent_frame(surface, from)),
        target_(surface.position(to)),
        length_(length) {
    const UvBox d = surface.domain();
    const auto widened = [](Interval x) {
      return Interval{x.lo - kBeyondBorder * x.length(), x.hi + kBeyondBorder * x.length()};
    };
    rim_ = {widened(d.u), widened(d.v)};
  }

  Fan run();

 private:
  const Ray& ray(int index);
  Ray follow(double t);
  std::optional<Sample> sample(const GeodesicIntegrator& path, const Ray& ray) const;
  bool outside(Uv p) const;
  bool close(const Ray& ray, const Ray& next) const;
  void refine(int index, int next, int halvings);
  void look(const Ray& ray, const Ray& before, const Ray& after);

  // Rays by index: kFirstRays * 2^kMostHalvings of them would fill the circle.
  static constexpr int kCircle = kFirstRays << kMostHalvings;

  const Surface& surface_;
  Uv from_;
  TangentFrame frame_;
  Xyz target_;
  double length_;
  UvBox rim_;
  std::map<int, Ray> rays_;
  Fan fan_;
};

bool Search::outside(Uv p) const {
  const bool u = !surface_.u_period() && !(p.u >= rim_.u.lo && p.u <= rim_.u.hi);
  const bool v = !surface_.v_period() && !(p.v >= rim_.v.lo && p.v <= rim_.v.hi);
  return u || v;
}

// Where the parameters do not tell the curvature, at a pole, the step is that of the sample before.
std::optional<Sample> Search::sample(const GeodesicIntegrator& path, const Ray& ray) const {
  const SpaceState at = path.at();
  const double k = curvatures(path.jet()).largest();
  const double shortest = length_ / kMostSamples, longest = length_ / kFewestSamples;
  const double before = ray.samples.empty() ? longest : ray.samples.back().step;
  const double step = std::isfinite(k) ? std::clamp(kSampleStep / k, shortest, longest) : before;
  const Sample x{path.covered(), at.S, at.tangent, at.normal, at.y, at.dy, step};
  if (!(x.X.allFinite() && x.T.allFinite() && x.n.allFinite())) return std::nullopt;
  return x;
}

Ray Search::follow(double t) {
  Ray ray{t, true, {}};
  TraceOptions options;
  options.tolerance = kRayTolerance;
  options.stop_at_domain = false;
  options.max_steps = 2 * kMostSamples;
  const double end = kFanReach * length_;
  GeodesicIntegrator path(surface_, from_, frame_.at_angle(t), end, options);
  for (int i = 0; i < kMostSamples; ++i) {
    const auto x = sample(path, ray);
    if (!x) break;
    ray.samples.push_back(*x);
    const bool conjugate = x->s > 0.0 && !(x->y > 0.0);
    const bool too_far = x->s + (target_ - x->X).norm() > end + x->step;
    if (conjugate || too_far || x->s >= end || outside(path.state().p)) {
      ray.lost = false;
      break;
    }
    if (path.advance(std::min(x->s + x->step, end)) != TraceStatus::Converged) break;
  }
  fan_.evaluations += path.evaluations() + static_cast<int>(ray.samples.size());
  return ray;
}

const Ray& Search::ray(int index) {
  const int i = index % kCircle;
  auto known = rays_.find(i);
  if (known == rays_.end()) known = rays_.emplace(i, follow(2.0 * M_PI * i / kCircle)).first;
  return known->second;
}

bool Search::close(const Ray& a, const Ray& b) const {
  const double turn = std::abs(std::remainder(a.t - b.t, 2.0 * M_PI));
  for (const Ray* r : {&a, &b})
    for (const Sample& x : r->samples)
      if (turn * std::abs(x.y) > kSpread * x.step) return false;
  return true;
}

void Search::refine(int index, int next, int halvings) {
  const Ray &a = ray(index), &b = ray(next);
  if (close(a, b)) {
    if (a.lost || b.lost) fan_.complete = false;
    return;
  }
  if (halvings == 0) {
    fan_.complete = false;
    return;
  }
  const int middle = (index + next) / 2;
  refine(index, middle, halvings - 1);
  refine(middle, next, halvings - 1);
}

// Where the ray passes by the target: a foot of the perpendicular between two samples. The geodesic that ends there has
// left a part b / y of a radian beside the ray, which has to be less than the way to the next ray; near a conjugate
// point, where y is no measure, what y changes up to the next ray counts.
void Search::look(const Ray& ray, const Ray& before, const Ray& after) {
  const double turn = std::max(std::abs(std::remainder(ray.t - before.t, 2.0 * M_PI)),
                               std::abs(std::remainder(after.t - ray.t, 2.0 * M_PI)));
  for (std::size_t i = 1; i < ray.samples.size(); ++i) {
    const Sample &p = ray.samples[i - 1], &q = ray.samples[i];
    const double h = q.s - p.s, a0 = (target_ - p.X).dot(p.T), a1 = (target_ - q.X).dot(q.T);
    // The ends' own neighbourhoods count to both: a foot may fall between two intervals where the ray bends.
    if (!(a0 >= -0.1 * h && a1 <= 0.1 * h)) continue;
    double k = std::clamp(a0 / (a0 - a1), 0.0, 1.0);
    constexpr int kSecants = 3;
    double lo = 0.0, hi = 1.0;
    for (int n = 0; n < kSecants; ++n) {
      const Xyz T = (1.0 - k) * p.T + k * q.T;
      const double a = (target_ - cubic(p.X, p.T, q.X, q.T, h, k)).dot(T);
      (a > 0.0 ? lo : hi) = k;
      k = std::clamp(k + a / h, lo, hi);
    }
    const Xyz T = ((1.0 - k) * p.T + k * q.T).normalized(), n = (1.0 - k) * p.n + k * q.n;
    const double b = (target_ - cubic(p.X, p.T, q.X, q.T, h, k)).dot(n.cross(T).normalized());
    const double s = p.s + k * h, y = cubic(p.y, p.dy, q.y, q.dy, h, k);
    const double change = std::max(std::abs(y_at(before, s) - y), std::abs(y_at(after, s) - y));
    if (!(std::abs(b) <= turn * (std::abs(y) + change) + 0.02 * h)) continue;
    const double off = std::clamp(b / y, -turn, turn);
    // A target that far above the ray's surface lies on another sheet of it.
    const double above = std::abs((target_ - cubic(p.X, p.T, q.X, q.T, h, k)).dot(n.normalized()));
    constexpr double kPlain = 0.5;
    fan_.hits.push_back({{s, ray.t + (std::isfinite(off) ? off : 0.0)},
                         turn,
                         change < kPlain * std::abs(y) && above < kPlain * p.step});
  }
}

Fan Search::run() {
  fan_.complete = true;
  constexpr int kStep = kCircle / kFirstRays;
  for (int i = 0; i < kCircle; i += kStep) refine(i, i + kStep, kMostHalvings);
  for (auto r = rays_.begin(); r != rays_.end(); ++r) {
    const Ray& before = r == rays_.begin() ? rays_.rbegin()->second : std::prev(r)->second;
    const Ray& after = std::next(r) == rays_.end() ? rays_.begin()->second : std::next(r)->second;
    look(r->second, before, after);
  }
  std::sort(fan_.hits.begin(), fan_.hits.end(), [](const FanHit& a, const FanHit& b) { return a.at.s < b.at.s; });
  return fan_;
}

}  // namespace

Fan search_fan(const Surface& surface, Uv from, Uv to, double length) {
  return Search(surface, from, to, length).run();
}

}  // namespace geovor
