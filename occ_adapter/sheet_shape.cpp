// From a sheet to OpenCASCADE's faces: pieces of the original edges keep the original curves.
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>

#include "occ_adapter/occ_write_private.h"

namespace geovor::occ {
namespace {

class SheetShape {
 public:
  SheetShape(const CadSheet& sheet, const TopoDS_Shape& healed, bool reversed) : sheet_(sheet), reversed_(reversed) {
    for (TopExp_Explorer part(healed, TopAbs_FACE); part.More(); part.Next()) {
      const TopoDS_Face face = TopoDS::Face(part.Current());
      if (surface_.IsNull()) surface_ = unwrapped(BRep_Tool::Surface(face));
      OccTrims trims = extract_trims(face);
      std::move(trims.loops.begin(), trims.loops.end(), std::back_inserter(loops_));
    }
    for (const Xyz& x : sheet.vertices) {
      vertices_.emplace_back();
      builder_.MakeVertex(vertices_.back(), {x.x(), x.y(), x.z()}, Precision::Confusion());
    }
    for (const SheetEdge& edge : sheet.edges) add_edge(edge);
  }

  std::vector<TopoDS_Shape> faces() {
    std::vector<TopoDS_Shape> out;
    for (const SheetFace& face : sheet_.faces) out.push_back(face_of(face));
    return out;
  }

 private:
  const OccCoedge& coedge(CoedgeName name) const {
    const auto loop = static_cast<std::size_t>(name.loop), index = static_cast<std::size_t>(name.coedge);
    if (loop >= loops_.size() || index >= loops_[loop].coedges.size()) {
      throw Error(ErrorCode::Unwritable, "the input is no longer what it was; start again");
    }
    return loops_[loop].coedges[index];
  }

  void add_edge(const SheetEdge& edge) {
    TopoDS_Edge made;
    if (edge.is_cad_edge()) {
      made = piece(edge);
    } else {
      builder_.MakeEdge(made, spline_of(edge.curve), Precision::Confusion());
      builder_.UpdateEdge(made, spline_of(edge.pcurve), surface_, TopLoc_Location(), Precision::Confusion());
      finish(made, edge, edge.curve.knots.front(), edge.curve.knots.back());
    }
    edges_.push_back(made);
  }

  /// A piece of an original edge, with its curve and its p-curve, or both p-curves of a seam.
  TopoDS_Edge piece(const SheetEdge& edge) {
    const auto [along, against] = edge.coedges;
    const OccCoedge& one = coedge(along.loop >= 0 ? along : against);
    TopoDS_Edge made;
    double first, last;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(one.edge, first, last);
    const double tolerance = std::max(BRep_Tool::Tolerance(one.edge), Precision::Confusion());
    const bool pole = BRep_Tool::Degenerated(one.edge);
    if (pole) {
      builder_.MakeEdge(made);
    } else {
      builder_.MakeEdge(made, curve, tolerance);
    }
    if (along.loop >= 0 && against.loop >= 0) {
      builder_.UpdateEdge(made, one.pcurve, coedge(against).pcurve, surface_, TopLoc_Location(), tolerance);
    } else {
      builder_.UpdateEdge(made, one.pcurve, surface_, TopLoc_Location(), tolerance);
    }
    builder_.Degenerated(made, pole);
    finish(made, edge, edge.range.lo, edge.range.hi);
    return made;
  }

  void finish(TopoDS_Edge& made, const SheetEdge& edge, double first, double last) {
    TopoDS_Vertex &from = vertices_[static_cast<std::size_t>(edge.from)],
                  &to = vertices_[static_cast<std::size_t>(edge.to)];
    builder_.Add(made, from.Oriented(TopAbs_FORWARD));
    builder_.Add(made, to.Oriented(TopAbs_REVERSED));
    builder_.Range(made, first, last);
    builder_.SameRange(made, true);
    builder_.SameParameter(made, true);
    loosen(from, made, first);
    loosen(to, made, last);
  }

  /// A vertex reaches the ends of all its edges, in space and on the surface.
  void loosen(TopoDS_Vertex& vertex, const TopoDS_Edge& edge, double t) {
    constexpr double kSpare = 1.01;
    const gp_Pnt at = BRep_Tool::Pnt(vertex);
    double reach = BRep_Tool::Tolerance(edge), first, last;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
    if (!curve.IsNull()) reach = std::max(reach, kSpare * at.Distance(curve->Value(t)));
    for (const TopAbs_Orientation side : {TopAbs_FORWARD, TopAbs_REVERSED}) {
      const TopoDS_Edge oriented = TopoDS::Edge(edge.Oriented(side));
      const Handle(Geom2d_Curve) pcurve = BRep_Tool::CurveOnSurface(oriented, surface_, TopLoc_Location(), first, last);
      const gp_Pnt2d uv = pcurve->Value(t);
      reach = std::max(reach, kSpare * at.Distance(surface_->Value(uv.X(), uv.Y())));
    }
    builder_.UpdateVertex(vertex, reach);
  }

  TopoDS_Shape face_of(const SheetFace& cell) {
    TopoDS_Face face;
    builder_.MakeFace(face, surface_, Precision::Confusion());
    for (const auto& loop : cell.loops) {
      TopoDS_Wire wire;
      builder_.MakeWire(wire);
      for (const SheetUse& use : loop) {
        const TopoDS_Edge& edge = edges_[static_cast<std::size_t>(use.edge)];
        builder_.Add(wire, edge.Oriented(use.reversed ? TopAbs_REVERSED : TopAbs_FORWARD));
      }
      wire.Closed(true);
      builder_.Add(face, wire);
    }
    return reversed_ ? face.Reversed() : TopoDS_Shape(face);
  }

  const CadSheet& sheet_;
  bool reversed_;
  Handle(Geom_Surface) surface_;
  std::vector<OccLoop> loops_;
  BRep_Builder builder_;
  std::vector<TopoDS_Vertex> vertices_;
  std::vector<TopoDS_Edge> edges_;
};

}  // namespace

std::vector<TopoDS_Shape> sheet_faces(const CadSheet& sheet, const TopoDS_Shape& healed, bool reversed) {
  return SheetShape(sheet, healed, reversed).faces();
}

}  // namespace geovor::occ
