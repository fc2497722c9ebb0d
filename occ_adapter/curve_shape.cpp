// Splines as OpenCASCADE's curves, and as edges of their own.
#include <BRep_Builder.hxx>
#include <Precision.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TopoDS_Vertex.hxx>

#include "occ_adapter/occ_write_private.h"

namespace geovor::occ {
namespace {

gp_Pnt to_pnt(const Xyz& p) { return {p.x(), p.y(), p.z()}; }

template <class Array, class Values, class Convert>
Array to_array(const Values& values, const Convert& convert) {
  Array array(1, static_cast<int>(values.size()));
  for (int i = array.Lower(); i <= array.Upper(); ++i)
    array.SetValue(i, convert(values[static_cast<std::size_t>(i - 1)]));
  return array;
}

constexpr auto kAsItIs = [](auto x) { return x; };

}  // namespace

Handle(Geom_BSplineCurve) spline_of(const CadCurve& c) {
  return new Geom_BSplineCurve(to_array<TColgp_Array1OfPnt>(c.poles, to_pnt),
                               to_array<TColStd_Array1OfReal>(c.knots, kAsItIs),
                               to_array<TColStd_Array1OfInteger>(c.multiplicities, kAsItIs), c.degree);
}

Handle(Geom2d_BSplineCurve) spline_of(const CadPcurve& c) {
  return new Geom2d_BSplineCurve(to_array<TColgp_Array1OfPnt2d>(c.poles, [](Uv p) { return gp_Pnt2d(p.u, p.v); }),
                                 to_array<TColStd_Array1OfReal>(c.knots, kAsItIs),
                                 to_array<TColStd_Array1OfInteger>(c.multiplicities, kAsItIs), c.degree);
}

TopoDS_Edge edge_of(const CadCurve& curve) {
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
  builder.MakeEdge(edge, spline_of(curve), Precision::Confusion());
  builder.Add(edge, first.Oriented(TopAbs_FORWARD));
  builder.Add(edge, last.Oriented(TopAbs_REVERSED));
  builder.Range(edge, curve.knots.front(), curve.knots.back());
  return edge;
}

}  // namespace geovor::occ
