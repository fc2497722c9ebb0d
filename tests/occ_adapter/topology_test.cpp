// Shells, numbers, names, colours, units and boxes of files whose truth is known.
#include <gtest/gtest.h>

#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepTools.hxx>
#include <Eigen/Geometry>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

#include <algorithm>

#include "occ_adapter/corpus.h"
#include "occ_adapter/read_cad.h"

namespace geovor {
namespace {

void expect_every_edge_used_twice(const CadModel& model) {
  std::vector<int> forward(model.edges.size(), 0), backward(model.edges.size(), 0);
  for (const CadFace& face : model.faces) {
    for (const TrimLoop& loop : face.loops) {
      for (const Coedge& coedge : loop.coedges) {
        ++(coedge.reversed != face.reversed ? backward : forward)[static_cast<std::size_t>(coedge.edge)];
      }
    }
  }
  for (std::size_t i = 0; i < model.edges.size(); ++i) {
    if (model.edges[i].degenerate()) continue;
    EXPECT_EQ(forward[i], 1) << "edge " << i;
    EXPECT_EQ(backward[i], 1) << "edge " << i;
  }
}

class ClosedFiles : public testing::TestWithParam<const char*> {};

TEST_P(ClosedFiles, ShellsAreClosedAndEdgesUsedInBothDirections) {
  const std::string path = test::shared_file(GetParam());
  SKIP_WITHOUT(path);
  const CadModel model = read_cad(path);
  for (const CadShell& shell : model.shells) EXPECT_TRUE(shell.closed);
  expect_every_edge_used_twice(model);
  for (std::size_t i = 0; i < model.faces.size(); ++i) EXPECT_EQ(model.faces[i].number, static_cast<int>(i) + 1);
}

INSTANTIATE_TEST_SUITE_P(Corpus, ClosedFiles,
                         testing::Values("corpus/debian-netgen-doc/usr__share__doc__netgen__examples__frame.step",
                                         "corpus/Open-Cascade-SAS+OCCT/data__step__linkrods.step",
                                         "corpus/LLNL+axom_data/quest__step__revolved_sphere.step",
                                         "corpus/Open-Cascade-SAS+OCCT/data__occ__Motor-c.brep", "faces/ftor_orig.step",
                                         "faces/fsph_seam37.step"));

TEST(Topology, OpenSheetIsNotClosed) {
  const std::string path = test::shared_file("corpus/dealii+dealii/tests__opencascade__step_files__wigley.step");
  SKIP_WITHOUT(path);
  const CadModel model = read_cad(path);
  ASSERT_EQ(model.shells.size(), 1u);
  EXPECT_FALSE(model.shells[0].closed);
}

TEST(Topology, BoxHasTwelveEdgesAndEightVerticesWithNormalsOutwards) {
  const std::string file = test::scratch_folder("topology") + "/box.brep";
  BRepTools::Write(BRepPrimAPI_MakeBox(1.0, 2.0, 3.0).Shape(), file.c_str());
  const CadModel model = read_cad(file);
  EXPECT_EQ(model.edges.size(), 12u);
  EXPECT_EQ(model.vertices.size(), 8u);
  for (const CadFace& face : model.faces) {
    Xyz middle = Xyz::Zero();
    for (const Coedge& coedge : face.loops[0].coedges) {
      const CadEdge& edge = model.edges[static_cast<std::size_t>(coedge.edge)];
      middle += 0.25 * edge.curve->position(edge.range.middle());
    }
    const SurfaceJet jet = face.surface->jet({0, 0});
    const Xyz normal = (face.reversed ? -1.0 : 1.0) * jet.Su.cross(jet.Sv);
    EXPECT_GT(normal.dot(middle - Xyz(0.5, 1.0, 1.5)), 0.0) << "Face" << face.number;
  }
}

/// A file of a box of 1 x 2 x 3 mm that states `unit`.
std::string box_in(const char* unit, const std::string& ending) {
  const std::string file = test::scratch_folder("topology") + "/box" + ending;
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1.0, 2.0, 3.0).Shape();
  testing::internal::CaptureStdout();
  if (ending == ".step") {
    STEPControl_Controller::Init();
    Interface_Static::SetCVal("write.step.unit", unit);
    STEPControl_Writer writer;
    writer.Transfer(box, STEPControl_AsIs);
    writer.Write(file.c_str());
    Interface_Static::SetCVal("write.step.unit", "MM");
  } else {
    IGESControl_Writer writer(unit, 1);
    writer.AddShape(box);
    writer.Write(file.c_str());
  }
  testing::internal::GetCapturedStdout();
  return file;
}

// IGES writes ten digits.
constexpr double kTextRounding = 1e-7;

TEST(Units, LengthsAreMillimetresWhateverTheFileStates) {
  for (const char* ending : {".step", ".iges"}) {
    for (const char* unit : {"MM", "INCH", "M"}) {
      const CadModel model = read_cad(box_in(unit, ending));
      EXPECT_EQ(model.unit, "mm");
      EXPECT_FALSE(model.file_unit.empty());
      EXPECT_LE((model.upper - model.lower - Xyz(1, 2, 3)).norm(), kTextRounding) << unit << ending;
    }
  }
}

TEST(BoundingBox, IsThatOfTheSurfaceNotOfItsPoles) {
  const std::string path = test::shared_file("faces/ftor_nurbs.step");
  SKIP_WITHOUT(path);
  const std::string exact = test::shared_file("faces/ftor_orig.step");
  const CadModel spline = read_cad(path), torus = read_cad(exact);
  EXPECT_LE((spline.lower - torus.lower).norm() + (spline.upper - torus.upper).norm(), 1e-6);
}

TEST(BoundingBox, OfATorusIsItsRadii) {
  const std::string file = test::scratch_folder("topology") + "/torus.brep";
  BRepTools::Write(BRepPrimAPI_MakeTorus(5.0, 2.0).Shape(), file.c_str());
  const CadModel model = read_cad(file);
  EXPECT_LE((model.lower - Xyz(-7, -7, -2)).norm() + (model.upper - Xyz(7, 7, 2)).norm(), 1e-6);
}

TEST(Labels, NameAndColourOfAFaceComeOutOfStep) {
  Handle(TDocStd_Document) document;
  XCAFApp_Application::GetApplication()->NewDocument("BinXCAF", document);
  const auto shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const auto colours = XCAFDoc_DocumentTool::ColorTool(document->Main());
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1.0, 2.0, 3.0).Shape();
  const TDF_Label part = shapes->AddShape(box, false);
  const TDF_Label face = shapes->AddSubShape(part, test::faces_of(box)[2]);
  TDataStd_Name::Set(face, "inlet");
  colours->SetColor(part, Quantity_Color(0.0, 0.0, 1.0, Quantity_TOC_RGB), XCAFDoc_ColorSurf);
  colours->SetColor(face, Quantity_Color(1.0, 0.0, 0.0, Quantity_TOC_RGB), XCAFDoc_ColorSurf);
  const std::string file = test::scratch_folder("topology") + "/labels.step";
  testing::internal::CaptureStdout();
  STEPCAFControl_Writer writer;
  Interface_Static::SetIVal("write.stepcaf.subshapes.name", 1);
  writer.Transfer(document, STEPControl_AsIs);
  writer.Write(file.c_str());
  testing::internal::GetCapturedStdout();
  const CadModel model = read_cad(file);
  ASSERT_EQ(model.faces.size(), 6u);
  for (const CadFace& read : model.faces) {
    ASSERT_TRUE(read.colour.has_value());
    EXPECT_NEAR(read.colour->r, read.number == 3 ? 1.0 : 0.0, 1e-3);
    EXPECT_NEAR(read.colour->b, read.number == 3 ? 0.0 : 1.0, 1e-3);
    EXPECT_EQ(read.name, read.number == 3 ? "inlet" : "");
  }
}

}  // namespace
}  // namespace geovor
