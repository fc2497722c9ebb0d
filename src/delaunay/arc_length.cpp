#include "delaunay/arc_length.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/gauss_legendre.h"

namespace geovor {
namespace {

constexpr int kNodes = 10;
// A piece is exact where its halves differ from it by no more than this part of the whole length: a few tens of
// roundings of the sum, and two digits better than what is promised.
constexpr double kExact = 1e-14;
// Poles far from the origin lose these many units in the last place in a derivative, and the length with it.
constexpr double kLostUnits = 8.0;
// Halvings of one analytic piece: around a cusp 40 of them leave 1e-12 of it.
constexpr int kDeepest = 40;
// Where noise in the derivative keeps the halves from agreeing, this many pieces are the end of it.
constexpr std::size_t kMostPieces = 20000;
// Newton's method doubles the digits each time; halvings alone need 53.
constexpr int kMostSteps = 64;

double way(const Curve3& curve, double lo, double hi) {
  return integrate([&](double t) { return curve.jet(t).d1.norm(); }, Interval{lo, hi}, kNodes);
}

}  // namespace

ArcLength::ArcLength(const Curve3& curve, Interval range) : curve_(curve), t_{range.lo}, s_{0.0} {
  std::vector<double> ends = curve.breaks(range);
  ends.push_back(range.hi);
  std::vector<double> whole(ends.size());
  double length = 0.0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    whole[i] = way(curve, i == 0 ? range.lo : ends[i - 1], ends[i]);
    length += whole[i];
  }
  const double reach = std::max(curve.position(range.lo).norm(), curve.position(range.hi).norm());
  exact_ = kExact * length + kLostUnits * std::numeric_limits<double>::epsilon() * reach;
  for (std::size_t i = 0; i < ends.size(); ++i) add(t_.back(), ends[i], whole[i], 0);
}

// By halves until they agree with the whole; written so that NaN ends it.
void ArcLength::add(double lo, double hi, double whole, int depth) {
  const double middle = 0.5 * (lo + hi), first = way(curve_, lo, middle), second = way(curve_, middle, hi);
  const bool coarse = std::abs(first + second - whole) > exact_;
  if (coarse && depth < kDeepest && s_.size() < kMostPieces) {
    add(lo, middle, first, depth + 1);
    add(middle, hi, second, depth + 1);
    return;
  }
  s_.push_back(s_.back() + first + second);
  t_.push_back(hi);
}

double ArcLength::at(double t) const {
  if (!(t > t_.front())) return 0.0;
  if (!(t < t_.back())) return length();
  const std::size_t i = static_cast<std::size_t>(std::upper_bound(t_.begin(), t_.end(), t) - t_.begin()) - 1;
  return s_[i] + way(curve_, t_[i], t);
}

// Newton's method inside the piece, by halves where it would leave the bracket (the speed may vanish at its ends).
double ArcLength::parameter(double s) const {
  if (!(s > 0.0)) return t_.front();
  if (!(s < s_.back())) return t_.back();
  const std::size_t i = static_cast<std::size_t>(std::upper_bound(s_.begin(), s_.end(), s) - s_.begin());
  const double start = t_[i - 1], target = s - s_[i - 1];
  const double enough = std::numeric_limits<double>::epsilon() * s_.back();
  double lo = start, hi = t_[i];
  double t = lo + (hi - lo) * (target / (s_[i] - s_[i - 1]));
  for (int k = 0; k < kMostSteps && lo < t && t < hi; ++k) {
    const double miss = way(curve_, start, t) - target;
    if (!(std::abs(miss) > enough)) break;
    (miss > 0.0 ? hi : lo) = t;
    t -= miss / curve_.jet(t).d1.norm();
    if (!(t > lo && t < hi)) t = 0.5 * (lo + hi);
  }
  return t;
}

}  // namespace geovor
