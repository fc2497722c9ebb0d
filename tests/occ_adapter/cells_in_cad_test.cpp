// The cells of diagrams as STEP faces, read back by OpenCASCADE alone: its checker and its areas are the referees.
#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <GProp_GProps.hxx>
#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <optional>
#include <random>
#include <regex>
#include <sstream>

#include "occ_adapter/corpus.h"
#include "occ_adapter/read_cad.h"
#include "occ_adapter/write_cells.h"
#include "pipeline/cad_cells.h"
#include "pipeline/voronoi_face.h"

namespace geovor {
namespace {

using std::numbers::pi;

using Places = std::vector<std::variant<Uv, Xyz>>;

double area_by_occ(const TopoDS_Shape& shape) {
  constexpr double kRelativeError = 1e-9;
  GProp_GProps props;
  BRepGProp::SurfaceProperties(shape, props, kRelativeError);
  return props.Mass();
}

int wires_of(const TopoDS_Face& face) {
  int count = 0;
  for (TopExp_Explorer walk(face, TopAbs_WIRE); walk.More(); walk.Next()) ++count;
  return count;
}

/// (u, v, sum of 3 exp(-r^2 / 0.18) about the centres) on [-2,2]^2, interpolated.
TopoDS_Face bumps(const std::vector<Uv>& centres) {
  constexpr int kPoints = 61;
  constexpr double kStep = 4.0 / (kPoints - 1);
  TColStd_Array2OfReal z(1, kPoints, 1, kPoints);
  for (int i = 0; i < kPoints; ++i) {
    for (int k = 0; k < kPoints; ++k) {
      double sum = 0.0;
      for (const Uv c : centres) {
        sum += 3.0 * std::exp(-(std::pow(-2.0 + i * kStep - c.u, 2) + std::pow(-2.0 + k * kStep - c.v, 2)) / 0.18);
      }
      z(i + 1, k + 1) = sum;
    }
  }
  GeomAPI_PointsToBSplineSurface spline;
  spline.Interpolate(z, -2.0, kStep, -2.0, kStep);
  return BRepBuilderAPI_MakeFace(spline.Surface(), Precision::Confusion()).Face();
}

/// (10 (3 u^2 - 2 u^3), 10 v, 8 v (1 - v)), a piece of a parabolic cylinder: Su = 0 where u is 0 or 1. `power`: (10
/// u^3,
/// ...), where Suu is 0 as well.
TopoDS_Face stretched_sheet(bool power) {
  TColgp_Array2OfPnt poles(1, 4, 1, 3);
  for (int i = 1; i <= 4; ++i) {
    const double x = i == 4 || (i == 3 && !power) ? 10.0 : 0.0;
    for (int k = 1; k <= 3; ++k) poles(i, k) = gp_Pnt(x, 5.0 * (k - 1), k == 2 ? 4.0 : 0.0);
  }
  const TopoDS_Face bezier = BRepBuilderAPI_MakeFace(new Geom_BezierSurface(poles), Precision::Confusion()).Face();
  return TopoDS::Face(BRepBuilderAPI_NurbsConvert(bezier).Shape());
}

class CellsInCad : public testing::Test {
 protected:
  std::string sample(const std::string& name) const { return std::string(GEOVOR_SOURCE_DIR) + "/samples/cad/" + name; }

  std::string file_of(const TopoDS_Shape& shape) const {
    const std::string path = folder_ + "/input.brep";
    BRepTools::Write(shape, path.c_str());
    return path;
  }

