// One tetrahedron in every format that is read, as other programs write it.
#include "io/read_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "mesh/mesh_checks.h"

namespace geovor {
namespace {

class ReadMesh : public ::testing::Test {
 protected:
  ReadMesh() { std::filesystem::create_directories(folder_); }
  ~ReadMesh() override { std::filesystem::remove_all(folder_); }

  LoadedMesh read(const std::string& name, const std::string& bytes) {
    const std::string path = (folder_ / name).string();
    std::ofstream(path, std::ios::binary) << bytes;
    return read_mesh(path);
  }
  std::string refusal(const std::string& name, const std::string& bytes) {
    try {
      read(name, bytes);
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ErrorCode::Unreadable);
      return e.what();
    }
    return "";
  }
  /// Four points, four triangles, a volume of 1/6, outwards.
  void expect_tetrahedron(const LoadedMesh& l) {
    EXPECT_EQ(first_fault(l.mesh), std::nullopt);
    EXPECT_EQ(l.mesh.points.size(), 4u);
    EXPECT_TRUE(topology(l.mesh).closed());
    EXPECT_NEAR(quality(l.mesh).volume, 1.0 / 6, 1e-15);
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) /
      (std::string("geovor-") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

const float kCorners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const int kTriangles[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

template <typename T>
void append(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

std::string binary_stl() {
  std::string bytes(80, 's');
  append<std::uint32_t>(bytes, 4);
  for (const auto& t : kTriangles) {
    for (int i = 0; i < 3; ++i) append<float>(bytes, 0.0F);
    for (const int c : t) {
      for (const float x : kCorners[c]) append<float>(bytes, x);
    }
    append<std::uint16_t>(bytes, 0);
  }
  return bytes;
}

std::string text_stl(const std::string& name, std::initializer_list<int> triangles) {
  std::string text = "solid " + name + "\n";
  for (const int t : triangles) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const int c : kTriangles[t]) {
      text += "   vertex";
      for (const float x : kCorners[c]) text += x > 0 ? " 1.000000e+00" : " 0";
      text += "\n";
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid " + name + "\n";
}

TEST_F(ReadMesh, BinaryStlIsWeldedAndOfSinglePrecision) {
  const LoadedMesh l = read("a.stl", binary_stl());
  expect_tetrahedron(l);
  EXPECT_EQ(l.precision, "single precision");
  EXPECT_NEAR(l.rounding, std::numbers::sqrt3 * std::pow(2.0, -24), 1e-15);
}

TEST_F(ReadMesh, BinaryStlWhoseHeaderSaysSolidIsBinary) {
  std::string bytes = binary_stl();
  bytes.replace(0, 5, "solid");
  expect_tetrahedron(read("a.stl", bytes));
}

TEST_F(ReadMesh, TextStlOfSeveralSolidsHasGroups) {
  const LoadedMesh l = read("A.STL", text_stl("base", {0}) + text_stl("roof", {1, 2, 3}));
  expect_tetrahedron(l);
  EXPECT_EQ(l.groups, (std::vector<std::string>{"base", "roof"}));
  EXPECT_EQ(l.mesh.face_of, (std::vector{0, 1, 1, 1}));
}

TEST_F(ReadMesh, StlCutShortIsAnError) {
  EXPECT_NE(refusal("a.stl", binary_stl().substr(0, 200)), "");
  EXPECT_NE(refusal("a.stl", text_stl("a", {0, 1}).substr(0, 150)), "");
}

TEST_F(ReadMesh, ObjWithGroupsSlashesAndNegativeNumbers) {
  const LoadedMesh l = read("a.obj",
                            "# a comment\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\ng Face1\nf 1//1 3//1 2//1\n"
                            "g Face2\nf 1/1/1 2/1/1 4/1/1\nf -3 -2 -1\nl 1 2\nf 3 1 4\n");
  expect_tetrahedron(l);
  EXPECT_EQ(l.groups, (std::vector<std::string>{"Face1", "Face2"}));
  EXPECT_EQ(l.other_elements, 1);
  EXPECT_EQ(l.precision, "double precision");
}

TEST_F(ReadMesh, PointsThatAnObjKeepsApartStayApart) {
  const LoadedMesh l = read("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 5 4 6\n");
  EXPECT_EQ(l.mesh.points.size(), 6u);
}

TEST_F(ReadMesh, TheDigitsOfATextAreItsPrecision) {
  const LoadedMesh l = read("a.obj", "v 0.123456 0 0\nv 12.3457 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(l.precision, "6 digits");
  EXPECT_NEAR(l.rounding, std::numbers::sqrt3 * 0.5e-4, 1e-12);
}

const char* const kPlyHead =
    "element vertex 4\nproperty double x\nproperty double y\nproperty double z\nelement face 4\n"
    "property list uchar int vertex_indices\nproperty int face\nend_header\n";

TEST_F(ReadMesh, PlyAsText) {
  const LoadedMesh l = read("a.ply", std::string("ply\nformat ascii 1.0\ncomment c\n") + kPlyHead +
                                         "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1 7\n3 0 1 3 8\n3 1 2 3 8\n3 2 0 3 8\n");
  expect_tetrahedron(l);
  EXPECT_EQ(l.groups, (std::vector<std::string>{"7", "8"}));
}

TEST_F(ReadMesh, PlyInBinary) {
  std::string bytes = std::string("ply\nformat binary_little_endian 1.0\n") + kPlyHead;
  for (const auto& p : kCorners) {
    for (const float x : p) append<double>(bytes, x);
  }
  for (const auto& t : kTriangles) {
    append<std::uint8_t>(bytes, 3);
    for (const int c : t) append<std::int32_t>(bytes, c);
    append<std::int32_t>(bytes, 1);
  }
  expect_tetrahedron(read("a.ply", bytes));
  EXPECT_NE(refusal("a.ply", bytes.substr(0, bytes.size() - 5)), "");
}

TEST_F(ReadMesh, Off) {
  const LoadedMesh l =
      read("a.off", "OFF\n# c\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3 255 0 0\n3 1 2 3\n3 2 0 3\n");
  expect_tetrahedron(l);
}

TEST_F(ReadMesh, PolygonsAreCutIntoFans) {
  const LoadedMesh l = read("a.off", "OFF 4 1 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
  EXPECT_EQ(l.mesh.triangles.size(), 2u);
  EXPECT_EQ(l.split, 1);
  EXPECT_DOUBLE_EQ(quality(l.mesh).area, 1.0);
}

TEST_F(ReadMesh, MshOfVersion2) {
  const LoadedMesh l =
      read("a.msh",
           "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 5 \"top side\"\n$EndPhysicalNames\n"
           "$Nodes\n4\n11 0 0 0\n12 1 0 0\n13 0 1 0\n14 0 0 1\n$EndNodes\n$Elements\n5\n"
           "1 1 2 0 1 11 12\n2 2 2 5 1 11 13 12\n3 2 2 0 2 11 12 14\n4 2 2 0 2 12 13 14\n"
           "5 2 2 0 2 13 11 14\n$EndElements\n");
  expect_tetrahedron(l);
  EXPECT_EQ(l.groups, (std::vector<std::string>{"top side", "surface 2"}));
  EXPECT_EQ(l.other_elements, 1);
}

TEST_F(ReadMesh, MshOfVersion4) {
  const LoadedMesh l =
      read("a.msh",
           "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 9 \"Face1\"\n$EndPhysicalNames\n$Entities\n"
           "1 0 2 0\n1 0 0 0 0\n1 0 0 0 1 1 0 1 9 0\n2 0 0 0 1 1 1 0 0\n$EndEntities\n$Nodes\n2 4 11 14\n0 1 0 1\n11\n"
           "0 0 0\n2 1 0 3\n12\n13\n14\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n$Elements\n2 4 1 4\n2 1 2 1\n1 11 13 12\n"
           "2 2 2 3\n2 11 12 14\n3 12 13 14\n4 13 11 14\n$EndElements\n");
  expect_tetrahedron(l);
  EXPECT_EQ(l.groups, (std::vector<std::string>{"Face1", "surface 2"}));
}

TEST_F(ReadMesh, MshThatTellsOfMoreNodesThanItHoldsEndsTooSoon) {
  EXPECT_NE(refusal("a.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 3 1 3\n2 1 0 9000000000000000000\n1\n")
                .find("ends too soon"),
            std::string::npos);
}

TEST_F(ReadMesh, PlyElementsWithoutPropertiesArePassedBy) {
  const LoadedMesh l = read("a.ply",
                            "ply\nformat ascii 1.0\nelement mark 9000000000000000000\nelement vertex 3\n"
                            "property float x\nproperty float y\nproperty float z\nelement face 1\n"
                            "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_EQ(l.mesh.points.size(), 3u);
  EXPECT_EQ(l.mesh.triangles.size(), 1u);
}

TEST_F(ReadMesh, BinaryMshSaysWhatWouldMendIt) {
  EXPECT_NE(refusal("a.msh", "$MeshFormat\n4.1 1 8\n").find("write it as text"), std::string::npos);
}

std::string vtp(const std::string& format, const std::string& points, const std::string& corners,
                const std::string& ends, const std::string& faces) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
         "header_type=\"UInt32\">\n<PolyData>\n<Piece NumberOfPoints=\"4\" NumberOfPolys=\"4\">\n<Points>\n"
         "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"" +
         format + "\">" + points +
         "</DataArray>\n</Points>\n<Polys>\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"" + format +
         "\">" + corners + "</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"" + format + "\">" +
         ends + "</DataArray>\n</Polys>\n<CellData>\n<DataArray type=\"Int32\" Name=\"face\" format=\"" + format +
         "\">" + faces + "</DataArray>\n</CellData>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

TEST_F(ReadMesh, VtpAsText) {
  const LoadedMesh l =
      read("a.vtp", vtp("ascii", "0 0 0 1 0 0 0 1 0 0 0 1", "0 2 1 0 1 3 1 2 3 2 0 3", "3 6 9 12", "1 2 2 2"));
  expect_tetrahedron(l);
  EXPECT_EQ(l.groups, (std::vector<std::string>{"1", "2"}));
  EXPECT_EQ(l.precision, "double precision");
}

// The base64 is Python's: base64.b64encode(struct.pack("<I", length) + data).
TEST_F(ReadMesh, VtpInBase64) {
  expect_tetrahedron(
      read("a.vtp", vtp("binary",
                        "YAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAPA/"
                        "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA8D8AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAADwPw==",
                        "MAAAAAAAAAACAAAAAQAAAAAAAAABAAAAAwAAAAEAAAACAAAAAwAAAAIAAAAAAAAAAwAAAA==",
                        "EAAAAAMAAAAGAAAACQAAAAwAAAA=", "EAAAAAEAAAACAAAAAgAAAAIAAAA=")));
}

TEST_F(ReadMesh, Inp) {
  const LoadedMesh l =
      read("a.inp",
           "*HEADING\n** comment\n*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 0., 1., 0.\n4, 0., 0., 1.\n"
           "*ELEMENT, TYPE=T3D2, ELSET=Line1\n1, 1, 2\n*Element, type=CPS3, elset=Surface1\n2, 1, 3, 2\n"
           "*ELEMENT,TYPE=S3,ELSET=Surface2\n3,1,2,4\n4,2,3,4\n5,3,1,4\n*ELSET, ELSET=All\n1,2,3\n");
  expect_tetrahedron(l);
  EXPECT_EQ(l.groups, (std::vector<std::string>{"Surface1", "Surface2"}));
  EXPECT_EQ(l.other_elements, 1);
}

TEST_F(ReadMesh, EveryFormatRefusesWhatItIsNot) {
  for (const std::string& ending : readable_mesh_endings()) {
    EXPECT_NE(refusal("a" + ending, "Dear reader,\nthis is no mesh.\n"), "") << ending;
    EXPECT_NE(refusal("a" + ending, ""), "") << ending;
    EXPECT_NE(refusal("a" + ending, std::string("\0\1\2\3\377", 5)), "") << ending;
  }
}

TEST_F(ReadMesh, ATriangleThatNamesNoPointIsAnError) {
  EXPECT_NE(refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n").find("triangle 1"), std::string::npos);
  // 4294967297 is 1 and 2 to the 32.
  EXPECT_NE(refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 4294967297 2 3\n").find("triangle 1"), std::string::npos);
  EXPECT_NE(refusal("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 4294967296 1 2\n").find("triangle 1"),
            std::string::npos);
  EXPECT_NE(refusal("a.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n").find("not finite"), std::string::npos);
  EXPECT_NE(refusal("a.obj", "v 0 0 0\nv 1e300 0 0\nv 0 1 0\nf 1 2 3\n").find("point 2 is farther away"),
            std::string::npos);
}

TEST_F(ReadMesh, ANumberThatIsNoneNamesItsLine) {
  EXPECT_NE(refusal("a.obj", "v 0 0 0\nv 1 zero 0\n").find("line 2: 'zero'"), std::string::npos);
}

TEST_F(ReadMesh, AnUnknownEndingIsRefused) { EXPECT_NE(refusal("a.step", "x").find("'.step'"), std::string::npos); }

}  // namespace
}  // namespace geovor
