// Curves in STEP, read back by OpenCASCADE.
#include <gtest/gtest.h>

#include <BRepAdaptor_Curve.hxx>
#include <GCPnts_AbscissaPoint.hxx>
#include <Geom_BSplineCurve.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "occ_adapter/corpus.h"
#include "occ_adapter/write_step.h"

namespace geovor {
namespace {

/// A parabola of two pieces, with a corner between them where `corner`: z is the height of the corner.
CadCurve arch(const std::string& name, double z, bool corner = false) {
  CadCurve c;
  c.name = name;
  c.degree = 2;
  c.knots = {0, 1, 2};
  c.multiplicities = {3, corner ? 2 : 1, 3};
  c.poles = {{0, 0, z}, {1, 0, z}, {2, 1.0 / 3.0, z}, {3, 0, z}};
  if (corner) c.poles.push_back({3, -2, z});
  return c;
}

class WriteCurves : public testing::Test {
 protected:
  std::vector<TopoDS_Edge> round_trip(const std::vector<CadCurve>& curves, const std::string& unit = "mm") const {
    write_step(curves, unit, file_);
    TopTools_IndexedMapOfShape found;
    TopExp::MapShapes(test::read_by_occ(file_), TopAbs_EDGE, found);
    std::vector<TopoDS_Edge> edges;
    for (int i = 1; i <= found.Extent(); ++i) edges.push_back(TopoDS::Edge(found(i)));
    return edges;
  }
  std::string bytes() const {
    std::ostringstream text;
    text << std::ifstream(file_).rdbuf();
    return text.str();
  }
  const std::string file_ = test::scratch_folder("write-curves") + "/curves.step";
};

TEST_F(WriteCurves, KeepTheirPolesToTheLastDigit) {
  const auto edges = round_trip({arch("one", 0.1)});
  ASSERT_EQ(edges.size(), 1u);
  const BRepAdaptor_Curve curve(edges[0]);
  EXPECT_EQ(curve.GetType(), GeomAbs_BSplineCurve);
  EXPECT_EQ(curve.BSpline()->Pole(3).Y(), 1.0 / 3.0);
  EXPECT_EQ(curve.Value(curve.FirstParameter()).Z(), 0.1);
}

TEST_F(WriteCurves, AreOfTheUnitThatIsNamed) {
  const double length = GCPnts_AbscissaPoint::Length(BRepAdaptor_Curve(round_trip({arch("one", 0)}).at(0)));
  for (const auto& [unit, millimetres] : {std::pair{"m", 1000.0}, {"in", 25.4}}) {
    const auto edges = round_trip({arch("one", 0)}, unit);
    ASSERT_EQ(edges.size(), 1u);
    EXPECT_NEAR(GCPnts_AbscissaPoint::Length(BRepAdaptor_Curve(edges[0])) / (millimetres * length), 1.0, 1e-12) << unit;
  }
}

TEST_F(WriteCurves, AreEdgesOfTheirOwnWithTheirNames) {
  EXPECT_EQ(round_trip({arch("path 1", 0), arch("path 2", 1)}).size(), 2u);
  for (const char* name : {"PRODUCT('path 1','path 1'", "PRODUCT('path 2','path 2'"}) {
    EXPECT_NE(bytes().find(name), std::string::npos) << name;
  }
}

TEST_F(WriteCurves, KeepTheirCorners) {
  const auto edges = round_trip({arch("one", 0, true)});
  ASSERT_EQ(edges.size(), 1u);
  const BRepAdaptor_Curve curve(edges[0]);
  EXPECT_NEAR(curve.Value(1.0).Distance(gp_Pnt(2, 1.0 / 3.0, 0)), 0.0, 1e-15);
  EXPECT_EQ(curve.Continuity(), GeomAbs_C0);
}

TEST_F(WriteCurves, GiveTheSameBytesForTheSameCurves) {
  write_step(std::vector{arch("one", 0)}, "mm", file_);
  const std::string first = bytes();
  write_step(std::vector{arch("other", 1)}, "in", file_);
  write_step(std::vector{arch("one", 0)}, "mm", file_);
  EXPECT_EQ(bytes(), first);
}

TEST_F(WriteCurves, ThatCannotBeWrittenLeaveNoFile) {
  CadCurve lost = arch("lost", std::nan(""));
  CadCurve short_of_poles = arch("short", 0);
  short_of_poles.poles.pop_back();
  for (const std::vector<CadCurve>& curves : {std::vector<CadCurve>{}, {lost}, {short_of_poles}}) {
    EXPECT_THROW(write_step(curves, "mm", file_), Error);
    EXPECT_FALSE(std::filesystem::exists(file_));
    EXPECT_FALSE(std::filesystem::exists(file_ + ".part"));
  }
}

}  // namespace
}  // namespace geovor