  /// Valid, named, as many as sites (or as `count`), together as large as the face (OpenCASCADE's area of the original
  /// face where `area` is 0). Returns the faces as read back.
  std::vector<TopoDS_Face> expect_faces(const std::string& file, int number, const VoronoiRequest& request,
                                        double area = 0.0, std::optional<std::size_t> count = {}) const {
    const CadModel model = read_cad(file);
    const CadFace& face = model.faces[static_cast<std::size_t>(number - 1)];
    const VoronoiResult result = voronoi_face(model, face, request);
    const std::string path = folder_ + "/cells.step";
    write_step(cad_cells(model, face, result.diagram, result.deflection), {file, number, model.unit}, path);
    std::vector<TopoDS_Face> faces = test::faces_of(test::read_by_occ(path));
    const std::size_t sites = result.diagram.sites.size();
    EXPECT_EQ(faces.size(), count.value_or(sites));
    double sum = 0.0;
    for (const TopoDS_Face& cell : faces) {
      EXPECT_TRUE(BRepCheck_Analyzer(cell).IsValid());
      const double own = area_by_occ(cell);
      EXPECT_GT(own, 0.0);
      sum += own;
    }
    if (area == 0.0) area = area_by_occ(test::faces_of(test::read_by_occ(file))[static_cast<std::size_t>(number - 1)]);
    EXPECT_NEAR(sum / area, 1.0, 1e-6);
    expect_names(path, sites, !count);
    return faces;
  }

  /// Each site's name in the text of the file, on one face or on some.
  static void expect_names(const std::string& path, std::size_t sites, bool one) {
    std::ifstream in(path);
    std::stringstream text;
    text << in.rdbuf();
    std::string all = text.str();
    std::erase(all, '\n');
    for (std::size_t i = 0; i < sites; ++i) {
      const std::regex named("ADVANCED_FACE\\('site " + std::to_string(i) + "'");
      const auto uses = std::distance(std::sregex_iterator(all.begin(), all.end(), named), std::sregex_iterator());
      EXPECT_TRUE(uses == 1 || (uses > 1 && !one)) << uses << " faces of site " << i;
    }
  }

  static VoronoiRequest at(Places places) {
    VoronoiRequest request;
    request.sites = std::move(places);
    request.snap = true;  // places in space name a parameter pair only
    return request;
  }
  static VoronoiRequest placed(int count) {
    VoronoiRequest request;
    request.count = count;
    return request;
  }

