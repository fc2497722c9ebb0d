#include "delaunay/arc_length.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/gauss_legendre.h"

namespace geovor {
namespace {

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

// P_0(x) … P_n(x), n one more than a piece's degree.
template <std::size_t N>
std::array<double, N + 1> legendre(double x) {
  std::array<double, N + 1> P{1.0, x};
  for (std::size_t k = 1; k < N; ++k) P[k + 1] = ((2.0 * k + 1.0) * x * P[k] - k * P[k - 1]) / (k + 1.0);
  return P;
}

}  // namespace

// c_k = (2k + 1)/2 int v P_k dx by Gauss' rule, which is exact as long as the speed v is of the piece's degree.
ArcLength::Piece ArcLength::piece(Interval range) const {
  const GaussRule& rule = gauss_legendre(kNodes);
  Piece p{range, 0.0, 0.0, {}};
  for (int i = 0; i < kNodes; ++i) {
    const double v = curve_.jet(range.middle() + 0.5 * range.length() * rule.nodes[i]).d1.norm();
    const auto P = legendre<kNodes>(rule.nodes[i]);
    for (int k = 0; k < kNodes; ++k) p.speed[k] += (k + 0.5) * rule.weights[i] * v * P[k];
  }
  p.length = p.speed[0] * range.length();
  return p;
}

// int P_k from -1 to x = (P_k+1 - P_k-1) / (2k + 1).
double ArcLength::Piece::at(double x) const {
  const auto P = legendre<kNodes>(x);
  double sum = speed[0] * (x + 1.0);
  for (int k = 1; k < kNodes; ++k) sum += speed[k] * (P[k + 1] - P[k - 1]) / (2 * k + 1);
  return 0.5 * range.length() * sum;
}

ArcLength::ArcLength(const Curve3& curve, Interval range) : curve_(curve) {
  std::vector<double> ends = curve.breaks(range);
  ends.push_back(range.hi);
  std::vector<Piece> whole;
  double length = 0.0, lo = range.lo;
  for (double hi : ends) {
    whole.push_back(piece({lo, hi}));
    length += whole.back().length;
    lo = hi;
  }
  const double reach = std::max(curve.position(range.lo).norm(), curve.position(range.hi).norm());
  exact_ = kExact * length + kLostUnits * std::numeric_limits<double>::epsilon() * reach;
  for (const Piece& p : whole) add(p, 0);
}

// By halves until they agree with the whole, in length and half way through; written so that NaN ends it. The halves
// are better than the whole, so they are what is kept.
void ArcLength::add(const Piece& whole, int depth) {
  const double middle = whole.range.middle();
  Piece first = piece({whole.range.lo, middle}), second = piece({middle, whole.range.hi});
  const bool coarse = std::abs(first.length + second.length - whole.length) > exact_ ||
                      std::abs(first.at(0.0) - whole.at(-0.5)) > exact_ ||
                      std::abs(first.length - whole.at(0.0)) > exact_ ||
                      std::abs(second.at(0.0) + first.length - whole.at(0.5)) > exact_;
  if (coarse && depth < kDeepest && pieces_.size() < kMostPieces) {
    add(first, depth + 1);
    add(second, depth + 1);
    return;
  }
  for (Piece* p : {&first, &second}) {
    p->way = length_;
    length_ += p->length;
    pieces_.push_back(*p);
  }
}

double ArcLength::at(double t) const {
  if (!(t > pieces_.front().range.lo)) return 0.0;
  if (!(t < pieces_.back().range.hi)) return length_;
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), t,
                                      [](double value, const Piece& p) { return value < p.range.lo; });
  const Piece& p = *(after - 1);
  return p.way + p.at(2.0 * (t - p.range.lo) / p.range.length() - 1.0);
}

// Newton's method inside the piece, by halves where it would leave the bracket (the speed may vanish at its ends).
double ArcLength::parameter(double s) const {
  if (!(s > 0.0)) return pieces_.front().range.lo;
  if (!(s < length_)) return pieces_.back().range.hi;
  const auto after =
      std::upper_bound(pieces_.begin(), pieces_.end(), s, [](double value, const Piece& p) { return value < p.way; });
  const Piece& p = *(after - 1);
  const double target = s - p.way, enough = std::numeric_limits<double>::epsilon() * length_;
  double lo = -1.0, hi = 1.0, x = 2.0 * target / p.length - 1.0;
  for (int k = 0; k < kMostSteps && lo < x && x < hi; ++k) {
    const double miss = p.at(x) - target;
    if (!(std::abs(miss) > enough)) break;
    (miss > 0.0 ? hi : lo) = x;
    const auto P = legendre<kNodes>(x);
    double speed = 0.0;
    for (int i = 0; i < kNodes; ++i) speed += p.speed[i] * P[i];
    x -= miss / (0.5 * p.range.length() * speed);
    if (!(x > lo && x < hi)) x = 0.5 * (lo + hi);
  }
  return p.range.middle() + 0.5 * p.range.length() * x;
}

}  // namespace geovor
