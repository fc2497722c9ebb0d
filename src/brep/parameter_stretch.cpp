#include "brep/parameter_stretch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "brep/face_domain.h"

namespace geovor {
namespace {

/// Lines of v, and samples on each: 1000 jets, some tenths of a millisecond.
constexpr int kLines = 32, kSamplesPerLine = 32;

/// The samples' first derivatives. Lines and samples lie at midpoints: strictly inside, never on a pole or a seam.
std::vector<SurfaceJet> sample(const FaceDomain& domain) {
  std::vector<SurfaceJet> jets;
  const Interval rows = domain.box().v;
  for (int i = 0; i < kLines; ++i) {
    const double v = rows.lo + rows.length() * (i + 0.5) / kLines;
    const std::vector<Interval> stretches = domain.inside_at(v);
    double inside = 0.0;
    for (const Interval& s : stretches) inside += s.length();
    for (const Interval& s : stretches) {
      const int n = std::max(1, static_cast<int>(std::lround(kSamplesPerLine * s.length() / inside)));
      for (int k = 0; k < n; ++k) jets.push_back(domain.surface().jet({s.lo + s.length() * (k + 0.5) / n, v}));
    }
  }
  return jets;
}

/// The ratio of the singular values of the two columns, infinite where the smaller vanishes.
double singular_ratio(const Xyz& a, const Xyz& b) {
  const double E = a.squaredNorm(), G = b.squaredNorm();
  const double W = a.cross(b).norm();
  // The squares of the singular values are the roots of x^2 - (E + G) x + W^2.
  const double larger2 = 0.5 * (E + G) + std::hypot(0.5 * (E - G), a.dot(b));
  return W > 0.0 ? larger2 / W : std::numeric_limits<double>::infinity();
}

}  // namespace

Stretch parameter_stretch(const FaceDomain& domain) {
  const std::vector<SurfaceJet> jets = sample(domain);
  double log_u = 0.0, log_v = 0.0;
  int regular = 0;
  for (const SurfaceJet& j : jets) {
    if (!(j.Su.norm() > 0.0 && j.Sv.norm() > 0.0)) continue;
    log_u += std::log(j.Su.norm());
    log_v += std::log(j.Sv.norm());
    ++regular;
  }
  if (regular == 0) return {std::numeric_limits<double>::infinity(), 0.0};
  const double scale_u = std::exp(-log_u / regular), scale_v = std::exp(-log_v / regular);
  constexpr double kRightAngle = 1.5707963267948966;
  Stretch stretch{1.0, kRightAngle};
  for (const SurfaceJet& j : jets) {
    stretch.anisotropy = std::max(stretch.anisotropy, singular_ratio(scale_u * j.Su, scale_v * j.Sv));
    // Between the lines of u and v, whichever way they run: at most a right angle.
    stretch.smallest_angle =
        std::min(stretch.smallest_angle, std::atan2(j.Su.cross(j.Sv).norm(), std::abs(j.Su.dot(j.Sv))));
  }
  return stretch;
}

}  // namespace geovor