  const std::string folder_ = test::scratch_folder("cells-in-cad");
};

int with_wires(const std::vector<TopoDS_Face>& faces, int wires) {
  return static_cast<int>(
      std::count_if(faces.begin(), faces.end(), [&](const TopoDS_Face& face) { return wires_of(face) == wires; }));
}

// E1 of the design notes: one cell floods around another, whose border is one edge from a corner back to it.
TEST_F(CellsInCad, AnIslandIsAHoleOfTheCellAroundIt) {
  const auto faces = expect_faces(file_of(bumps({{0, 0}})), 1, at({Xyz(1.2, 0, 0.001), Xyz(0, 0, 3)}));
  EXPECT_EQ(with_wires(faces, 2), 1);
}

// E2, the paper's figure 6.
TEST_F(CellsInCad, TwoIslandsAreTwoHoles) {
  const auto faces = expect_faces(sample("bumps.step"), 1, at({Uv{0, -1}, Uv{-1, 0.2}, Uv{1, 0.2}}));
  EXPECT_EQ(with_wires(faces, 3), 1);
}

// E3: the island's neighbours are two.
TEST_F(CellsInCad, AnIslandBetweenTwoCells) {
  expect_faces(file_of(bumps({{0, 0}})), 1, at({Xyz(0.9, 0.25, 0), Xyz(-1.8, -1.6, 0), Xyz(0.1, 0.05, 2.8)}));
}

TEST_F(CellsInCad, APlateWithHolesIsCovered) {
  const double area = 100.0 * 60.0 - 4 * 16 * pi - 100 * pi - (24.0 * 12.0 + 36 * pi);
  for (int count : {1, 2, 7}) expect_faces(sample("plate.step"), 3, placed(count), area);
  // Distances are those of the plane: behind the slot a cell has a part of its own.
  expect_faces(sample("plate.step"), 3, placed(25), area, 26);
}

TEST_F(CellsInCad, TwoCellsOfASphereAreTwoFacesWhereverItsSeamIs) {
  const double area = 400.0 * pi;
  expect_faces(sample("sphere.step"), 1, placed(1), area);
  std::mt19937 random(11);
  std::normal_distribution<double> coordinate;
  for (int i = 0; i < 6; ++i) {
    const auto place = [&] {
      return Xyz(10.0 * Xyz(coordinate(random), coordinate(random), coordinate(random)).normalized());
    };
    expect_faces(sample("sphere.step"), 1, at({place(), place()}), area);
  }
}

TEST_F(CellsInCad, SphericalCellsAreFacesAcrossSeamAndPoles) {
  const double area = 400.0 * pi;
  expect_faces(sample("sphere.step"), 1, placed(7), area);
  expect_faces(sample("sphere.step"), 1, at({Xyz(0, 0, 10), Xyz(0, 0, -10), Xyz(10, 0, 0), Xyz(-10, 0, 0)}), area);
}

TEST_F(CellsInCad, CellsThatWindAroundATorusAreOneFaceEach) {
  const double area = 480.0 * pi * pi;
  for (int count : {1, 2, 3, 12}) expect_faces(sample("torus.step"), 1, placed(count), area);
}

TEST_F(CellsInCad, CellsThatRingATubeAreOneFaceEach) {
  const double area = 600.0 * pi;
  for (int count : {2, 3, 9}) expect_faces(sample("cylinder_tube.step"), 1, placed(count), area);
  // One above the other, off the seam and on it.
  expect_faces(sample("cylinder_tube.step"), 1, at({Xyz(0, 10, 10), Xyz(0, 10, 20)}), area);
  expect_faces(sample("cylinder_tube.step"), 1, at({Xyz(10, 0, 10), Xyz(10, 0, 20)}), area);
}

// Two vertices are 1e-8 apart: one point for CAD programs, and the edge between them none.
TEST_F(CellsInCad, AnEdgeShorterThanAPointIsLeftOut) {
  expect_faces(sample("flat.step"), 1, at({Uv{1, 0}, Uv{-1, 0}, Uv{0, 1}, Uv{0, -1 - 1e-8}}), 36.0);
}

// STEP knows no periodic splines, so no face runs across the seam of one.
TEST_F(CellsInCad, AcrossTheSeamOfASplineACellIsTwoFaces) {
  const TopoDS_Shape tube = test::read_by_occ(sample("cylinder_tube.step"));
  const std::string spline = file_of(BRepBuilderAPI_NurbsConvert(tube).Shape());
  expect_faces(spline, 1, at({Xyz(10, 0, 15), Xyz(-10, 0, 15)}), 600.0 * pi, 3);
}

// The two sides at Su = 0 are places apart, though by the metric of one the other is near.
TEST_F(CellsInCad, ASideOnWhichTheParametersStandStillIsNoOtherSide) {
  for (bool power : {false, true}) {
    const std::string file = file_of(stretched_sheet(power));
    for (int count : {1, 2, 5}) expect_faces(file, 1, placed(count));
  }
}

class StretchedFamilies : public CellsInCad, public testing::WithParamInterface<const char*> {};

TEST_P(StretchedFamilies, CellsAreFaces) {
  const std::string file = test::shared_file(GetParam());
  if (file.empty()) {
    if (const char* ci = std::getenv("CI"); ci != nullptr && std::string(ci) == "true") FAIL() << GetParam();
    GTEST_SKIP() << GetParam() << " is not there; set GEOVOR_SHARED";
  }
  expect_faces(file, 1, placed(4));
}

INSTANTIATE_TEST_SUITE_P(Shared, StretchedFamilies,
                         testing::Values("faces/pl_pow3u.step", "faces/pl_smooth.step", "faces/cyl_pow3uv.step",
                                         "faces/tor_pow3u.step", "faces/sph_smooth.step"));

}  // namespace
}  // namespace geovor
