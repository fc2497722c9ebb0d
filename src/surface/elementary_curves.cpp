#include "surface/elementary_curves.h"

#include <cmath>
#include <numbers>

#include "base/error.h"

namespace geovor {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kTwoPi = 2.0 * std::numbers::pi;

double checked_size(double size) {
  if (!(size > 0.0) || !std::isfinite(size))
    throw Error(ErrorCode::FaceRejected, "the size of a conic is not positive; repair the curve");
  return size;
}

template <int Dim>
const ConicFrame<Dim>& checked(const ConicFrame<Dim>& f) {
  if (!f.centre.allFinite() || !f.x.allFinite() || !f.y.allFinite())
    throw Error(ErrorCode::FaceRejected, "the placement of a conic is not finite; repair the curve");
  return f;
}

}  // namespace

template <int Dim>
Line<Dim>::Line(const Point& origin, const Point& direction) : origin_(origin), direction_(direction) {
  if (!origin.allFinite() || !(direction.squaredNorm() > 0.0) || !direction.allFinite())
    throw Error(ErrorCode::FaceRejected, "a line has no direction; repair the curve");
}
template <int Dim>
Interval Line<Dim>::domain() const {
  return {-kInf, kInf};
}
template <int Dim>
CurveJet<Dim> Line<Dim>::jet(double t) const {
  return {origin_ + t * direction_, direction_, Point::Zero(), Point::Zero()};
}

template <int Dim>
Ellipse<Dim>::Ellipse(const ConicFrame<Dim>& frame, double major_radius, double minor_radius)
    : frame_(checked(frame)), a_(checked_size(major_radius)), b_(checked_size(minor_radius)) {}
template <int Dim>
Interval Ellipse<Dim>::domain() const {
  return {0.0, kTwoPi};
}
template <int Dim>
std::optional<double> Ellipse<Dim>::period() const {
  return kTwoPi;
}
template <int Dim>
CurveJet<Dim> Ellipse<Dim>::jet(double t) const {
  const double c = std::cos(t), s = std::sin(t);
  const typename Curve<Dim>::Point r = a_ * c * frame_.x + b_ * s * frame_.y;
  const typename Curve<Dim>::Point d = b_ * c * frame_.y - a_ * s * frame_.x;
  return {frame_.centre + r, d, -r, -d};
}

template <int Dim>
Parabola<Dim>::Parabola(const ConicFrame<Dim>& frame, double focal_length)
    : frame_(checked(frame)), focal_(checked_size(focal_length)) {}
template <int Dim>
Interval Parabola<Dim>::domain() const {
  return {-kInf, kInf};
}
template <int Dim>
CurveJet<Dim> Parabola<Dim>::jet(double t) const {
  const double k = 0.5 / focal_;
  return {frame_.centre + 0.5 * k * t * t * frame_.x + t * frame_.y, k * t * frame_.x + frame_.y, k * frame_.x,
          Curve<Dim>::Point::Zero()};
}

template <int Dim>
Hyperbola<Dim>::Hyperbola(const ConicFrame<Dim>& frame, double major_radius, double minor_radius)
    : frame_(checked(frame)), a_(checked_size(major_radius)), b_(checked_size(minor_radius)) {}
template <int Dim>
Interval Hyperbola<Dim>::domain() const {
  return {-kInf, kInf};
}
template <int Dim>
CurveJet<Dim> Hyperbola<Dim>::jet(double t) const {
  const double c = std::cosh(t), s = std::sinh(t);
  const typename Curve<Dim>::Point r = a_ * c * frame_.x + b_ * s * frame_.y;
  const typename Curve<Dim>::Point d = a_ * s * frame_.x + b_ * c * frame_.y;
  return {frame_.centre + r, d, r, d};
}

template class Line<2>;
template class Line<3>;
template class Ellipse<2>;
template class Ellipse<3>;
template class Parabola<2>;
template class Parabola<3>;
template class Hyperbola<2>;
template class Hyperbola<3>;

}  // namespace geovor
