// Geom_* and Geom2d_* curves to geovor's own, with the same parameters.
#include <Geom2dConvert.hxx>
#include <Geom2dConvert_ApproxCurve.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_BezierCurve.hxx>
#include <Geom2d_Circle.hxx>
#include <Geom2d_Ellipse.hxx>
#include <Geom2d_Hyperbola.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_Parabola.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <GeomConvert.hxx>
#include <GeomConvert_ApproxCurve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Ellipse.hxx>
#include <Geom_Hyperbola.hxx>
#include <Geom_Line.hxx>
#include <Geom_Parabola.hxx>
#include <Geom_TrimmedCurve.hxx>

#include "occ_adapter/occ_private.h"
#include "surface/bspline_curve.h"
#include "surface/elementary_curves.h"

namespace geovor::occ {
namespace {

// A curve of a kind that has no closed form here (an offset curve) is fitted by a B-spline to this distance.
constexpr double kFit = 1e-9;
constexpr int kFitSegments = 1000;
constexpr int kFitDegree = 9;

Eigen::Vector3d vec(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }
Eigen::Vector3d vec(const gp_Dir& d) { return {d.X(), d.Y(), d.Z()}; }
Eigen::Vector2d vec(const gp_Pnt2d& p) { return {p.X(), p.Y()}; }
Eigen::Vector2d vec(const gp_Dir2d& d) { return {d.X(), d.Y()}; }

/// The names of OpenCASCADE's two families of curves, so that one text converts both.
struct Space {
  static constexpr int kDim = 3;
  using Any = Geom_Curve;
  using Line = Geom_Line;
  using Conic = Geom_Conic;
  using Circle = Geom_Circle;
  using Ellipse = Geom_Ellipse;
  using Parabola = Geom_Parabola;
  using Hyperbola = Geom_Hyperbola;
  using BSpline = Geom_BSplineCurve;
  using Bezier = Geom_BezierCurve;
  using Trimmed = Geom_TrimmedCurve;
  static Handle(Geom_BSplineCurve) spline(const Handle(Geom_Curve) & curve) {
    return GeomConvert::CurveToBSplineCurve(curve);
  }
  static Handle(Geom_BSplineCurve) fitted(const Handle(Geom_Curve) & curve) {
    const GeomConvert_ApproxCurve fit(curve, kFit, GeomAbs_C2, kFitSegments, kFitDegree);
    return fit.HasResult() ? fit.Curve() : nullptr;
  }
};

struct Plane2d {
  static constexpr int kDim = 2;
  using Any = Geom2d_Curve;
  using Line = Geom2d_Line;
  using Conic = Geom2d_Conic;
  using Circle = Geom2d_Circle;
  using Ellipse = Geom2d_Ellipse;
  using Parabola = Geom2d_Parabola;
  using Hyperbola = Geom2d_Hyperbola;
  using BSpline = Geom2d_BSplineCurve;
  using Bezier = Geom2d_BezierCurve;
  using Trimmed = Geom2d_TrimmedCurve;
  static Handle(Geom2d_BSplineCurve) spline(const Handle(Geom2d_Curve) & curve) {
    return Geom2dConvert::CurveToBSplineCurve(curve);
  }
  static Handle(Geom2d_BSplineCurve) fitted(const Handle(Geom2d_Curve) & curve) {
    const Geom2dConvert_ApproxCurve fit(curve, kFit, GeomAbs_C2, kFitSegments, kFitDegree);
    return fit.HasResult() ? fit.Curve() : nullptr;
  }
};

template <class Family>
using OurCurve = std::shared_ptr<const Curve<Family::kDim>>;

template <class Family>
OurCurve<Family> convert_bspline(const typename Family::BSpline& spline) {
  std::vector<double> knots, weights;
  std::vector<int> multiplicities;
  std::vector<Eigen::Matrix<double, Family::kDim, 1>> poles;
  for (int i = 1; i <= spline.NbKnots(); ++i) {
    knots.push_back(spline.Knot(i));
    multiplicities.push_back(spline.Multiplicity(i));
  }
  for (int i = 1; i <= spline.NbPoles(); ++i) {
    poles.push_back(vec(spline.Pole(i)));
    if (spline.IsRational()) weights.push_back(spline.Weight(i));
  }
  return std::make_shared<BSplineCurve<Family::kDim>>(
      KnotVector(knots, multiplicities, spline.Degree(), spline.IsPeriodic()), poles, weights);
}

template <class Family>
OurCurve<Family> convert_conic(const typename Family::Conic& conic) {
  constexpr int kDim = Family::kDim;
  const ConicFrame<kDim> frame{vec(conic.Location()), vec(conic.XAxis().Direction()), vec(conic.YAxis().Direction())};
  if (const auto* circle = dynamic_cast<const typename Family::Circle*>(&conic)) {
    return std::make_shared<Circle<kDim>>(frame, circle->Radius());
  }
  if (const auto* ellipse = dynamic_cast<const typename Family::Ellipse*>(&conic)) {
    return std::make_shared<Ellipse<kDim>>(frame, ellipse->MajorRadius(), ellipse->MinorRadius());
  }
  if (const auto* parabola = dynamic_cast<const typename Family::Parabola*>(&conic)) {
    return std::make_shared<Parabola<kDim>>(frame, parabola->Focal());
  }
  if (const auto* hyperbola = dynamic_cast<const typename Family::Hyperbola*>(&conic)) {
    return std::make_shared<Hyperbola<kDim>>(frame, hyperbola->MajorRadius(), hyperbola->MinorRadius());
  }
  return nullptr;
}

template <class Family>
opencascade::handle<typename Family::Any> basis_of(opencascade::handle<typename Family::Any> curve) {
  using Trimmed = typename Family::Trimmed;
  while (const auto* trimmed = dynamic_cast<const Trimmed*>(curve.get())) curve = trimmed->BasisCurve();
  return curve;
}

template <class Family>
OurCurve<Family> convert(const opencascade::handle<typename Family::Any>& any, Interval range) {
  constexpr int kDim = Family::kDim;
  const opencascade::handle<typename Family::Any> curve = basis_of<Family>(any);
  if (curve.IsNull()) return nullptr;
  if (const auto* line = dynamic_cast<const typename Family::Line*>(curve.get())) {
    return std::make_shared<Line<kDim>>(vec(line->Position().Location()), vec(line->Position().Direction()));
  }
  if (const auto* conic = dynamic_cast<const typename Family::Conic*>(curve.get())) {
    return convert_conic<Family>(*conic);
  }
  if (const auto* spline = dynamic_cast<const typename Family::BSpline*>(curve.get())) {
    return convert_bspline<Family>(*spline);
  }
  if (dynamic_cast<const typename Family::Bezier*>(curve.get())) {
    return convert_bspline<Family>(*Family::spline(curve));
  }
  const auto fitted = Family::fitted(new typename Family::Trimmed(curve, range.lo, range.hi));
  return fitted.IsNull() ? nullptr : convert_bspline<Family>(*fitted);
}

}  // namespace

Curve3Ptr convert_curve(const Handle(Geom_Curve) & curve, Interval range) { return convert<Space>(curve, range); }

Curve2Ptr convert_pcurve(const Handle(Geom2d_Curve) & curve, Interval range) { return convert<Plane2d>(curve, range); }

}  // namespace geovor::occ
