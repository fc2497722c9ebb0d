#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Ax2.hxx>

#include "make_cad/shapes.h"

namespace make_cad {

namespace {

TopoDS_Shape drill(double x, double y, double radius, double depth) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, y, 0), gp_Dir(0, 0, 1)), radius, depth).Shape();
}

/// A rounded slot along x between the two centres.
TopoDS_Shape slot(double x0, double x1, double y, double radius, double depth) {
  const TopoDS_Shape middle = BRepPrimAPI_MakeBox(gp_Pnt(x0, y - radius, 0), gp_Pnt(x1, y + radius, depth)).Shape();
  const TopoDS_Shape one = BRepAlgoAPI_Fuse(middle, drill(x0, y, radius, depth)).Shape();
  const TopoDS_Shape both = BRepAlgoAPI_Fuse(one, drill(x1, y, radius, depth)).Shape();
  ShapeUpgrade_UnifySameDomain unify(both);
  unify.Build();
  return unify.Shape();
}

}  // namespace

TopoDS_Shape cylinder() { return BRepPrimAPI_MakeCylinder(10.0, 30.0).Shape(); }

TopoDS_Shape cylinder_tube() { return BRepPrimAPI_MakeCylinder(10.0, 30.0).Cylinder().LateralFace(); }

TopoDS_Shape sphere() { return BRepPrimAPI_MakeSphere(10.0).Shape(); }

TopoDS_Shape torus() { return BRepPrimAPI_MakeTorus(20.0, 6.0).Shape(); }

TopoDS_Shape cone() { return BRepPrimAPI_MakeCone(8.0, 0.0, 15.0).Shape(); }

TopoDS_Shape plate() {
  constexpr double kThickness = 8.0;
  TopoDS_Shape solid = BRepPrimAPI_MakeBox(100.0, 60.0, kThickness).Shape();
  for (const double x : {10.0, 90.0})
    for (const double y : {10.0, 50.0}) solid = BRepAlgoAPI_Cut(solid, drill(x, y, 4.0, kThickness)).Shape();
  solid = BRepAlgoAPI_Cut(solid, drill(30.0, 30.0, 10.0, kThickness)).Shape();
  solid = BRepAlgoAPI_Cut(solid, slot(56.0, 80.0, 30.0, 6.0, kThickness)).Shape();
  return TopExp_Explorer(solid, TopAbs_SOLID).Current();  // a Boolean operation answers with a compound
}

}  // namespace make_cad
