#include "voronoi/border_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "surface/forms.h"

namespace geovor {
namespace {

// Samples no farther than this beyond the nearest one may be next to a nearer point of the border.
constexpr double kBeyondNearest = 0.05;

// Of a step of samples; the distance's error is the square of this part of the step.
constexpr double kRefined = 1e-7;

// Of a segment: beside a corner, on either side.
constexpr double kBeside = 1e-9;

// Where the border makes less way than this part of its segment in the parameter's unit, the jet's direction is noise.
// Chords that are this part of the segment tell it instead.
constexpr double kStandsStill = 1e-6;
constexpr double kShortChord = 1e-6;

// Of a cycle with fewer segments than this each is a side, and the shortest side gets some samples too.
constexpr int kFewSegments = 64;
constexpr int kPartsOfFew = 8;

// Most samples of a border: a step that asks for more is too fine for any number of sites.
constexpr double kMostSamples = 2e6;

std::vector<BorderPlace> sampled(const FaceBorder& border, double step) {
  double total = 0.0;
  for (int cycle = 0; cycle < border.cycle_count(); ++cycle) {
    for (int k = 0; k < border.segment_count(cycle); ++k) total += border.segment_length(cycle, k);
  }
  const double finest = std::max(step, total / kMostSamples);
  std::vector<BorderPlace> places;
  for (int cycle = 0; cycle < border.cycle_count(); ++cycle) {
    const int least = border.segment_count(cycle) < kFewSegments ? kPartsOfFew : 1;
    for (int k = 0; k < border.segment_count(cycle); ++k) {
      const int parts = std::max(least, static_cast<int>(std::ceil(border.segment_length(cycle, k) / finest)));
      for (int i = 0; i < parts; ++i) places.push_back({cycle, k + static_cast<double>(i) / parts});
    }
  }
  return places;
}

std::vector<Xyz> positions(const FaceBorder& border, const std::vector<BorderPlace>& places) {
  std::vector<Xyz> x;
  for (const BorderPlace& place : places) x.push_back(border.xyz(place));
  return x;
}

}  // namespace

BorderDistance::BorderDistance(const Surface& surface, const FaceBorder& border, double step)
    : surface_(surface), border_(border), places_(sampled(border, step)), tree_(positions(border, places_)) {
  int k = 0;
  for (int cycle = 0; cycle < border.cycle_count(); ++cycle) {
    first_.push_back(k);
    while (k < static_cast<int>(places_.size()) && places_[k].cycle == cycle) ++k;
  }
  first_.push_back(k);
}

BorderPlace BorderDistance::wrapped(BorderPlace place) const {
  const double n = border_.segment_count(place.cycle);
  if (place.parameter >= n) place.parameter -= n;
  return place;
}

BorderPlace BorderDistance::before(int k) const {
  const int cycle = places_[k].cycle;
  return places_[k > first_[cycle] ? k - 1 : first_[cycle + 1] - 1];
}

BorderPlace BorderDistance::after(int k) const {
  const int cycle = places_[k].cycle;
  return places_[k + 1 < first_[cycle + 1] ? k + 1 : first_[cycle]];
}

Xyz BorderDistance::tangent(BorderPlace place) const {
  const Xyz slope = push_forward(surface_.jet(border_.uv(place)), border_.direction(place));
  const double length = border_.segment_length(place.cycle, static_cast<int>(place.parameter));
  return slope.norm() > kStandsStill * length ? slope.normalized() : chord_along(place, kShortChord * length);
}

BorderDistance::Tangents BorderDistance::tangents(BorderPlace place) const {
  const double n = border_.segment_count(place.cycle), earlier = place.parameter - kBeside;
  return {tangent({place.cycle, earlier < 0.0 ? earlier + n : earlier}),
          tangent(wrapped({place.cycle, place.parameter + kBeside}))};
}

// From the place towards the middle of its segment, the border's direction as the parameter grows.
Xyz BorderDistance::chord_along(BorderPlace place, double shortest) const {
  const double k = std::floor(place.parameter), way = k + 0.5 - place.parameter;
  Xyz chord = border_.xyz({place.cycle, k + 0.5}) - border_.xyz(place);
  for (double part = 0.5;; part *= 0.5) {
    const Xyz shorter = border_.xyz({place.cycle, place.parameter + part * way}) - border_.xyz(place);
    if (!(shorter.norm() > shortest)) break;
    chord = shorter;
  }
  return (way < 0.0 ? -chord : chord).normalized();
}

double BorderDistance::to(const Xyz& x, double limit) const {
  if (empty()) return limit;
  const double nearest = (tree_.point(tree_.nearest(x)) - x).norm();
  double best = nearest;
  for (int k : tree_.in_ball(x, nearest * (1.0 + kBeyondNearest))) {
    const double here = (tree_.point(k) - x).norm();
    const bool lowest = here <= (border_.xyz(before(k)) - x).norm() && here <= (border_.xyz(after(k)) - x).norm();
    if (lowest) best = std::min(best, refined(k, x));
  }
  return std::min(best, limit);
}

// Golden section: the distance has a corner where the border has one.
double BorderDistance::refined(int k, const Xyz& x) const {
  const BorderPlace from = before(k);
  const double n = border_.segment_count(from.cycle);
  const auto unwrapped = [&](double a) { return a < from.parameter ? a + n : a; };
  const auto at = [&](double a) { return (border_.xyz(wrapped({from.cycle, a})) - x).norm(); };
  constexpr double kGolden = 0.6180339887498949;
  double lo = from.parameter, hi = unwrapped(after(k).parameter);
  const double enough = kRefined * (hi - lo);
  double a = hi - kGolden * (hi - lo), b = lo + kGolden * (hi - lo), at_a = at(a), at_b = at(b);
  while (hi - lo > enough) {
    if (at_a < at_b) {
      hi = b, b = a, at_b = at_a;
      a = hi - kGolden * (hi - lo), at_a = at(a);
    } else {
      lo = a, a = b, at_a = at_b;
      b = lo + kGolden * (hi - lo), at_b = at(b);
    }
  }
  return std::min({at_a, at_b, (tree_.point(k) - x).norm()});
}

BorderDistance::Gate BorderDistance::extreme(const Xyz& direction) const {
  int best = 0;
  for (int k = 1; k < static_cast<int>(places_.size()); ++k) {
    if (direction.dot(tree_.point(k)) > direction.dot(tree_.point(best))) best = k;
  }
  const auto rising = [&](BorderPlace place) { return direction.dot(tangent(place)); };
  const BorderPlace top = turning_point(before(best), after(best), rising);
  const auto [arrives, leaves] = tangents(top);
  return {border_.uv(top), border_.xyz(top), (arrives + leaves).normalized()};
}

std::vector<BorderPlace> BorderDistance::between(BorderPlace from, BorderPlace to) const {
  const auto begin = places_.begin() + first_[from.cycle], end = places_.begin() + first_[from.cycle + 1];
  const auto later = [](double a, const BorderPlace& b) { return a < b.parameter; };
  const auto sooner = [](const BorderPlace& a, double b) { return a.parameter < b; };
  const auto start = std::upper_bound(begin, end, from.parameter, later);
  const auto stop = std::lower_bound(begin, end, to.parameter, sooner);
  if (from.parameter < to.parameter) return {start, stop};
  std::vector<BorderPlace> out(start, end);
  out.insert(out.end(), begin, stop);
  return out;
}

}  // namespace geovor
