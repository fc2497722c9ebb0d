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
#include <array>
#include <map>

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
    add_pcurves_where_no_use_is_shifted();
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
    double first = edge.range.lo, last = edge.range.hi;
    if (!edge.is_cad_edge()) {
      builder_.MakeEdge(made, spline_of(edge.curve), Precision::Confusion());
      first = edge.curve.knots.front(), last = edge.curve.knots.back();
    } else if (const OccCoedge& original = coedge(edge.coedges[0].loop >= 0 ? edge.coedges[0] : edge.coedges[1]);
               BRep_Tool::Degenerated(original.edge)) {
      builder_.MakeEdge(made);
      builder_.UpdateEdge(made, tolerance_of(original.edge));
      builder_.Degenerated(made, true);
    } else {
      double from, to;
      builder_.MakeEdge(made, BRep_Tool::Curve(original.edge, from, to), tolerance_of(original.edge));
    }
    builder_.Add(made, vertex(edge.from).Oriented(TopAbs_FORWARD));
    builder_.Add(made, vertex(edge.to).Oriented(TopAbs_REVERSED));
    builder_.Range(made, first, last);
    builder_.SameRange(made, true);
    builder_.SameParameter(made, true);
    if (!BRep_Tool::Degenerated(made)) {
      double from, to;
      const Handle(Geom_Curve) curve = BRep_Tool::Curve(made, from, to);
      loosen(vertex(edge.from), made, curve->Value(first));
      loosen(vertex(edge.to), made, curve->Value(last));
    }
    edges_.push_back(made);
  }

  static double tolerance_of(const TopoDS_Edge& edge) {
    return std::max(BRep_Tool::Tolerance(edge), Precision::Confusion());
  }

  TopoDS_Vertex& vertex(int i) { return vertices_[static_cast<std::size_t>(i)]; }

  /// A vertex reaches the ends of all its edges, in space and on the surface.
  void loosen(TopoDS_Vertex& at, const TopoDS_Edge& edge, const gp_Pnt& end) {
    constexpr double kSpare = 1.01;
    builder_.UpdateVertex(at, std::max(BRep_Tool::Tolerance(edge), kSpare * BRep_Tool::Pnt(at).Distance(end)));
  }

  /// The p-curve of a use: an edge of the CAD has one for each direction.
  Handle(Geom2d_Curve) pcurve(const SheetUse& use) const {
    const SheetEdge& edge = sheet_.edges[static_cast<std::size_t>(use.edge)];
    Handle(Geom2d_Curve) curve =
        edge.is_cad_edge() ? coedge(edge.coedges[use.reversed]).pcurve : Handle(Geom2d_Curve)(spline_of(edge.pcurve));
    if (!is_shifted(use)) return curve;
    curve = Handle(Geom2d_Curve)::DownCast(curve->Copy());
    curve->Translate(gp_Vec2d(use.shift.u, use.shift.v));
    return curve;
  }

  static bool is_shifted(const SheetUse& use) { return use.shift.u != 0.0 || use.shift.v != 0.0; }

  static bool is_shifted(const SheetFace& face) {
    return std::any_of(face.loops.begin(), face.loops.end(), [](const std::vector<SheetUse>& loop) {
      return std::any_of(loop.begin(), loop.end(), [](const SheetUse& use) { return is_shifted(use); });
    });
  }

  /// What the uses of an edge on one surface need: the p-curve along it, the one against it, or, at a seam, both.
  using UsesOfEdges = std::map<int, std::array<const SheetUse*, 2>>;

  static void note_uses(const SheetFace& face, UsesOfEdges& uses) {
    for (const auto& loop : face.loops) {
      for (const SheetUse& use : loop) uses.try_emplace(use.edge).first->second[use.reversed] = &use;
    }
  }

  void add_pcurves(const UsesOfEdges& uses, const Handle(Geom_Surface) & surface) {
    for (const auto& [index, use] : uses) {
      const SheetEdge& edge = sheet_.edges[static_cast<std::size_t>(index)];
      TopoDS_Edge& made = edges_[static_cast<std::size_t>(index)];
      const double tolerance = BRep_Tool::Tolerance(made);
      const bool seam = edge.is_cad_edge() && use[0] != nullptr && use[1] != nullptr;
      const Handle(Geom2d_Curve) one = pcurve(use[0] != nullptr ? *use[0] : *use[1]);
      if (seam) {
        builder_.UpdateEdge(made, one, pcurve(*use[1]), surface, TopLoc_Location(), tolerance);
      } else {
        builder_.UpdateEdge(made, one, surface, TopLoc_Location(), tolerance);
      }
      double first, last;
      BRep_Tool::Range(made, first, last);
      const gp_Pnt2d from = one->Value(first), to = one->Value(last);
      loosen(vertex(edge.from), made, surface->Value(from.X(), from.Y()));
      loosen(vertex(edge.to), made, surface->Value(to.X(), to.Y()));
    }
  }

  /// All on one surface, where an edge has one p-curve a side. A shifted face has a surface of its own instead, so that
  /// its edges may have other p-curves there.
  void add_pcurves_where_no_use_is_shifted() {
    UsesOfEdges uses;
    for (const SheetFace& face : sheet_.faces) {
      if (!is_shifted(face)) note_uses(face, uses);
    }
    add_pcurves(uses, surface_);
  }

  TopoDS_Shape face_of(const SheetFace& cell) {
    Handle(Geom_Surface) surface = surface_;
    if (is_shifted(cell)) {
      surface = Handle(Geom_Surface)::DownCast(surface_->Copy());
      UsesOfEdges uses;
      note_uses(cell, uses);
      add_pcurves(uses, surface);
    }
    TopoDS_Face face;
    builder_.MakeFace(face, surface, Precision::Confusion());
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
