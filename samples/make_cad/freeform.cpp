#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepLib.hxx>
#include <Geom2d_Circle.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Precision.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <TopoDS_Wire.hxx>
#include <cmath>
#include <numbers>

#include "make_cad/shapes.h"
#include "make_cad/spline.h"

namespace make_cad {

namespace {

TopoDS_Shape whole_face(const SplineHandle& surface) {
  return BRepBuilderAPI_MakeFace(surface, Precision::Confusion()).Face();
}

constexpr int kPoles = 8;
constexpr double kStep = 6.0;  ///< between poles, mm
/// Heights of the patch's poles over their grid, mm: a hill, a valley and a saddle between them.
constexpr double kHeight[kPoles][kPoles] = {
    {0.0, 0.5, 1.5, 2.0, 1.5, 0.5, 0.0, -0.5},      {0.5, 2.0, 4.0, 5.0, 3.5, 1.0, -0.5, -1.0},
    {1.0, 4.0, 7.5, 8.5, 5.5, 1.0, -2.0, -2.0},     {1.0, 4.5, 8.5, 9.0, 5.0, -0.5, -4.0, -3.0},
    {0.5, 3.0, 5.5, 5.5, 2.0, -3.0, -6.0, -4.5},    {0.0, 1.0, 2.0, 1.0, -2.0, -5.5, -7.0, -5.0},
    {-0.5, 0.0, 0.0, -1.0, -3.0, -5.0, -5.5, -4.0}, {-1.0, -0.5, 0.0, -0.5, -1.5, -2.5, -3.0, -2.0}};

/// x and y of the poles lean a little, so that no parameter line is straight and the two directions are not orthogonal.
gp_Pnt freeform_pole(int i, int j) {
  return gp_Pnt(kStep * i + 0.25 * j, kStep * j - 0.5 * i + 0.125 * i * i, kHeight[i][j]);
}

SplineHandle freeform_surface() {
  constexpr int kDegree = 3, kSpans = kPoles - kDegree;
  TColgp_Array2OfPnt poles(1, kPoles, 1, kPoles);
  for (int i = 0; i < kPoles; ++i)
    for (int j = 0; j < kPoles; ++j) poles(i + 1, j + 1) = freeform_pole(i, j);
  TColStd_Array1OfReal knots(1, kSpans + 1);
  TColStd_Array1OfInteger mults(1, kSpans + 1);
  for (int i = 0; i <= kSpans; ++i) {
    knots(i + 1) = static_cast<double>(i) / kSpans;
    mults(i + 1) = i == 0 || i == kSpans ? kDegree + 1 : 1;
  }
  return new Geom_BSplineSurface(poles, knots, knots, mults, mults, kDegree, kDegree);
}

/// A hole with its 3D curve fitted to the image of a circle of the parameter plane; turns clockwise there.
TopoDS_Wire circular_hole(const SplineHandle& surface, double u, double v, double radius) {
  const Handle(Geom2d_Circle) circle =
      new Geom2d_Circle(gp_Ax22d(gp_Pnt2d(u, v), gp_Dir2d(1, 0), gp_Dir2d(0, -1)), radius);
  const TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(circle, surface, 0.0, 2.0 * std::numbers::pi).Edge();
  return BRepBuilderAPI_MakeWire(edge).Wire();
}

}  // namespace

TopoDS_Shape wave() {
  const Knots knots = uniform_knots(7, -3.0, 3.0, 18);
  const auto sine = [](double u) { return std::sin(u); };
  const auto cosine = [](double v) { return std::cos(v); };
  return whole_face(graph(knots, knots, {{sine, cosine}}));
}

TopoDS_Shape flat() {
  const Knots knots = uniform_knots(1, -3.0, 3.0, 1);
  return whole_face(graph(knots, knots, {}));
}

TopoDS_Shape paraboloid() {
  const Knots knots = uniform_knots(2, -1.0, 1.0, 1);
  const auto square = [](double x) { return x * x; };
  const auto one = [](double) { return 1.0; };
  return whole_face(graph(knots, knots, {{square, one}, {one, square}}));
}

TopoDS_Shape bumps() {
  constexpr double kHeightOfBump = 3.0, kWidth = 0.3;
  const auto bell = [](double x) { return std::exp(-0.5 * x * x / (kWidth * kWidth)); };
  const auto two = [&](double u) { return kHeightOfBump * (bell(u - 1.0) + bell(u + 1.0)); };
  const auto one = [&](double v) { return bell(v - 0.2); };
  // Along v the spline is finer near the bumps; along u they are everywhere.
  const Knots u = uniform_knots(7, -2.0, 2.0, 28);
  Knots v = uniform_knots(7, -0.8, 1.2, 16);
  v.values.insert(v.values.begin(), {-2.0, -1.5, -1.2, -0.98});
  v.values.insert(v.values.end(), {1.38, 1.6, 2.0});
  return whole_face(graph(u, v, {{two, one}}));
}

TopoDS_Shape freeform() { return whole_face(freeform_surface()); }

TopoDS_Shape freeform_refined() {
  const SplineHandle surface = freeform_surface();
  surface->IncreaseDegree(5, 4);
  for (const double u : {0.1, 0.33, 0.77}) surface->InsertUKnot(u, 1, Precision::PConfusion());
  for (const double v : {0.05, 0.5}) surface->InsertVKnot(v, 2, Precision::PConfusion());
  return whole_face(surface);
}

TopoDS_Shape freeform_swapped() {
  const SplineHandle surface = freeform_surface();
  surface->ExchangeUV();
  surface->UReverse();
  return whole_face(surface);
}

TopoDS_Shape freeform_moebius() {
  constexpr double kU = 4.0, kV = 0.5;  // speeds at the two ends differ by 16 and by 4
  return whole_face(moebius(freeform_surface(), kU, kV));
}

TopoDS_Shape freeform_trimmed() {
  const SplineHandle surface = freeform_surface();
  BRepBuilderAPI_MakeFace face(surface, Precision::Confusion());
  face.Add(circular_hole(surface, 0.3, 0.35, 0.12));
  face.Add(circular_hole(surface, 0.7, 0.3, 0.08));
  face.Add(circular_hole(surface, 0.6, 0.75, 0.15));
  const TopoDS_Face result = face.Face();
  BRepLib::BuildCurves3d(result, Precision::Confusion());
  BRepLib::SameParameter(result, Precision::Confusion());
  return result;
}

}  // namespace make_cad
