#include "geodesic/slowed_time.h"

#include <cmath>

#include "numeric/dop853.h"

namespace geovor {

// m = Su x Sv, W' = m . m' / W.
double metric_rate(const SurfaceJet& j, double du, double dv) {
  const Xyz m = j.Su.cross(j.Sv);
  const Xyz dm = (du * j.Suu + dv * j.Suv).cross(j.Sv) + j.Su.cross(du * j.Suv + dv * j.Svv);
  return m.dot(dm) / m.squaredNorm();
}

// d(W u')/dt = W (W' u' + W u'').
SlowedStep::SlowedStep(const Surface& surface, const Piece& piece, const GeodesicVector& x, const GeodesicVector& slope,
                       const Xyz& normal, double rate)
    : surface_(surface), piece_(piece), normal0_(normal), normal_(normal), W0_(normal.norm()) {
  const double W = W0_;
  from_ << x[0], x[1], W * x[2], W * x[3], x[4], x[5];
  from_slope_ << from_[2], from_[3], W * W * (rate * x[2] + slope[2]), W * W * (rate * x[3] + slope[3]), 0.0, 0.0;
  const SurfaceJet j = piece.jet(surface, {x[0], x[1]});
  ++evaluations_;
  z0_ << x[0], x[1], x[2] * j.Su + x[3] * j.Sv, x[4], x[5], 0.0;
}

// W dT/ds = W k n, k = II(x', x') the normal curvature; y'' = -K y.
SlowedVector SlowedStep::slope_at(const SlowedVector& z) {
  ++evaluations_;
  const SurfaceJet j = piece_.jet(surface_, {z[0], z[1]});
  const Xyz T = z.segment<3>(2);
  normal_ = j.Su.cross(j.Sv);
  const double W = normal_.norm();
  const Xyz n = normal_ / W;
  const double a = T.cross(j.Sv).dot(n), b = j.Su.cross(T).dot(n);
  const double L = j.Suu.dot(n), M = j.Suv.dot(n), N = j.Svv.dot(n);
  const double turn = (L * a * a + 2.0 * M * a * b + N * b * b) / W;
  SlowedVector slope;
  slope << a, b, turn * n, W * z[6], -(L * N - M * M) / W * z[5], W;
  return slope;
}

bool SlowedStep::run(double t) {
  t_ = t;
  const auto step = dop853::step(z0_, slope_at(z0_), t, [this](const SlowedVector& z) { return slope_at(z); });
  z_ = step.state;
  error5_ = step.error5;
  if (!z_.allFinite()) return false;
  const SlowedVector slope = slope_at(z_);
  const double W = normal_.norm();
  to_ << z_[0], z_[1], slope[0], slope[1], z_[5], z_[6];
  end_ << z_[0], z_[1], slope[0] / W, slope[1] / W, z_[5], z_[6];
  return normal_.dot(normal0_) > 0.0 && end_.allFinite();
}

// Newton's method: ds/dt = W.
bool SlowedStep::run_to(double s, double t) {
  constexpr int kIterations = 30;
  constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
  for (int i = 0; i < kIterations; ++i) {
    if (!run(t)) return false;
    const double missing = s - arc_length();
    if (std::abs(missing) <= kRounding * s) return true;
    t += missing / normal_.norm();
    if (!(t > 0.0)) return false;
  }
  return false;
}

bool SlowedStep::meets_border(const BorderSlack& slack) const {
  BorderSlack slowed = slack;
  slowed.look /= W0_;
  return predict_exit(piece_, from_, from_slope_, slowed).s <= t_ || find_exit(piece_, from_, to_, t_, slowed).s < t_ ||
         !doubtful_turns(piece_, from_, from_slope_, to_, t_, slowed).empty();
}

Interval SlowedStep::swept_by(int axis) const {
  return swept(from_[axis], to_[axis], from_[axis + 2], to_[axis + 2], t_);
}

}  // namespace geovor
