#include "occ_adapter/write_cells.h"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shell.hxx>

#include "occ_adapter/occ_write_private.h"

namespace geovor {
namespace {

void require_finite(const CadCurve& curve) {
  for (const Xyz& pole : curve.poles) {
    if (!pole.allFinite()) throw Error(ErrorCode::Unwritable, "a curve has a pole that is no finite point");
  }
}

occ::NamedShape cells_shape(const CadSheet& sheet, const SheetSource& source) {
  const occ::LoadedShape loaded = occ::load_shape(source.file, check_cad_file(source.file));
  const std::size_t index = static_cast<std::size_t>(source.face - 1);
  const occ::PreparedShape prepared = occ::prepare_shape(loaded.shape);
  const std::vector<TopoDS_Shape> originals = occ::parts_of(loaded.shape, TopAbs_FACE);
  if (index >= originals.size()) throw Error(ErrorCode::Unwritable, "the input is no longer what it was; start again");
  const bool reversed = originals[index].Orientation() == TopAbs_REVERSED;
  const BRep_Builder builder;
  TopoDS_Shell shell;
  builder.MakeShell(shell);
  occ::NamedShape cells{shell, "cells", {}};
  const std::vector<TopoDS_Shape> faces = occ::sheet_faces(sheet, prepared.faces[index], reversed);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    builder.Add(shell, faces[i]);
    cells.parts.emplace_back(faces[i], sheet.faces[i].name);
  }
  shell.Closed(BRep_Tool::IsClosed(shell));
  return cells;
}

/// In one compound: OpenCASCADE takes a time for each shape that grows with all that it has written before.
occ::NamedShape edges_shape(const std::vector<CadCurve>& curves) {
  if (curves.size() == 1) return {occ::edge_of(curves.front()), curves.front().name, {}};
  const BRep_Builder builder;
  TopoDS_Compound compound;
  builder.MakeCompound(compound);
  occ::NamedShape edges{compound, "edges", {}};
  for (const CadCurve& curve : curves) {
    const TopoDS_Edge edge = occ::edge_of(curve);
    builder.Add(compound, edge);
    edges.parts.emplace_back(edge, curve.name);
  }
  return edges;
}

}  // namespace

void write_step(const CadSheet& sheet, const SheetSource& source, const std::string& path) {
  for (const SheetEdge& edge : sheet.edges) require_finite(edge.curve);
  for (const CadCurve& curve : sheet.curves) require_finite(curve);
  occ::write_step_file({path, source.unit, "geodesic Voronoi cells", true, true}, [&] {
    std::vector<occ::NamedShape> shapes = {cells_shape(sheet, source)};
    if (!sheet.curves.empty()) shapes.push_back(edges_shape(sheet.curves));
    return shapes;
  });
}

}  // namespace geovor
