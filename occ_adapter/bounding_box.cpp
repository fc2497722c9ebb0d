// The box of the true geometry. Most borders and faces add nothing: the quick box, that of the poles, tells. Of the
// others splines are bounded by the hulls of their pieces: OpenCASCADE's optimizer over a spline face took 0.1 to 0.5
// s, the more the less even the parameterization. For all other curves and surfaces its box is exact and quick.
#include <BRepBndLib.hxx>
#include <BRepTools.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Tool.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>

#include "occ_adapter/occ_private.h"
#include "occ_adapter/spline_extent.h"

namespace geovor::occ {
namespace {

/// BRepBndLib adds Precision::Confusion() here and there; growth below this is none.
constexpr double kNoGrowth = 1e-6;
/// Of the box's diagonal: how near a spline's box is. A ridge of a spline is followed by pieces of the square root of
/// this.
constexpr double kNear = 1e-8;

Bnd_Box quick_box(const TopoDS_Shape& part) {
  Bnd_Box box;
  BRepBndLib::Add(part, box, false);
  box.SetGap(0.0);
  return box;
}

void add(Extent& extent, const Bnd_Box& box) {
  if (box.IsVoid()) return;
  if (box.IsOpen()) extent.add(Xyz::Constant(std::numeric_limits<double>::infinity()));
  extent.add(to_xyz(box.CornerMin()));
  extent.add(to_xyz(box.CornerMax()));
}

double growth(const Extent& extent, const Bnd_Box& by) {
  if (by.IsVoid()) return 0.0;
  if (extent.is_void()) return std::numeric_limits<double>::infinity();
  return std::max((extent.lower - to_xyz(by.CornerMin())).maxCoeff(),
                  (to_xyz(by.CornerMax()) - extent.upper).maxCoeff());
}

void add_by_occ(Extent& extent, const TopoDS_Shape& part) {
  Bnd_Box box;
  BRepBndLib::AddOptimal(part, box, false, false);
  box.SetGap(0.0);
  add(extent, box);
}

std::vector<double> flat(const TColStd_Array1OfReal& knots) { return {knots.begin(), knots.end()}; }

Eigen::Vector4d homogeneous(const gp_Pnt& p, double w) { return {w * p.X(), w * p.Y(), w * p.Z(), w}; }

bool usable(const SplinePoles& s) {
  return std::all_of(s.poles.begin(), s.poles.end(),
                     [](const Eigen::Vector4d& pole) { return pole.allFinite() && pole[3] > 0.0; });
}

/// The poles of an edge's curve if it is a spline.
std::optional<SplinePoles> spline_of(const Handle(Geom_Curve) & any) {
  Handle(Geom_Curve) base = any;
  while (const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(base)) base = trimmed->BasisCurve();
  if (!base || !(base->IsKind(STANDARD_TYPE(Geom_BSplineCurve)) || base->IsKind(STANDARD_TYPE(Geom_BezierCurve))))
    return std::nullopt;
  const Handle(Geom_BSplineCurve) c =
      Handle(Geom_BSplineCurve)::DownCast(GeomConvert::CurveToBSplineCurve(base)->Copy());
  c->SetNotPeriodic();
  SplinePoles s{c->Degree(), 0, flat(c->KnotSequence()), {}, c->NbPoles(), 1, {}, c->IsRational()};
  for (int i = 1; i <= s.n_u; ++i) s.poles.push_back(homogeneous(c->Pole(i), c->Weight(i)));
  return s;
}

/// The poles of a face's surface if it is a spline.
std::optional<SplinePoles> spline_of(const Handle(Geom_Surface) & any) {
  Handle(Geom_Surface) base = any;
  while (const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(base)) base = trimmed->BasisSurface();
  if (!base || !(base->IsKind(STANDARD_TYPE(Geom_BSplineSurface)) || base->IsKind(STANDARD_TYPE(Geom_BezierSurface))))
    return std::nullopt;
  const Handle(Geom_BSplineSurface) c =
      Handle(Geom_BSplineSurface)::DownCast(GeomConvert::SurfaceToBSplineSurface(base)->Copy());
  c->SetUNotPeriodic();
  c->SetVNotPeriodic();
  SplinePoles s{c->UDegree(),
                c->VDegree(),
                flat(c->UKnotSequence()),
                flat(c->VKnotSequence()),
                c->NbUPoles(),
                c->NbVPoles(),
                {},
                c->IsURational() || c->IsVRational()};
  for (int i = 1; i <= s.n_u; ++i) {
    for (int j = 1; j <= s.n_v; ++j) s.poles.push_back(homogeneous(c->Pole(i, j), c->Weight(i, j)));
  }
  return s;
}

/// The part of the knots' range that is asked for; all of it where a period reaches beyond.
Interval part_of(const std::vector<double>& knots, int degree, Interval asked) {
  const Interval all{knots[degree], knots[knots.size() - 1 - degree]};
  return asked.lo >= all.lo && asked.hi <= all.hi ? asked : all;
}

void add_edge(Extent& extent, const TopoDS_Edge& edge, double tolerance) {
  Interval range;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, range.lo, range.hi);
  const std::optional<SplinePoles> spline = spline_of(curve);
  if (!spline || !usable(*spline)) return add_by_occ(extent, edge);
  for (double t : {range.lo, range.hi}) extent.add(to_xyz(curve->Value(t)));
  const Interval over = part_of(spline->u_knots, spline->p, range);
  grow(extent, *spline, {over, {0.0, 1.0}}, tolerance, [](double, double) { return true; });
}

void add_face(Extent& extent, const TopoDS_Face& face, double tolerance) {
  const std::optional<SplinePoles> spline = spline_of(BRep_Tool::Surface(face));
  if (!spline || !usable(*spline)) return add_by_occ(extent, face);
  UvBox box;
  BRepTools::UVBounds(face, box.u.lo, box.u.hi, box.v.lo, box.v.hi);
  const UvBox over{part_of(spline->u_knots, spline->p, box.u), part_of(spline->v_knots, spline->q, box.v)};
  BRepTopAdaptor_FClass2d region(face, BRep_Tool::Tolerance(face));
  grow(extent, *spline, over, tolerance,
       [&region](double u, double v) { return region.Perform(gp_Pnt2d(u, v)) != TopAbs_OUT; });
}

/// The parts whose quick boxes reach beyond the box, the furthest first: they make most of the others
/// needless.
template <typename Add>
void add_parts(Extent& extent, const std::vector<TopoDS_Shape>& of_a_kind, const Add& add_exactly) {
  std::vector<std::pair<Bnd_Box, TopoDS_Shape>> parts;
  for (const TopoDS_Shape& part : of_a_kind) {
    Bnd_Box quick = quick_box(part);
    if (growth(extent, quick) > kNoGrowth) parts.emplace_back(std::move(quick), part);
  }
  std::stable_sort(parts.begin(), parts.end(), [&extent](const auto& a, const auto& b) {
    return growth(extent, a.first) > growth(extent, b.first);
  });
  for (const auto& [quick, part] : parts) {
    if (growth(extent, quick) > kNoGrowth) add_exactly(part);
  }
}

}  // namespace

