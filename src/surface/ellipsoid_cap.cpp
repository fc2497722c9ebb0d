#include "surface/ellipsoid_cap.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace geovor {
namespace {

constexpr double kPi = std::numbers::pi;

// The height c sqrt(1 - q) - c with q = x^2/a^2 + y^2/b^2 has the slope 1 where x = a^2 / hypot(a, c): half of that is
// far from where the graph turns vertical.
double cap_radius(double a, double b, double c) {
  return 0.5 * std::min(a * a / std::hypot(a, c), b * b / std::hypot(b, c));
}

// The cap's own axes: n outwards (inwards in a left-handed placement, as the normal Su x Sv is), e1 = x.
class EllipsoidCap final : public PoleChart {
 public:
  EllipsoidCap(const Frame& axes, const PoleSide& side, double a, double b, double c, bool mirrored, double radius)
      : PoleChart(axes, side, radius, std::asin(radius / std::min(a, b)) * kBeyond),
        a_(a),
        b_(b),
        c_(c),
        mirrored_(mirrored) {}

  // On the disk sin(depth) = sqrt(q).
  Uv to_base(Uv ab) const override {
    const double x = ab.u / a_, y = (mirrored_ ? -ab.v : ab.v) / b_;
    const double u = std::atan2(y, x);
    return side().point(u < 0.0 ? u + 2.0 * kPi : u, std::asin(std::min(std::hypot(x, y), 1.0)));
  }
  Uv from_base(Uv p) const override {
    const double s = std::sin(side().depth(p));
    const double y = b_ * std::sin(p.u) * s;
    return {a_ * std::cos(p.u) * s, mirrored_ ? -y : y};
  }
  Xyz side_direction(Uv p) const override {
    const double y = b_ * std::cos(p.u);
    return (-a_ * std::sin(p.u) * frame().x + (mirrored_ ? -y : y) * frame().y).normalized();
  }

  HeightJet height(Uv ab) const override {
    const double x = ab.u / (a_ * a_), y = ab.v / (b_ * b_);
    const double q = ab.u * x + ab.v * y, root = std::sqrt(1.0 - q), k = c_ / root, k3 = k / (root * root);
    // c (root - 1), without the difference.
    return {-c_ * q / (1.0 + root),      -k * x,      -k * y,
            -k / (a_ * a_) - k3 * x * x, -k3 * x * y, -k / (b_ * b_) - k3 * y * y};
  }

 private:
  static constexpr double kBeyond = 1.01;  // the reach is a bound, not the depth to the last digit

  double a_, b_, c_;  // c < 0: the cap bends towards its normal
  bool mirrored_;     // e2 = -y
};

}  // namespace

PoleCharts ellipsoid_poles(const Frame& placement, double a, double b, double c) {
  const double handed = placement.x.cross(placement.y).dot(placement.z) < 0.0 ? -1.0 : 1.0;
  const double radius = cap_radius(a, b, c);
  auto cap = [&](double sign) {
    const Frame axes{placement.origin + sign * c * placement.z, placement.x, sign * placement.y,
                     sign * handed * placement.z};
    const PoleSide side{true, sign * 0.5 * kPi, sign < 0.0};
    return std::make_shared<const EllipsoidCap>(axes, side, a, b, handed * c, sign < 0.0, radius);
  };
  return {cap(-1.0), cap(1.0)};
}

}  // namespace geovor
