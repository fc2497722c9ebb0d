// Lines and conics with the parameterizations of OpenCASCADE's Geom_Line, Geom_Circle, Geom_Ellipse, Geom_Parabola and
// Geom_Hyperbola (and their Geom2d twins): C the centre, X and Y orthonormal axes. In the plane a left-handed pair of
// axes runs clockwise. Constructors throw Error(FaceRejected) for a size without sense.
#pragma once

#include "surface/curve.h"

namespace geovor {

/// C + t D; D of any length but zero.
template <int Dim>
class Line final : public Curve<Dim> {
 public:
  using Point = typename Curve<Dim>::Point;
  Line(const Point& origin, const Point& direction);
  Interval domain() const override;
  CurveJet<Dim> jet(double t) const override;
  using Curve<Dim>::jet;
  const Point& origin() const { return origin_; }
  const Point& direction() const { return direction_; }

 private:
  Point origin_, direction_;
};

/// Centre and axes of a conic.
template <int Dim>
struct ConicFrame {
  using Point = Eigen::Matrix<double, Dim, 1>;
  Point centre, x, y;
};

/// C + a cos t X + b sin t Y, of period 2 pi; the base of circle and ellipse.
template <int Dim>
class Ellipse : public Curve<Dim> {
 public:
  Ellipse(const ConicFrame<Dim>& frame, double major_radius, double minor_radius);
  Interval domain() const override;
  std::optional<double> period() const override;
  CurveJet<Dim> jet(double t) const override;
  using Curve<Dim>::jet;
  const ConicFrame<Dim>& frame() const { return frame_; }
  double major_radius() const { return a_; }
  double minor_radius() const { return b_; }

 private:
  ConicFrame<Dim> frame_;
  double a_, b_;
};

template <int Dim>
class Circle final : public Ellipse<Dim> {
 public:
  Circle(const ConicFrame<Dim>& frame, double radius) : Ellipse<Dim>(frame, radius, radius) {}
  double radius() const { return this->major_radius(); }
};

/// C + t^2 / (4 f) X + t Y, f the focal length.
template <int Dim>
class Parabola final : public Curve<Dim> {
 public:
  Parabola(const ConicFrame<Dim>& frame, double focal_length);
  Interval domain() const override;
  CurveJet<Dim> jet(double t) const override;
  using Curve<Dim>::jet;

 private:
  ConicFrame<Dim> frame_;
  double focal_;
};

/// C + a cosh t X + b sinh t Y.
template <int Dim>
class Hyperbola final : public Curve<Dim> {
 public:
  Hyperbola(const ConicFrame<Dim>& frame, double major_radius, double minor_radius);
  Interval domain() const override;
  CurveJet<Dim> jet(double t) const override;
  using Curve<Dim>::jet;

 private:
  ConicFrame<Dim> frame_;
  double a_, b_;
};

extern template class Line<2>;
extern template class Line<3>;
extern template class Ellipse<2>;
extern template class Ellipse<3>;
extern template class Parabola<2>;
extern template class Parabola<3>;
extern template class Hyperbola<2>;
extern template class Hyperbola<3>;

}  // namespace geovor
