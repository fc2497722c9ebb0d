// Faceted STEP and BREP, read back by OpenCASCADE.
#include <gtest/gtest.h>

#include <BRepBndLib.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Bnd_Box.hxx>
#include <Eigen/Geometry>
#include <GProp_GProps.hxx>
#include <TopExp_Explorer.hxx>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "base/error.h"
#include "io/mesh_writers.h"
#include "occ_adapter/corpus.h"
#include "occ_adapter/occ_write_private.h"
#include "occ_adapter/read_cad.h"
#include "occ_adapter/write_brep.h"

namespace geovor {
namespace {

namespace fs = std::filesystem;

TriangleMesh tetrahedron() {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  mesh.face_of = {1, 2, 3, 4};
  return mesh;
}

/// The unit cube moved by `shift`; its twelve triangles look outwards.
TriangleMesh cube(const Xyz& shift) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.points.push_back(shift + Xyz(i & 1, (i >> 1) & 1, i >> 2));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  mesh.face_of.assign(12, 1);
  return mesh;
}

/// A sphere by longitude and latitude, 2 n (n - 1) triangles.
TriangleMesh sphere(int n) {
  using std::numbers::pi;
  TriangleMesh mesh;
  mesh.points.push_back({0, 0, -1});
  for (int j = 1; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const double v = pi * j / n - pi / 2, u = 2 * pi * i / n;
      mesh.points.push_back({std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v)});
    }
  }
  mesh.points.push_back({0, 0, 1});
  const auto at = [n](int i, int j) { return 1 + (j - 1) * n + i % n; };
  const int top = static_cast<int>(mesh.points.size()) - 1;
  for (int i = 0; i < n; ++i) {
    mesh.triangles.push_back({0, at(i + 1, 1), at(i, 1)});
    mesh.triangles.push_back({top, at(i, n - 1), at(i + 1, n - 1)});
    for (int j = 1; j < n - 1; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  mesh.face_of.assign(mesh.triangles.size(), 1);
  return mesh;
}

void write_step(const LabelledMesh& mesh, const std::string& file) {
  write_file(file, [&](ByteStream& out) { put_step_facets(mesh, out); });
}

void write_step(const TriangleMesh& mesh, const std::string& unit, const std::string& file) {
  write_step({.mesh = mesh, .unit = unit}, file);
}

double six_volumes(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const auto p = [&](int k) { return mesh.points[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])]; };
    sum += p(0).dot(p(1).cross(p(2)));
  }
  return sum;
}

double volume(const TopoDS_Shape& shape) {
  GProp_GProps props;
  BRepGProp::VolumeProperties(shape, props);
  return props.Mass();
}

int count(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  int n = 0;
  for (TopExp_Explorer walk(shape, kind); walk.More(); walk.Next()) ++n;
  return n;
}

class WriteStep : public testing::Test {
 protected:
  TopoDS_Shape round_trip(const TriangleMesh& mesh, const std::string& unit = "mm") const {
    write_step(mesh, unit, file_);
    EXPECT_FALSE(fs::exists(file_ + ".part"));
    return test::read_by_occ(file_);
  }
  std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }
  const std::string folder_ = test::scratch_folder("write-step");
  const std::string file_ = folder_ + "/mesh.step";
};

TEST_F(WriteStep, TetrahedronIsAValidSolidOfItsVolume) {
  const TopoDS_Shape read = round_trip(tetrahedron());
  EXPECT_TRUE(BRepCheck_Analyzer(read).IsValid());
  EXPECT_EQ(count(read, TopAbs_SOLID), 1);
  EXPECT_EQ(count(read, TopAbs_FACE), 4);
  EXPECT_NEAR(volume(read), 1.0, 1e-12);
}

