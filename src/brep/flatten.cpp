#include "brep/flatten.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace geovor {
namespace {

/// Chords that a curved p-curve starts with, shared among its analytic pieces.
constexpr int kFirstChords = 4;
/// Bisections at most: 2^12 chords a piece is beyond any sensible deflection, and ends the search at a cusp.
constexpr int kDeepest = 12;
/// Where along a chord its distance from the curve is measured; three places, so that an inflection can't hide it.
constexpr double kProbes[] = {0.25, 0.5, 0.75};
/// Deviations below this part of the chord are rounding of the p-curve's evaluation.
constexpr double kRounding = 1e-12;

struct Sample {
  double t;
  Uv uv;
};

Sample sample(const Curve2& curve, double t) {
  const Eigen::Vector2d c = curve.position(t);
  const Sample s{t, {c[0], c[1]}};
  if (!is_finite(s.uv)) {
    throw Error(ErrorCode::FaceRejected, "a p-curve has a point that is not a number; repair the face");
  }
  return s;
}

class Flattener {
 public:
  Flattener(const Surface& surface, const Curve2& curve, double deflection)
      : surface_(surface), curve_(curve), deflection_(deflection) {}

  /// Appends the chords of the piece from `a` to `b`; `first_chords` of them or more where it is curved.
  void piece(const Sample& a, const Sample& b, int first_chords, std::vector<BorderChord>& out) const {
    if (straight(a, b)) {
      out.push_back({a.uv, b.uv, nullptr, a.t, b.t});
      return;
    }
    Sample from = a;
    for (int i = 1; i <= first_chords; ++i) {
      const Sample to = i == first_chords ? b : sample(curve_, a.t + (b.t - a.t) * i / first_chords);
      chord(from, to, kDeepest, out);
      from = to;
    }
  }

 private:
  /// The way from the curve at `p` to the chord, as a direction of the parameter plane.
  static UvVec deviation(Uv a, Uv b, Uv p) {
    const UvVec d = b - a;
    const UvVec w = p - a;
    const double length2 = d.u * d.u + d.v * d.v;
    const double k = length2 > 0.0 ? std::clamp((w.u * d.u + w.v * d.v) / length2, 0.0, 1.0) : 0.0;
    return p - lerp(a, b, k);
  }

  bool straight(const Sample& a, const Sample& b) const {
    // Seven inner points: more than a curve of a usual degree can lie on by chance.
    constexpr int kInner = 7;
    const double rounding = kRounding * (std::hypot(a.uv.u, a.uv.v) + std::hypot(b.uv.u, b.uv.v));
    for (int i = 1; i <= kInner; ++i) {
      const UvVec off = deviation(a.uv, b.uv, sample(curve_, a.t + (b.t - a.t) * i / (kInner + 1)).uv);
      if (!(std::hypot(off.u, off.v) <= rounding)) return false;
    }
    return true;
  }

  double distance(Uv a, Uv b, Uv p) const {
    const UvVec off = deviation(a, b, p);
    if (off.u == 0.0 && off.v == 0.0) return 0.0;
    const SurfaceJet j = surface_.jet(p);
    return (j.Su * off.u + j.Sv * off.v).norm();
  }

  void chord(const Sample& a, const Sample& b, int depth, std::vector<BorderChord>& out) const {
    double worst = 0.0;
    Sample middle = a;
    for (const double k : kProbes) {
      const Sample s = sample(curve_, a.t + k * (b.t - a.t));
      if (k == 0.5) middle = s;
      worst = std::max(worst, distance(a.uv, b.uv, s.uv));
    }
    if (!(worst > deflection_) || depth == 0) {
      out.push_back({a.uv, b.uv, &curve_, a.t, b.t});
      return;
    }
    chord(a, middle, depth - 1, out);
    chord(middle, b, depth - 1, out);
  }

  const Surface& surface_;
  const Curve2& curve_;
  double deflection_;
};

}  // namespace

std::vector<BorderChord> flatten(const Surface& surface, const Coedge& coedge, double deflection) {
  if (!coedge.pcurve) throw Error(ErrorCode::FaceRejected, "an edge has no p-curve on the face; repair the face");
  const Flattener flattener(surface, *coedge.pcurve, deflection);
  Sample from = sample(*coedge.pcurve, coedge.range.lo);
  std::vector<BorderChord> chords;
  std::vector<double> ends = coedge.pcurve->breaks(coedge.range);
  ends.push_back(coedge.range.hi);
  const int pieces = static_cast<int>(ends.size());
  const int first_chords = (kFirstChords + pieces - 1) / pieces;
  for (const double t : ends) {
    const Sample to = sample(*coedge.pcurve, t);
    flattener.piece(from, to, first_chords, chords);
    from = to;
  }
  if (coedge.reversed) {
    std::reverse(chords.begin(), chords.end());
    for (BorderChord& c : chords) std::swap(c.a, c.b), std::swap(c.from, c.to);
  }
  return chords;
}

}  // namespace geovor
