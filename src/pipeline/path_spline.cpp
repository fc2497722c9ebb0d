#include "pipeline/path_spline.h"

#include <array>
#include <cmath>

namespace geovor {
namespace {

// Halvings of a piece of the path, at most. Each divides the error by 64: eight reach rounding, and end the search
// where the path has no tangent.
constexpr int kMostHalvings = 8;

constexpr int kDegree = 5;
using Bezier = std::array<Xyz, kDegree + 1>;

/// The quintic over [0, h] with these points and unit tangents at 0, h/2 and h. Relative to the first point, so that
/// the factors below do not magnify the rounding of coordinates.
Bezier quintic(const PathPoint& a, const PathPoint& middle, const PathPoint& b) {
  const double h = b.s - a.s;
  const Xyz B5 = b.xyz - a.xyz, M = middle.xyz - a.xyz;
  const Xyz B1 = h / kDegree * a.tangent, B4 = B5 - h / kDegree * b.tangent;
  // At the middle 32 B = b0 + 5 b1 + 10 b2 + 10 b3 + 5 b4 + b5 and 16/5 B' = -b0 - 3 b1 - 2 b2 + 2 b3 + 3 b4 + b5.
  const Xyz sum = (32.0 * M - 5.0 * B1 - 5.0 * B4 - B5) / 10.0;
  const Xyz difference = (16.0 / 5.0 * h * middle.tangent + 3.0 * B1 - 3.0 * B4 - B5) / 2.0;
  const Xyz B2 = 0.5 * (sum - difference), B3 = 0.5 * (sum + difference);
  return {a.xyz, a.xyz + B1, a.xyz + B2, a.xyz + B3, a.xyz + B4, b.xyz};
}

Xyz value(Bezier b, double t) {
  for (int level = kDegree; level > 0; --level) {
    for (int i = 0; i < level; ++i) b[i] += t * (b[i + 1] - b[i]);
  }
  return b[0];
}

class SplineFitter {
 public:
  SplineFitter(const SurfacePath& path, double deviation) : path_(path), deviation_(deviation) {
    const PathPoint start = path.at(0.0);
    curve_.degree = kDegree;
    curve_.knots = {0.0};
    curve_.multiplicities = {kDegree + 1};
    curve_.poles = {start.xyz};
  }

  void add(const PathPoint& a, const PathPoint& b, int halvings) {
    const PathPoint middle = path_.at(0.5 * (a.s + b.s));
    const Bezier bezier = quintic(a, middle, b);
    if (halvings > 0 && !close(a, b, bezier)) {
      add(a, middle, halvings - 1);
      add(middle, b, halvings - 1);
      return;
    }
    curve_.poles.insert(curve_.poles.end(), bezier.begin() + 1, bezier.end() - 1);
    curve_.knots.push_back(b.s);
    curve_.multiplicities.push_back(kDegree - 1);
    last_ = b.xyz;
  }

  /// At a crease the point itself is a pole.
  void corner() {
    curve_.poles.push_back(last_);
    curve_.multiplicities.back() = kDegree;
  }

  CadCurve finish() {
    curve_.poles.push_back(last_);
    curve_.multiplicities.back() = kDegree + 1;
    return curve_;
  }

 private:
  /// The error of the interpolation is t^2 (t - 1/2)^2 (t - 1)^2 times the sixth derivative: it is largest at these two
  /// places, and NaN is far.
  bool close(const PathPoint& a, const PathPoint& b, const Bezier& bezier) const {
    constexpr double kWorst = 0.21132486540518713;  // (1 - 1/sqrt(3)) / 2
    for (const double t : {kWorst, 1.0 - kWorst}) {
      if (!((value(bezier, t) - path_.at(a.s + t * (b.s - a.s)).xyz).norm() <= deviation_)) return false;
    }
    return true;
  }

  const SurfacePath& path_;
  double deviation_;
  CadCurve curve_;
  Xyz last_ = Xyz::Zero();
};

}  // namespace

CadCurve spline_of_path(const SurfacePath& path, double deviation) {
  // Tangents that differ by less differ by rounding.
  constexpr double kCorner = 1e-9;
  SplineFitter fitter(path, deviation);
  for (const PathPiece& piece : path.pieces()) {
    const PathPoint end = path.before(piece.to);
    fitter.add(path.at(piece.from), end, kMostHalvings);
    const bool inside = piece.ends_at_break && piece.to < path.length();
    if (inside && (path.at(piece.to).tangent - end.tangent).norm() > kCorner) fitter.corner();
  }
  return fitter.finish();
}

}  // namespace geovor