TEST_F(WriteStep, CubeTurnedInsideOutIsStillPositive) {
  TriangleMesh mesh = cube({5, 0, 0});
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  // Before the writer and the reader, which turn solids themselves.
  const TopoDS_Shape built = occ::facet_shape(mesh);
  EXPECT_TRUE(BRepCheck_Analyzer(built).IsValid());
  EXPECT_NEAR(volume(built), 1.0, 1e-12);
  const TopoDS_Shape read = round_trip(mesh);
  EXPECT_TRUE(BRepCheck_Analyzer(read).IsValid());
  EXPECT_NEAR(volume(read), 1.0, 1e-12);
}

TEST_F(WriteStep, SeparateCubesBecomeSeparateSolids) {
  TriangleMesh mesh = cube({0, 0, 0});
  const TriangleMesh other = cube({3, 0, 0});
  for (auto triangle : other.triangles) {
    for (int& corner : triangle) corner += 8;
    mesh.triangles.push_back(triangle);
  }
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  mesh.face_of.assign(24, 1);
  const TopoDS_Shape read = round_trip(mesh);
  EXPECT_TRUE(BRepCheck_Analyzer(read).IsValid());
  EXPECT_EQ(count(read, TopAbs_SOLID), 2);
  EXPECT_EQ(count(read, TopAbs_FACE), 24);
  EXPECT_NEAR(volume(read), 2.0, 1e-12);
}

TEST_F(WriteStep, OpenMeshBecomesAShell) {
  TriangleMesh mesh = cube({0, 0, 0});
  mesh.triangles.pop_back();
  mesh.face_of.pop_back();
  const TopoDS_Shape read = round_trip(mesh);
  EXPECT_TRUE(BRepCheck_Analyzer(read).IsValid());
  EXPECT_EQ(count(read, TopAbs_SOLID), 0);
  EXPECT_EQ(count(read, TopAbs_SHELL), 1);
  EXPECT_EQ(count(read, TopAbs_FACE), 11);
}

TEST_F(WriteStep, UnitIsThatOfTheMesh) {
  const std::pair<const char*, double> units[] = {
      {"mm", 1.0}, {"m", 1000.0}, {"in", 25.4}, {"cm", 10.0}, {"ft", 304.8}};
  for (const auto& [unit, millimetres] : units) {
    const TopoDS_Shape read = round_trip(tetrahedron(), unit);
    Bnd_Box box;
    BRepBndLib::Add(read, box, false);
    box.SetGap(0.0);
    EXPECT_NEAR(box.CornerMax().X(), 1.0 * millimetres, 1e-9 * millimetres) << unit;
    EXPECT_NEAR(box.CornerMax().Y(), 2.0 * millimetres, 1e-9 * millimetres) << unit;
    EXPECT_NEAR(box.CornerMax().Z(), 3.0 * millimetres, 1e-9 * millimetres) << unit;
  }
}

TEST_F(WriteStep, CoordinatesInTheFileAreThoseOfTheMeshInAnyUnit) {
  TriangleMesh mesh = tetrahedron();
  mesh.points[1] = {0.1, 0, 0};
  for (const char* unit : {"mm", "m", "in"}) {
    write_step(mesh, unit, file_);
    EXPECT_NE(bytes().find("CARTESIAN_POINT('',(0.1,0.,0.))"), std::string::npos) << unit;
  }
}

TEST_F(WriteStep, SphereIsReadBackAsAClosedShell) {
  const TriangleMesh mesh = sphere(36);
  write_step(mesh, "mm", file_);
  const CadModel model = read_cad(file_);
  EXPECT_EQ(model.faces.size(), mesh.triangles.size());
  ASSERT_EQ(model.shells.size(), 1u);
  EXPECT_TRUE(model.shells[0].closed);
}

TEST_F(WriteStep, SphereIsValidAndKeepsTheVolumeOfItsTriangles) {
  const TriangleMesh mesh = sphere(24);
  const TopoDS_Shape read = round_trip(mesh);
  EXPECT_TRUE(BRepCheck_Analyzer(read).IsValid());
  EXPECT_NEAR(volume(read), six_volumes(mesh) / 6.0, 1e-10);
}

