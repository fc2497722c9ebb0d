#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <sstream>

#include "base/error.h"
#include "io/mesh_writers.h"
#include "io/number_text.h"

namespace geovor {
namespace {

/// Seeded triangles over points of every size that a double can have without its triangles' normals overflowing.
TriangleMesh wild_mesh(double largest_exponent) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> mantissa(-1.0, 1.0), exponent(-largest_exponent, largest_exponent);
  TriangleMesh mesh;
  for (int i = 0; i < 300; ++i) {
    const double scale = std::pow(10.0, exponent(random));
    mesh.points.push_back(scale * Xyz(mantissa(random), mantissa(random), mantissa(random)));
  }
  for (int i = 0; i + 2 < 300; ++i) {
    mesh.triangles.push_back({i, i + 1, i + 2});
    mesh.face_of.push_back(1 + i / 100);
  }
  return mesh;
}

std::string to_stl(const TriangleMesh& mesh, StlForm form) {
  return bytes_of([&](ByteStream& out) { put_stl(mesh, form, out); });
}

std::string to_obj(const TriangleMesh& mesh) {
  return bytes_of([&](ByteStream& out) { put_obj({mesh}, out); });
}

std::uint32_t uint32_at(const std::string& bytes, std::size_t at) {
  std::uint32_t x = 0;
  for (int i = 3; i >= 0; --i) x = x << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return x;
}

Xyz floats_at(const std::string& bytes, std::size_t at) {
  Xyz p;
  for (int i = 0; i < 3; ++i) p[i] = std::bit_cast<float>(uint32_at(bytes, at + 4 * i));
  return p;
}

TEST(WriteStl, BinaryReadsBackAsTheSameFloats) {
  const TriangleMesh mesh = wild_mesh(2);
  const std::string bytes = to_stl(mesh, StlForm::Binary);
  ASSERT_EQ(bytes.size(), 84 + 50 * mesh.triangles.size());
  EXPECT_NE(bytes.substr(0, 5), "solid");
  ASSERT_EQ(uint32_at(bytes, 80), mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::size_t at = 84 + 50 * t;
    EXPECT_NEAR(floats_at(bytes, at).norm(), 1.0, 1e-6);
    for (int k = 0; k < 3; ++k) {
      const Xyz expected = mesh.points[mesh.triangles[t][k]].cast<float>().cast<double>();
      EXPECT_EQ(floats_at(bytes, at + 12 + 12 * k), expected);
    }
    EXPECT_EQ(bytes.substr(at + 48, 2), std::string(2, '\0'));
  }
}

TEST(WriteStl, NormalsFollowTheRightHand) {
  const TriangleMesh mesh{{{0, 0, 5}, {2, 0, 5}, {0, 3, 5}}, {{0, 1, 2}}, {1}};
  EXPECT_EQ(floats_at(to_stl(mesh, StlForm::Binary), 84), Xyz(0, 0, 1));
}

TEST(WriteStl, AsciiReadsBackAsTheSameDoubles) {
  const TriangleMesh mesh = wild_mesh(60);
  std::istringstream in(to_stl(mesh, StlForm::Ascii));
  std::string line, word, number;
  std::getline(in, line);
  EXPECT_EQ(line, "solid geovor");
  std::vector<double> read;
  while (in >> word && word != "endsolid") {
    for (int i = 0; word == "vertex" && i < 3; ++i) {
      in >> number;
      read.push_back(std::stod(number));
    }
  }
  ASSERT_EQ(read.size(), 9 * mesh.triangles.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i], mesh.points[mesh.triangles[i / 9][i % 9 / 3]][static_cast<int>(i % 3)]);
  }
}

TEST(WriteStl, GivesATriangleWithoutAreaAZeroNormal) {
  const TriangleMesh mesh{{{1, 1, 1}, {2, 2, 2}, {3, 3, 3}}, {{0, 1, 2}}, {1}};
  EXPECT_EQ(floats_at(to_stl(mesh, StlForm::Binary), 84), Xyz(0, 0, 0));
}

TEST(WriteStl, RefusesWhatFloatsCantHold) {
  const TriangleMesh mesh{{{0, 0, 0}, {1e39, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {1}};
  EXPECT_THROW(to_stl(mesh, StlForm::Binary), Error);
  EXPECT_NO_THROW(to_stl(mesh, StlForm::Ascii));
}

TEST(WriteObj, ReadsBackAsTheSameDoublesTrianglesAndFaces) {
  const TriangleMesh mesh = wild_mesh(300);
  std::istringstream in(to_obj(mesh));
  TriangleMesh read;
  std::string line, word, number;
  int face = 0;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    words >> word;
    if (word == "v") {
      Xyz p;
      for (double& x : p) words >> number, x = std::strtod(number.c_str(), nullptr);
      read.points.push_back(p);
    } else if (word == "g") {
      words >> word;
      face = std::stoi(word.substr(4));
    } else if (word == "f") {
      std::array<int, 3> t;
      for (int& p : t) words >> p, --p;
      read.triangles.push_back(t);
      read.face_of.push_back(face);
    }
  }
  ASSERT_EQ(read.points.size(), mesh.points.size());
  for (std::size_t i = 0; i < read.points.size(); ++i) EXPECT_EQ(read.points[i], mesh.points[i]);
  EXPECT_EQ(read.triangles, mesh.triangles);
  EXPECT_EQ(read.face_of, mesh.face_of);
}

TEST(NumberText, RoundsForPicturesWithoutTrailingZeros) {
  const auto rounded = [](double x) {
    std::string text;
    append_rounded(text, x, 2);
    return text;
  };
  EXPECT_EQ(rounded(1.0), "1");
  EXPECT_EQ(rounded(-0.001), "0");
  EXPECT_EQ(rounded(12.5), "12.5");
  EXPECT_EQ(rounded(-3.14159), "-3.14");
  EXPECT_EQ(rounded(100.0), "100");
}

}  // namespace
}  // namespace geovor