Bnd_Box bounding_box(const TopoDS_Shape& shape) {
  Extent extent, quick;
  for (const TopoDS_Shape& vertex : parts_of(shape, TopAbs_VERTEX))
    extent.add(to_xyz(BRep_Tool::Pnt(TopoDS::Vertex(vertex))));
  const std::vector<TopoDS_Shape> faces = parts_of(shape, TopAbs_FACE);
  for (const TopoDS_Shape& face : faces) add(quick, quick_box(face));
  const double tolerance = std::isfinite(quick.diagonal()) ? kNear * quick.diagonal() : kNoGrowth;
  TopTools_IndexedMapOfShape found;
  for (const TopoDS_Shape& face : faces) TopExp::MapShapes(face, TopAbs_EDGE, found);
  const std::vector<TopoDS_Shape> edges(found.cbegin(), found.cend());
  add_parts(extent, edges, [&](const TopoDS_Shape& part) { add_edge(extent, TopoDS::Edge(part), tolerance); });
  add_parts(extent, faces, [&](const TopoDS_Shape& part) { add_face(extent, TopoDS::Face(part), tolerance); });
  Bnd_Box box;
  if (extent.is_void()) return box;
  if (!std::isfinite(extent.diagonal())) {
    box.SetWhole();
    return box;
  }
  box.Update(extent.lower[0], extent.lower[1], extent.lower[2], extent.upper[0], extent.upper[1], extent.upper[2]);
  return box;
}

}  // namespace geovor::occ
