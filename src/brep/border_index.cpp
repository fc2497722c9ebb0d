#include "brep/border_index.h"

#include <algorithm>
#include <cmath>

namespace geovor {
namespace {

/// Rounding of a p-curve's end after a few operations, relative to the box.
constexpr double kRounding = 1e-13;
/// More bands than this bring nothing: a band then holds less than a cache line of segments.
constexpr int kMostBands = 4096;

double magnitude(const Interval& i) { return std::max(std::abs(i.lo), std::abs(i.hi)); }

}  // namespace

BorderIndex::BorderIndex(const std::vector<BorderSegment>& segments, const UvBox& box)
    : box_(box), eps_u_(kRounding * magnitude(box.u)), eps_v_(kRounding * magnitude(box.v)) {
  bands_ = std::clamp(static_cast<int>(segments.size()), 1, kMostBands);
  bands_per_v_ = box.v.length() > 0.0 ? bands_ / box.v.length() : 0.0;
  const auto each_band = [&](auto&& visit) {
    for (const BorderSegment& s : segments) {
      const int last = band(std::max(s.a.v, s.b.v) + eps_v_);
      for (int i = band(std::min(s.a.v, s.b.v) - eps_v_); i <= last; ++i) visit(i, s);
    }
  };
  first_.assign(bands_ + 1, 0);
  each_band([&](int i, const BorderSegment&) { ++first_[i + 1]; });
  for (int i = 0; i < bands_; ++i) first_[i + 1] += first_[i];
  entries_.resize(first_.back());
  std::vector<int> next(first_.begin(), first_.end() - 1);
  each_band([&](int i, const BorderSegment& s) {
    const UvVec d = s.b - s.a;
    entries_[next[i]++] = {s.a, s.b, eps_u_ * std::abs(d.v) + eps_v_ * std::abs(d.u)};
  });
}

int BorderIndex::band(double v) const {
  // Clamped as a double: the cast of a value beyond int is undefined.
  return static_cast<int>(std::clamp((v - box_.v.lo) * bands_per_v_, 0.0, bands_ - 1.0));
}

Side BorderIndex::side(Uv p) const {
  if (!(p.u >= box_.u.lo - eps_u_ && p.u <= box_.u.hi + eps_u_ && p.v >= box_.v.lo - eps_v_ &&
        p.v <= box_.v.hi + eps_v_ && bands_ > 0)) {
    return Side::Outside;
  }
  bool odd = false;
  const int i = band(p.v);
  for (int n = first_[i]; n < first_[i + 1]; ++n) {
    const Entry& e = entries_[n];
    const double lo = std::min(e.a.v, e.b.v), hi = std::max(e.a.v, e.b.v);
    if (p.v < lo - eps_v_ || p.v > hi + eps_v_) continue;
    // c / dv is how far the segment's line at p.v lies to the right of p.
    const double c = cross(e.b - e.a, p - e.a);
    if (std::abs(c) <= e.slack && p.u >= std::min(e.a.u, e.b.u) - eps_u_ && p.u <= std::max(e.a.u, e.b.u) + eps_u_) {
      return Side::OnBorder;
    }
    // Half-open in v, so that a corner between two segments counts once.
    if ((e.a.v > p.v) != (e.b.v > p.v) && (c > 0.0) == (e.b.v > e.a.v)) odd = !odd;
  }
  return odd ? Side::Inside : Side::Outside;
}

std::vector<double> BorderIndex::crossings(double v) const {
  std::vector<double> u;
  if (!box_.v.contains(v) || bands_ == 0) return u;
  const int i = band(v);
  for (int n = first_[i]; n < first_[i + 1]; ++n) {
    const Entry& e = entries_[n];
    if ((e.a.v > v) != (e.b.v > v)) u.push_back(lerp(e.a, e.b, (v - e.a.v) / (e.b.v - e.a.v)).u);
  }
  std::sort(u.begin(), u.end());
  return u;
}

void BorderIndex::meet(Uv a, Uv b, std::vector<double>& k) const {
  if (bands_ == 0 || std::max(a.v, b.v) < box_.v.lo - eps_v_ || std::min(a.v, b.v) > box_.v.hi + eps_v_) return;
  const UvVec d = b - a;
  const double u_lo = std::min(a.u, b.u) - eps_u_, u_hi = std::max(a.u, b.u) + eps_u_;
  const int last = band(std::max(a.v, b.v) + eps_v_);
  for (int n = first_[band(std::min(a.v, b.v) - eps_v_)]; n < first_[last + 1]; ++n) {
    const Entry& e = entries_[n];
    if (std::max(e.a.u, e.b.u) < u_lo || std::min(e.a.u, e.b.u) > u_hi) continue;
    const UvVec w = e.b - e.a;
    const double determinant = cross(d, w);
    if (determinant == 0.0) continue;
    const double along_path = cross(e.a - a, w) / determinant;
    const double along_border = cross(e.a - a, d) / determinant;
    // A path through a corner must meet one of its two segments whatever the rounding.
    constexpr double kEnds = 1e-9;
    if (along_border >= -kEnds && along_border <= 1.0 + kEnds && along_path >= -kEnds && along_path <= 1.0 + kEnds) {
      k.push_back(std::clamp(along_path, 0.0, 1.0));
    }
  }
}

}  // namespace geovor
