#include "surface/knot_vector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"

namespace geovor {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

// A parameter moved by whole periods, or by the arithmetic of an integrator that aims at a knot, is off by a few units
// in the last place of the largest number involved.
constexpr double kRoundingUnits = 16.0;

[[noreturn]] void reject(const std::string& what) { throw Error(ErrorCode::FaceRejected, what); }

void check(const std::vector<double>& knots, const std::vector<int>& multiplicities, int degree, bool periodic) {
  if (degree < 1 || degree > kMaxDegree)
    reject("the degree " + std::to_string(degree) + " of a B-spline is not in 1 to 25; lower the degree");
  if (knots.size() < 2 || knots.size() != multiplicities.size())
    reject("a B-spline has fewer than two knots, or not one multiplicity a knot; repair the knot vector");
  for (size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i]) || (i > 0 && !(knots[i] > knots[i - 1])))
      reject("the knots of a B-spline do not ascend; repair the knot vector");
    const bool end = i == 0 || i + 1 == knots.size();
    if (multiplicities[i] < 1 || multiplicities[i] > (end && !periodic ? degree + 1 : degree))
      reject("a knot of a B-spline has the multiplicity " + std::to_string(multiplicities[i]) + " at degree " +
             std::to_string(degree) + "; split the surface or the curve there");
  }
  if (periodic && multiplicities.front() != multiplicities.back())
    reject("the end knots of a periodic B-spline have unequal multiplicities; repair the knot vector");
}

}  // namespace

KnotVector::KnotVector(const std::vector<double>& knots, const std::vector<int>& multiplicities, int degree,
                       bool periodic)
    : degree_(degree), periodic_(periodic), wraps_(periodic) {
  check(knots, multiplicities, degree, periodic);
  int total = 0;
  for (int m : multiplicities) total += m;
  pole_count_ = periodic ? total - multiplicities.back() : total - degree - 1;
  if (pole_count_ < (periodic ? 1 : degree + 1))
    reject("a B-spline of degree " + std::to_string(degree) + " has too few knots; repair the knot vector");
  unroll(knots, multiplicities);
  index_spans();
}

KnotVector KnotVector::from_flat(const std::vector<double>& flat, int degree) {
  std::vector<double> knots;
  std::vector<int> multiplicities;
  for (double t : flat) {
    if (!knots.empty() && t == knots.back()) {
      ++multiplicities.back();
    } else {
      knots.push_back(t);
      multiplicities.push_back(1);
    }
  }
  return {knots, multiplicities, degree};
}

// In the periodic case the flat sequence gets p + 1 - m knots before and after those stated, m the multiplicity of the
// ends: then the principal period begins at the flat index p and its first span is governed by the poles 0 … p.
void KnotVector::unroll(const std::vector<double>& knots, const std::vector<int>& multiplicities) {
  for (size_t i = 0; i < knots.size(); ++i) flat_.insert(flat_.end(), multiplicities[i], knots[i]);
  if (periodic_) {
    const double period = knots.back() - knots.front();
    const int extra = degree_ + 1 - multiplicities.front();
    const int cycle = pole_count_;  // knots a period
    const std::vector<double> stated = flat_;
    auto periodic_knot = [&](int i) {
      if (i >= 0 && i < static_cast<int>(stated.size())) return stated[i];
      const int turn = i >= 0 ? i / cycle : -((cycle - 1 - i) / cycle);
      return stated[i - turn * cycle] + turn * period;
    };
    flat_.clear();
    for (int i = -extra; i < static_cast<int>(stated.size()) + extra; ++i) flat_.push_back(periodic_knot(i));
  }
  const int last = static_cast<int>(flat_.size()) - degree_ - 1;
  domain_ = {flat_[degree_], flat_[last]};
  if (!(domain_.lo < domain_.hi)) reject("the knots of a B-spline enclose no interval; repair the knot vector");
  rounding_ = kRoundingUnits * std::numeric_limits<double>::epsilon() *
              std::max({std::abs(domain_.lo), std::abs(domain_.hi), domain_.length()});
}

