// What can't be read is said in one line that names the fault and the remedy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepTools.hxx>
#include <IGESControl_Writer.hxx>
#include <STEPControl_Writer.hxx>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "occ_adapter/corpus.h"
#include "occ_adapter/read_cad.h"

namespace geovor {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class BadFiles : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_ + "/" + name; }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }

  /// The message of the error, checked for its form; nothing may appear on stdout or stderr.
  static std::string message(const std::string& file) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    std::string text;
    try {
      read_cad(file);
      ADD_FAILURE() << file << " was read";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::Unreadable);
      text = error.what();
    }
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_THAT(text, HasSubstr("; ")) << "no remedy";
    EXPECT_EQ(text.find('\n'), std::string::npos);
    return text;
  }

  std::string box_as(const std::string& name) const {
    const TopoDS_Shape box = BRepPrimAPI_MakeBox(1.0, 2.0, 3.0).Shape();
    testing::internal::CaptureStdout();
    if (fs::path(name).extension() == ".step") {
      STEPControl_Writer writer;
      writer.Transfer(box, STEPControl_AsIs);
      writer.Write(path(name).c_str());
    } else if (fs::path(name).extension() == ".iges") {
      IGESControl_Writer writer("MM", 1);
      writer.AddShape(box);
      writer.Write(path(name).c_str());
    } else {
      BRepTools::Write(box, path(name).c_str());
    }
    testing::internal::GetCapturedStdout();
    std::ifstream in(path(name), std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }

  const std::string folder_ = test::scratch_folder("bad-files");
};

TEST_F(BadFiles, MissingFileIsNamedSo) { EXPECT_THAT(message(path("none.step")), HasSubstr("no such file")); }

TEST_F(BadFiles, DirectoryIsNoFile) {
  fs::create_directory(path("folder.step"));
  EXPECT_THAT(message(path("folder.step")), HasSubstr("directory"));
}

TEST_F(BadFiles, EmptyFileIsNamedSo) { EXPECT_THAT(message(write("empty.igs", "")), HasSubstr("empty")); }

TEST_F(BadFiles, UnknownEndingListsTheKnownOnes) {
  EXPECT_THAT(message(write("part.stl", "solid\n")), HasSubstr(".step, .stp, .p21, .iges, .igs or .brep"));
}

TEST_F(BadFiles, TextIsNoCadFile) {
  const std::string prose = "The quick brown fox jumps over the lazy dog.\n";
  EXPECT_THAT(message(write("text.step", prose)), HasSubstr("not a STEP file"));
  EXPECT_THAT(message(write("text.IGS", prose)), HasSubstr("not an IGES file"));
  EXPECT_THAT(message(write("text.brep", prose)), HasSubstr("not a BREP file"));
}

TEST_F(BadFiles, StepCutShortAnywhereIsSaid) {
  const std::string text = box_as("whole.step");
  ASSERT_EQ(read_cad(path("whole.step")).faces.size(), 6u);
  for (const double part : {0.1, 0.5, 0.9, 0.99}) {
    const auto length = static_cast<std::size_t>(part * static_cast<double>(text.size()));
    EXPECT_THAT(message(write("cut.step", text.substr(0, length))), HasSubstr("cut short"));
  }
}

TEST_F(BadFiles, IgesCutShortAnywhereIsSaid) {
  const std::string text = box_as("whole.iges");
  ASSERT_EQ(read_cad(path("whole.iges")).faces.size(), 6u);
  for (const double part : {0.1, 0.5, 0.9, 0.99}) {
    const auto length = static_cast<std::size_t>(part * static_cast<double>(text.size()));
    EXPECT_THAT(message(write("cut.iges", text.substr(0, length))), HasSubstr("cut short"));
  }
}

TEST_F(BadFiles, BrepCutShortAnywhereIsSaid) {
  const std::string text = box_as("whole.brep");
  ASSERT_EQ(read_cad(path("whole.brep")).faces.size(), 6u);
  for (const double part : {0.1, 0.5, 0.9, 0.99}) {
    const auto length = static_cast<std::size_t>(part * static_cast<double>(text.size()));
    EXPECT_THAT(message(write("cut.brep", text.substr(0, length))), HasSubstr("cut short"));
  }
}

TEST_F(BadFiles, StepWithDamagedDataIsRejected) {
  std::string text = box_as("whole.step");
  text.erase(text.find("DATA;") + 5, text.find("ENDSEC;", text.find("DATA;")) - text.find("DATA;") - 5);
  message(write("hollow.step", text));
}

// OpenCASCADE's own translator crashes on an axis placement whose point is no point.
TEST_F(BadFiles, StepWithAReferenceToTheWrongEntityIsRejectedWithoutACrash) {
  std::string text = box_as("whole.step");
  const std::size_t placement = text.find("AXIS2_PLACEMENT_3D('',#");
  ASSERT_NE(placement, std::string::npos);
  const std::size_t from = placement + std::string("AXIS2_PLACEMENT_3D('',").size();
  text.replace(from, text.find(',', from) - from, "#1");
  EXPECT_THAT(message(write("crossed.step", text)), HasSubstr("is damaged"));
}

TEST_F(BadFiles, ShapeWithoutFaceIsRejected) {
  BRepTools::Write(BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(1, 0, 0)).Shape(), path("edge.brep").c_str());
  EXPECT_THAT(message(path("edge.brep")), HasSubstr("no face"));
}

TEST_F(BadFiles, IgesBeyondColumn64IsExplained) {
  const std::string file = test::shared_file("corpus/mdolab+pygeo/examples__c172_wing__c172.igs");
  SKIP_WITHOUT(file);
  EXPECT_THAT(message(file), HasSubstr("column 64"));
}

TEST_F(BadFiles, EndingCountsInAnyCase) {
  box_as("whole.step");
  fs::copy_file(path("whole.step"), path("WHOLE.STP"));
  EXPECT_EQ(read_cad(path("WHOLE.STP")).faces.size(), 6u);
}

}  // namespace
}  // namespace geovor
