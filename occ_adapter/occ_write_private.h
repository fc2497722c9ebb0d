// What the writers of this room share; private like occ_private.h.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "brep/cad_sheet.h"
#include "mesh/triangle_mesh.h"
#include "occ_adapter/occ_private.h"

namespace geovor::occ {

/// The mesh as planar faces with shared edges and vertices: a solid per closed component, a shell per open one; a
/// compound where there are several. Throws Error(Unwritable) for a triangle without area.
TopoDS_Shape facet_shape(const TriangleMesh& mesh);

Handle(Geom_BSplineCurve) spline_of(const CadCurve& curve);
Handle(Geom2d_BSplineCurve) spline_of(const CadPcurve& curve);

/// An edge that is the whole curve. Where the curve closes, its two ends are one vertex.
TopoDS_Edge edge_of(const CadCurve& curve);

/// The sheet's faces, in its order, on the surface of the face that they were cut from. `healed`: what became of that
/// face in prepare_shape(); `reversed`: its own orientation.
std::vector<TopoDS_Shape> sheet_faces(const CadSheet& sheet, const TopoDS_Shape& healed, bool reversed);

struct StepFile {
  std::string path;
  std::string unit;          ///< of the shapes' lengths and of the file: "mm", "in", …
  std::string description;   ///< for the header
  bool every_digit = false;  ///< numbers read back as the same double; otherwise OpenCASCADE's 13 digits
  bool pcurves = false;      ///< planes and lines need no curves in the parameter plane, and without them the file is
                             ///< half as long
};

struct NamedShape {
  TopoDS_Shape shape;
  std::string name;                                         ///< of its product in the file
  std::vector<std::pair<TopoDS_Shape, std::string>> parts;  ///< names for faces and edges in it
};

/// Writes the shapes, a product each; the same shapes give the same bytes. `shapes` is called where OpenCASCADE's
/// failures become errors. The file is complete or absent. Throws Error(Unwritable).
void write_step_file(const StepFile& file, const std::function<std::vector<NamedShape>()>& shapes);

}  // namespace geovor::occ