bool KnotVector::clamped(bool low) const {
  const size_t last = flat_.size() - 1, p = degree_;
  return !periodic_ && (low ? flat_[0] == flat_[p] : flat_[last] == flat_[last - p]);
}

void KnotVector::index_spans() {
  const int last = static_cast<int>(flat_.size()) - degree_ - 1;
  reciprocal_stride_ = degree_ * (degree_ + 1) / 2;
  row_of_span_.assign(flat_.size(), 0);
  for (int i = degree_; i < last; ++i) {
    if (!(flat_[i] < flat_[i + 1])) continue;
    row_of_span_[i] = static_cast<int>(span_of_line_.size());
    span_of_line_.push_back(i);
    lines_.push_back(flat_[i]);
    for (int q = 1; q <= degree_; ++q)
      for (int r = 0; r < q; ++r) reciprocals_.push_back(1.0 / (flat_[i + 1 + r] - flat_[i + 1 + r - q]));
  }
  lines_.push_back(domain_.hi);
  for (double t : lines_) multiplicity_.push_back(static_cast<int>(std::count(flat_.begin(), flat_.end(), t)));

  const int buckets = static_cast<int>(span_of_line_.size());
  buckets_per_unit_ = buckets / domain_.length();
  int k = 0;
  for (int b = 0; b < buckets; ++b) {
    const double left = domain_.lo + b / buckets_per_unit_;
    while (k + 1 < buckets && lines_[k + 1] <= left) ++k;
    bucket_.push_back(k);
  }
  for (int b = 0; b < buckets; ++b) {
    const int middle = line_below(domain_.lo + (b + 0.5) / buckets_per_unit_);
    guess_.push_back({lines_[middle], lines_[middle + 1], span_of_line_[middle]});
  }
}

int KnotVector::continuity(int smooth) const {
  int order = smooth;
  for (size_t k = periodic_ ? 0 : 1; k + 1 < lines_.size(); ++k) order = std::min(order, degree_ - multiplicity_[k]);
  return order;
}

// The greatest k with lines_[k] <= x, kept to the spans there are. Equal buckets make the search one step where knots
// are nearly equidistant; inside a bucket it is a bisection.
int KnotVector::line_below(double x) const {
  const int spans = static_cast<int>(span_of_line_.size());
  const double place = (x - domain_.lo) * buckets_per_unit_;
  if (!(place > 0.0)) return 0;
  if (place >= spans) return spans - 1;
  const int b = static_cast<int>(place);
  int lo = bucket_[b];
  int hi = b + 1 < spans ? bucket_[b + 1] + 1 : spans;
  while (hi - lo > 1) {
    const int mid = (lo + hi) / 2;
    (x < lines_[mid] ? hi : lo) = mid;
  }
  // The bucket's ends are rounded: x may lie a rounding beyond them.
  while (lo + 1 < spans && x >= lines_[lo + 1]) ++lo;
  while (lo > 0 && x < lines_[lo]) --lo;
  return lo;
}

KnotSpan KnotVector::search(double x, double towards) const {
  const int spans = static_cast<int>(span_of_line_.size());
  KnotSpan span;
  if (wraps_ && !domain_.contains(x)) {
    span.turns = std::floor((x - domain_.lo) / period());
    x -= span.turns * period();
  }
  int k = line_below(x);
  if (towards < 0.0) {
    if (x - lines_[k] <= rounding_) --k;
  } else if (lines_[k + 1] - x <= rounding_) {
    ++k;
  }
  if (wraps_ && (k < 0 || k >= spans)) {
    span.turns += k < 0 ? -1.0 : 1.0;
    k = k < 0 ? spans - 1 : 0;
  }
  span.index = span_of_line_[std::clamp(k, 0, spans - 1)];
  return span;
}

Interval KnotVector::box(const KnotSpan& span) const {
  const double lo = flat_[span.index], hi = flat_[span.index + 1];
  if (wraps_) return {lo + span.turns * period(), hi + span.turns * period()};
  return {lo <= domain_.lo ? -kInf : lo, hi >= domain_.hi ? kInf : hi};
}

}  // namespace geovor
