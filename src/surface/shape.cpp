#include "surface/shape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "surface/forms.h"
#include "surface/pole_chart.h"

namespace geovor {
namespace {

// Below this share of its mean length a derivative counts as zero: rounding has eaten the digits of the normal.
constexpr double kVanishing = 1e-7;
// Below this one it is looked at from inside. Files give poles to some 13 digits, so that Su is known to 1e-12 of its
// mean length: the normal is good to 1e-10 above it.
constexpr double kWeak = 1e-2;
constexpr double kGivenTo = 1e-12;
// Below this sine the two derivatives count as parallel.
constexpr double kParallel = 1e-9;

// Places along the line from which the field is continued: Chebyshev's, which multiply noise by no more than 3.
constexpr int kNodes = 10;
// The reach in space is halved until the error is estimated below kGood, at most so often.
constexpr double kGood = 1e-11;
constexpr int kReaches = 5;

double& part(Uv& p, int k) { return k == 0 ? p.u : p.v; }
const Xyz& derivative(const SurfaceJet& j, int k) { return k == 0 ? j.Su : j.Sv; }
const Interval& side(const UvBox& box, int k) { return k == 0 ? box.u : box.v; }

using Distances = std::array<double, kNodes>;

// The shape at the distance x by Lagrange's polynomial through the nodes i >= first.
Shape interpolate(const Distances& distance, const std::array<Shape, kNodes>& shapes, double x, int first) {
  Shape sum;
  for (int i = first; i < kNodes; ++i) {
    double weight = 1.0;
    for (int k = first; k < kNodes; ++k)
      if (k != i) weight *= (x - distance[k]) / (distance[i] - distance[k]);
    sum.n += weight * shapes[i].n;
    sum.B += weight * shapes[i].B;
  }
  return sum;
}

}  // namespace

double Shape::largest_curvature() const {
  const Xyz a = n.unitOrthogonal(), b = n.cross(a);
  const Xyz Ba = B * a, Bb = B * b;
  const double aa = a.dot(Ba), ab = a.dot(Bb), bb = b.dot(Bb);
  return 0.5 * std::abs(aa + bb) + std::hypot(0.5 * (aa - bb), ab);
}

Shape shape(const SurfaceJet& j) {
  Shape s;
  const Xyz normal = j.Su.cross(j.Sv);
  const double W = normal.norm();
  s.n = normal / W;
  const Xyz du = j.Sv.cross(s.n) / W, dv = s.n.cross(j.Su) / W;
  const Xyz Lu = s.n.dot(j.Suu) * du + s.n.dot(j.Suv) * dv, Nv = s.n.dot(j.Suv) * du + s.n.dot(j.Svv) * dv;
  s.B = du * Lu.transpose() + dv * Nv.transpose();
  return s;
}

ShapeField::ShapeField(const Surface& surface, const UvBox& box) : surface_(surface) {
  constexpr int kGrid = 7;
  double sum[2] = {0.0, 0.0};
  for (int i = 0; i < kGrid; ++i) {
    for (int k = 0; k < kGrid; ++k) {
      const SurfaceJet j =
          surface.jet({box.u.lo + (i + 0.5) / kGrid * box.u.length(), box.v.lo + (k + 0.5) / kGrid * box.v.length()});
      sum[0] += j.Su.norm();
      sum[1] += j.Sv.norm();
    }
  }
  for (int k : {0, 1}) {
    speed_[k] = sum[k] / (kGrid * kGrid);
    const Interval ends = side(surface.domain(), k);
    for (const Stop& end : {Stop{k, ends.lo, 1.0}, Stop{k, ends.hi, -1.0}})
      if (std::isfinite(ends.length()) && stops_at(end, box)) stops_.push_back(end);
  }
}

bool ShapeField::stops_at(const Stop& end, const UvBox& box) const {
  constexpr int kLooks = 5;
  const Interval across = side(box, 1 - end.k);
  for (int i = 0; i < kLooks; ++i) {
    Uv p;
    part(p, end.k) = end.at;
    part(p, 1 - end.k) = across.lo + (i + 0.5) / kLooks * across.length();
    if (!(derivative(surface_.jet(p), end.k).norm() <= kVanishing * speed_[end.k])) return false;
  }
  return true;
}

bool ShapeField::spanning(const SurfaceJet& j) const {
  const double a = j.Su.norm(), b = j.Sv.norm();
  return a > kVanishing * speed_[0] && b > kVanishing * speed_[1] && j.Su.cross(j.Sv).norm() > kParallel * a * b;
}

// The end near which the lines of k are slow at p.
const ShapeField::Stop* ShapeField::near_stop(int k, Uv p, const SurfaceJet& j) const {
  if (!(derivative(j, k).norm() < kWeak * speed_[k])) return nullptr;
  const Stop* nearest = nullptr;
  for (const Stop& s : stops_)
    if (s.k == k && (!nearest || std::abs(part(p, k) - s.at) < std::abs(part(p, k) - nearest->at))) nearest = &s;
  return nearest;
}

std::optional<Shape> ShapeField::at(Uv p, const SurfaceJet& j) const {
  const double share[2] = {j.Su.norm() / speed_[0], j.Sv.norm() / speed_[1]};
  const double weak = std::fmin(share[0], share[1]);
  const bool spans = spanning(j);
  if (weak >= kWeak && spans) return shape(j);
  for (const auto& chart : surface_.poles())
    if (chart->holds(p)) return shape(chart->jet(chart->from_base(p)));
  for (int k : {0, 1}) {
    const Stop* stop = near_stop(k, p, j);
    if (!stop) continue;
    const double noise = spans ? kGivenTo / weak : 1.0;
    const Continued c = continued(*stop, p, noise);
    if (c.error < noise) return c.shape;
  }
  return spans ? std::optional(shape(j)) : std::nullopt;
}

// The shape at a place from which the field is continued to `stop`: there the other parameter's lines may stop, too.
Shape ShapeField::inner(const Stop& stop, Uv q, const SurfaceJet& j) const {
  if (stop.k == 0)
    if (const Stop* other = near_stop(1, q, j)) return continued(*other, q, 1.0).shape;
  return shape(j);
}

ShapeField::Continued ShapeField::continued(const Stop& stop, Uv p, double noise) const {
  constexpr double kNear = 1.0 / 64.0, kFar = 1.0 / 8.0, kMostPower = 12.0;
  const UvBox domain = surface_.domain();
  Uv end = p;
  part(end, stop.k) = stop.at;
  const Span span = surface_.span(end, stop.k == 0 ? UvVec{stop.inwards, 0.0} : UvVec{0.0, stop.inwards});
  // Beyond the middle the lines may come to their other end.
  const Interval piece = side(span.box, stop.k);
  double depth =
      std::fmin(0.5 * side(domain, stop.k).length(), stop.inwards > 0.0 ? piece.hi - stop.at : stop.at - piece.lo);
  const Xyz x = surface_.position(end);
  const auto gone = [&](double t) {
    Uv q = end;
    part(q, stop.k) += stop.inwards * t;
    return (surface_.position(q) - x).norm();
  };
  const double power =
      std::clamp(std::log(gone(kFar * depth) / gone(kNear * depth)) / std::log(kFar / kNear), 1.0, kMostPower);
  Continued best{{}, std::numeric_limits<double>::infinity()};
  for (int i = 0; i < kReaches; ++i, depth *= std::pow(0.5, 1.0 / power)) {
    const Continued c = continued(stop, p, span, depth, power);
    if (c.error < best.error) best = c;
    if (best.error < std::fmin(kGood, noise)) break;
  }
  return best;
}

ShapeField::Continued ShapeField::continued(const Stop& stop, Uv p, const Span& span, double depth,
                                            double power) const {
  Uv end = p;
  part(end, stop.k) = stop.at;
  const Xyz x = surface_.jet(end, span).S;
  Distances distance;
  std::array<Shape, kNodes> shapes;
  for (int i = 0; i < kNodes; ++i) {
    const double share = 0.5 * (1.0 - std::cos((2 * i + 1) * std::numbers::pi / (2 * kNodes)));
    Uv q = end;
    part(q, stop.k) += stop.inwards * depth * std::pow(share, 1.0 / power);
    const SurfaceJet j = surface_.jet(q, span);
    distance[i] = (j.S - x).norm();
    shapes[i] = inner(stop, q, j);
  }
  const double here = (surface_.jet(p, span).S - x).norm();
  Continued c{interpolate(distance, shapes, here, 0), 0.0};
  c.error = (c.shape.n - interpolate(distance, shapes, here, 1).n).norm();
  c.shape.n.normalize();
  return c;
}

}  // namespace geovor
