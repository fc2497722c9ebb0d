// Healing, only where it is needed: a face that is replaced costs time and may stop sharing edges with its neighbours.
#include <BRepLib.hxx>
#include <BRep_Tool.hxx>
#include <Precision.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeFix_Edge.hxx>
#include <ShapeFix_Face.hxx>
#include <ShapeFix_Wire.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Iterator.hxx>
#include <algorithm>
#include <cmath>

#include "occ_adapter/occ_private.h"

namespace geovor::occ {
namespace {

// Points a coedge at which curve and p-curve are compared; both are smooth, so a fault shows at a few.
constexpr int kSamples = 9;
// Rounding of a curve against a surface point, both computed from coordinates of the size of the model.
constexpr double kRounding = 1e-9;

/// The largest distance between curve(t) and surface(pcurve(t)).
double deviation(const TopoDS_Edge& edge, const TopoDS_Face& face) {
  double first, last, first2, last2;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
  const Handle(Geom2d_Curve) pcurve = BRep_Tool::CurveOnSurface(edge, face, first2, last2);
  if (curve.IsNull() || pcurve.IsNull()) return 0.0;
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  double worst = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double k = static_cast<double>(i) / (kSamples - 1);
    const gp_Pnt2d uv = pcurve->Value(first2 + k * (last2 - first2));
    worst = std::max(worst, curve->Value(first + k * (last - first)).Distance(surface->Value(uv.X(), uv.Y())));
  }
  return worst;
}

/// Curves for edges that have only p-curves, p-curves for edges that have only curves, and one parameter for all.
void complete_edges(const TopoDS_Face& face) {
  const Handle(ShapeFix_Edge) fix = new ShapeFix_Edge;
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  for (TopExp_Explorer walk(forward, TopAbs_EDGE); walk.More(); walk.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(walk.Current());
    if (BRep_Tool::Degenerated(edge)) continue;
    double first, last;
    if (BRep_Tool::Curve(edge, first, last).IsNull()) BRepLib::BuildCurve3d(edge);
    if (BRep_Tool::CurveOnSurface(edge, forward, first, last).IsNull()) {
      fix->FixAddPCurve(edge, forward, BRep_Tool::IsClosed(edge, forward), BRep_Tool::Tolerance(edge));
    }
    if (!BRep_Tool::SameRange(edge)) BRepLib::SameRange(edge);
    const double size = BRep_Tool::Tolerance(edge) + kRounding;
    if (!BRep_Tool::SameParameter(edge) || deviation(edge, forward) > size) fix->FixSameParameter(edge);
  }
}

bool has_wire(const TopoDS_Face& face) { return TopExp_Explorer(face, TopAbs_WIRE).More(); }

/// OpenCASCADE's face healing with what concerns loops in the parameter plane: order, seams, poles, natural bounds.
TopoDS_Shape healed(const TopoDS_Face& face, const Handle(ShapeBuild_ReShape) & context) {
  const Handle(ShapeFix_Face) fix = new ShapeFix_Face(face);
  fix->SetContext(context);
  fix->SetPrecision(std::max(BRep_Tool::Tolerance(face), Precision::Confusion()));
  fix->FixPeriodicDegeneratedMode() = 1;
  fix->FixAddNaturalBoundMode() = 1;
  fix->Perform();
  return fix->Result();
}

bool sound(const TopoDS_Shape& faces) {
  bool any = false;
  for (TopExp_Explorer walk(faces, TopAbs_FACE); walk.More(); walk.Next()) {
    if (!extract_trims(TopoDS::Face(walk.Current())).sound()) return false;
    any = true;
  }
  return any;
}

class Healer {
 public:
  /// Heals one face; returns what was done, empty for nothing.
  std::string heal(const TopoDS_Face& face) {
    if (BRep_Tool::Surface(face).IsNull() || context_->IsRecorded(face)) return {};
    complete_edges(face);
    const OccTrims trims = extract_trims(face);
    const bool inside_out = trims.turned && unwrapped(BRep_Tool::Surface(face))->DynamicType()->Name() != plane_;
    if (trims.sound() && !inside_out) return {};
    const Handle(ShapeBuild_ReShape) trial = new ShapeBuild_ReShape;
    if (!sound(healed(face, trial)) && trims.sound()) return {};
    context_->Replace(face, healed(face, context_));
    if (!has_wire(face)) return "had no border: the natural border of its surface was taken";
    return trims.sound() ? "had a border that ran the wrong way: healed" : "had a border that did not close: healed";
  }

  TopoDS_Shape apply(const TopoDS_Shape& shape) const { return context_->Apply(shape); }

 private:
  const std::string plane_ = "Geom_Plane";
  Handle(ShapeBuild_ReShape) context_ = new ShapeBuild_ReShape;
};

}  // namespace

PreparedShape prepare_shape(const TopoDS_Shape& shape) {
  const std::vector<TopoDS_Shape> faces = parts_of(shape, TopAbs_FACE);
  Healer healer;
  PreparedShape prepared;
  for (const TopoDS_Shape& face : faces) {
    prepared.repairs.emplace_back();
    try {
      const std::string done = healer.heal(TopoDS::Face(face));
      if (!done.empty()) prepared.repairs.back().push_back(done);
    } catch (const Standard_Failure& failure) {
      prepared.repairs.back().push_back("can't be healed by OpenCASCADE (" + describe(failure) + ")");
    }
  }
  prepared.shape = healer.apply(shape);
  for (const TopoDS_Shape& face : faces) prepared.faces.push_back(healer.apply(face));
  return prepared;
}

}  // namespace geovor::occ