TEST_F(WriteStep, SameMeshGivesTheSameBytes) {
  write_step(tetrahedron(), "mm", file_);
  const std::string first = bytes();
  write_step(cube({0, 0, 0}), "mm", file_);
  write_step(tetrahedron(), "mm", file_);
  EXPECT_EQ(bytes(), first);
}

TEST_F(WriteStep, FacesKeepTheNamesAndColoursOfTheCad) {
  const TriangleMesh mesh = tetrahedron();
  const std::array<double, 3> orange = {1.0, 0.25, 0.01};  // linear
  const std::string odd = "Bohrung \xc3\x98 5 'H7' \xf0\x9f\x94\xa9";
  write_step({.mesh = mesh, .labels = {{1, odd, orange}, {2, "side", {}}, {3, "side", {}}}}, file_);
  const CadModel model = read_cad(file_);
  ASSERT_EQ(model.faces.size(), 4u);
  const char* const names[] = {odd.c_str(), "side_Face2", "side_Face3", "Face4"};
  for (std::size_t f = 0; f < 4; ++f) EXPECT_EQ(model.faces[f].name, names[f]);
  ASSERT_TRUE(model.faces[0].colour.has_value());
  EXPECT_NEAR(model.faces[0].colour->r, orange[0], 1e-6);
  EXPECT_NEAR(model.faces[0].colour->g, orange[1], 1e-6);
  EXPECT_NEAR(model.faces[0].colour->b, orange[2], 1e-6);
  EXPECT_FALSE(model.faces[1].colour.has_value());
}

TEST_F(WriteStep, ASolidBesideAnOpenSheetKeepsBoth) {
  TriangleMesh mesh = tetrahedron();
  mesh.points.insert(mesh.points.end(), {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}});
  mesh.triangles.push_back({4, 5, 6});
  mesh.face_of.push_back(5);
  const TopoDS_Shape read = round_trip(mesh);
  EXPECT_TRUE(BRepCheck_Analyzer(read).IsValid());
  EXPECT_EQ(count(read, TopAbs_SOLID), 1);
  EXPECT_EQ(count(read, TopAbs_FACE), 5);
}

TEST_F(WriteStep, BrepIsAValidSolidWithTheSameCoordinates) {
  const TriangleMesh mesh = sphere(12);
  const std::string file = folder_ + "/mesh.brep";
  write_brep(mesh, file);
  TopoDS_Shape read;
  ASSERT_TRUE(BRepTools::Read(read, file.c_str(), BRep_Builder()));
  EXPECT_TRUE(BRepCheck_Analyzer(read).IsValid());
  EXPECT_EQ(count(read, TopAbs_SOLID), 1);
  EXPECT_EQ(count(read, TopAbs_FACE), static_cast<int>(mesh.triangles.size()));
  EXPECT_NEAR(volume(read), six_volumes(mesh) / 6.0, 1e-10);
  EXPECT_THROW(write_brep(mesh, folder_ + "/no/such/folder/mesh.brep"), Error);
}

void expect_unwritable(const TriangleMesh& mesh, const std::string& unit, const std::string& file) {
  try {
    write_step(mesh, unit, file);
    ADD_FAILURE() << "was written";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::Unwritable);
    EXPECT_NE(std::string(error.what()).find("; "), std::string::npos);
  }
  EXPECT_FALSE(fs::exists(file));
  EXPECT_FALSE(fs::exists(file + ".part"));
}

TEST_F(WriteStep, WhatCannotBeWrittenLeavesNoFile) {
  expect_unwritable(tetrahedron(), "mm", folder_ + "/no/such/folder/mesh.step");
  expect_unwritable(tetrahedron(), "parsec", file_);
  TriangleMesh flat = tetrahedron();
  flat.points[3] = {0.5, 1.0, 0.0};
  expect_unwritable(flat, "mm", file_);
}

}  // namespace
}  // namespace geovor
