#include "occ_adapter/write_step.h"

#include <BRep_Builder.hxx>
#include <GeomAbs_Shape.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Precision.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopoDS_Vertex.hxx>
#include <filesystem>

#include "occ_adapter/occ_write_private.h"

namespace geovor {
namespace {

void require_writable(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw Error(ErrorCode::Unwritable, "the mesh has no triangle; nothing to write");
  const int count = static_cast<int>(mesh.points.size());
  for (const auto& triangle : mesh.triangles) {
    for (const int corner : triangle) {
      if (corner < 0 || corner >= count || !mesh.points[static_cast<std::size_t>(corner)].allFinite()) {
        throw Error(ErrorCode::Unwritable, "a triangle has a corner that is no finite point; mesh again");
      }
    }
  }
}

void require_writable(const CadCurve& curve) {
  for (const Xyz& pole : curve.poles) {
    if (!pole.allFinite()) {
      throw Error(ErrorCode::Unwritable, "the curve '" + curve.name + "' has a pole that is no finite point");
    }
  }
}

gp_Pnt to_pnt(const Xyz& p) { return {p.x(), p.y(), p.z()}; }

template <class Array, class Values, class Convert>
Array to_array(const Values& values, const Convert& convert) {
  Array array(1, static_cast<int>(values.size()));
  for (int i = array.Lower(); i <= array.Upper(); ++i)
    array.SetValue(i, convert(values[static_cast<std::size_t>(i - 1)]));
  return array;
}

/// An edge that is the whole curve. Where the curve closes, its two ends are one vertex.
TopoDS_Edge edge_of(const CadCurve& curve) {
  const auto as_it_is = [](auto x) { return x; };
  const Handle(Geom_BSplineCurve) spline = new Geom_BSplineCurve(
      to_array<TColgp_Array1OfPnt>(curve.poles, to_pnt), to_array<TColStd_Array1OfReal>(curve.knots, as_it_is),
      to_array<TColStd_Array1OfInteger>(curve.multiplicities, as_it_is), curve.degree);
  const BRep_Builder builder;
  const auto vertex = [&](const Xyz& p) {
    TopoDS_Vertex v;
    builder.MakeVertex(v, to_pnt(p), Precision::Confusion());
    return v;
  };
  const TopoDS_Vertex first = vertex(curve.poles.front());
  const bool closed = (curve.poles.front() - curve.poles.back()).norm() <= Precision::Confusion();
  const TopoDS_Vertex last = closed ? first : vertex(curve.poles.back());
  TopoDS_Edge edge;
  builder.MakeEdge(edge, spline, Precision::Confusion());
  builder.Add(edge, first.Oriented(TopAbs_FORWARD));
  builder.Add(edge, last.Oriented(TopAbs_REVERSED));
  builder.Range(edge, curve.knots.front(), curve.knots.back());
  return edge;
}

}  // namespace

void write_step(const TriangleMesh& mesh, const std::string& unit, const std::string& path) {
  require_writable(mesh);
  occ::write_step_file({path, unit, "faceted boundary representation", false}, [&] {
    const std::string name = std::filesystem::path(path).stem().string();
    return std::vector<occ::NamedShape>{{occ::facet_shape(mesh), name}};
  });
}

void write_step(const std::vector<CadCurve>& curves, const std::string& unit, const std::string& path) {
  if (curves.empty()) throw Error(ErrorCode::Unwritable, "there is no curve; nothing to write");
  for (const CadCurve& curve : curves) require_writable(curve);
  occ::write_step_file({path, unit, "curves", true}, [&] {
    std::vector<occ::NamedShape> shapes;
    for (const CadCurve& curve : curves) shapes.push_back({edge_of(curve), curve.name});
    return shapes;
  });
}

}  // namespace geovor
