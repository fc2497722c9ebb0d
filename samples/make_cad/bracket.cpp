// An angle bracket as a shop would draw it: foot and upright, rounded corners, two countersunk holes and a slot in the
// foot, a bored boss on the upright. Every face is a plane, cylinder, cone or torus, so its volume has a closed form.
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Ax2.hxx>
#include <initializer_list>
#include <numbers>
#include <stdexcept>

#include "make_cad/shapes.h"

namespace make_cad {

namespace {

constexpr double kThickness = 6.0, kLength = 60.0, kWidth = 40.0, kHeight = 50.0;
constexpr double kBossTop = 14.0, kBossHeight = 30.0, kBossRadius = 11.0;  ///< x of the end; z of the axis

TopoDS_Edge nearest_edge(const TopoDS_Shape& shape, const gp_Pnt& point) {
  const TopoDS_Shape vertex = BRepBuilderAPI_MakeVertex(point).Shape();
  TopoDS_Edge best;
  double smallest = 1e-3;  // the points given are meant to lie on their edges
  for (TopExp_Explorer it(shape, TopAbs_EDGE); it.More(); it.Next()) {
    const double distance = BRepExtrema_DistShapeShape(vertex, it.Current()).Value();
    if (distance >= smallest) continue;
    smallest = distance;
    best = TopoDS::Edge(it.Current());
  }
  if (best.IsNull()) throw std::runtime_error("bracket: no edge where a fillet was asked for");
  return best;
}

/// Rounds the edges that pass through the given points.
TopoDS_Shape rounded(const TopoDS_Shape& shape, double radius, std::initializer_list<gp_Pnt> points) {
  BRepFilletAPI_MakeFillet fillet(shape);
  for (const gp_Pnt& point : points) fillet.Add(radius, nearest_edge(shape, point));
  return fillet.Shape();
}

TopoDS_Shape body() {
  const TopoDS_Shape foot = BRepPrimAPI_MakeBox(kLength, kWidth, kThickness).Shape();
  const TopoDS_Shape upright = BRepPrimAPI_MakeBox(kThickness, kWidth, kHeight).Shape();
  const gp_Ax2 boss_axis(gp_Pnt(0, 0.5 * kWidth, kBossHeight), gp_Dir(1, 0, 0));
  const TopoDS_Shape boss = BRepPrimAPI_MakeCylinder(boss_axis, kBossRadius, kBossTop).Shape();
  ShapeUpgrade_UnifySameDomain unify(BRepAlgoAPI_Fuse(BRepAlgoAPI_Fuse(foot, upright).Shape(), boss).Shape());
  unify.Build();
  return unify.Shape();
}

/// A point of the boss's circle at x, away from the seam of its cylinder.
gp_Pnt on_boss(double x) {
  const double diagonal = kBossRadius * std::numbers::sqrt2 / 2.0;
  return gp_Pnt(x, 0.5 * kWidth + diagonal, kBossHeight + diagonal);
}

TopoDS_Shape along_z(double x, double y, double radius) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, y, 0), gp_Dir(0, 0, 1)), radius, kThickness).Shape();
}

TopoDS_Shape with_holes(TopoDS_Shape solid) {
  for (const double y : {10.0, 30.0}) {
    const gp_Ax2 sink(gp_Pnt(50.0, y, 3.0), gp_Dir(0, 0, 1));
    solid = BRepAlgoAPI_Cut(solid, along_z(50.0, y, 3.5)).Shape();
    solid = BRepAlgoAPI_Cut(solid, BRepPrimAPI_MakeCone(sink, 3.5, 6.5, 3.0).Shape()).Shape();
  }
  const TopoDS_Shape middle = BRepPrimAPI_MakeBox(gp_Pnt(22.0, 14.0, 0.0), gp_Pnt(30.0, 26.0, kThickness)).Shape();
  for (const TopoDS_Shape& tool : {along_z(26.0, 14.0, 4.0), along_z(26.0, 26.0, 4.0), middle})
    solid = BRepAlgoAPI_Cut(solid, tool).Shape();
  const gp_Ax2 bore(gp_Pnt(0, 0.5 * kWidth, kBossHeight), gp_Dir(1, 0, 0));
  solid = BRepAlgoAPI_Cut(solid, BRepPrimAPI_MakeCylinder(bore, 6.0, kBossTop).Shape()).Shape();
  return TopExp_Explorer(solid, TopAbs_SOLID).Current();  // a Boolean operation answers with a compound
}

}  // namespace

TopoDS_Shape bracket() {
  TopoDS_Shape solid = body();
  solid = rounded(solid, 10.0, {gp_Pnt(kLength, 0, 3), gp_Pnt(kLength, kWidth, 3)});
  solid = rounded(solid, 12.0, {gp_Pnt(3, 0, kHeight), gp_Pnt(3, kWidth, kHeight)});
  solid = rounded(solid, 8.0, {gp_Pnt(kThickness, 1, kThickness)});
  solid = rounded(solid, 4.0, {gp_Pnt(0, 1, 0)});
  solid = rounded(solid, 3.0, {on_boss(kThickness)});
  solid = rounded(solid, 2.0, {on_boss(kBossTop)});
  return with_holes(solid);
}

}  // namespace make_cad
