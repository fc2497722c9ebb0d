#include "io/write_stl.h"

#include <Eigen/Geometry>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/error.h"
#include "io/atomic_file.h"
#include "io/number_text.h"

namespace geovor {
namespace {

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kTriangleBytes = 50;  // twelve floats and two bytes of attributes

Xyz normal_of(const TriangleMesh& mesh, const std::array<int, 3>& t) {
  const Xyz n = (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]);
  // stableNormalized: the cross product of a tiny triangle may underflow when it is squared.
  return n.isZero(0.0) ? Xyz(Xyz::Zero()) : n.stableNormalized();
}

void append_uint32(std::string& bytes, std::uint32_t x) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((x >> shift) & 0xff);
}

void append_floats(std::string& bytes, const Xyz& p) {
  for (const double x : p) append_uint32(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(x)));
}

void check_fits(const TriangleMesh& mesh) {
  if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::Unwritable, "STL can't count so many triangles; write .obj");
  }
  for (const Xyz& p : mesh.points) {
    if (!(p.cwiseAbs().maxCoeff() <= std::numeric_limits<float>::max())) {
      throw Error(ErrorCode::Unwritable, "a coordinate is too large for binary STL; write .obj");
    }
  }
}

std::string binary(const TriangleMesh& mesh) {
  check_fits(mesh);
  // The first word must not be "solid": readers would take the file for text.
  std::string bytes = "geovor binary STL";
  bytes.reserve(kHeaderBytes + 4 + kTriangleBytes * mesh.triangles.size());
  bytes.resize(kHeaderBytes, ' ');
  append_uint32(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    append_floats(bytes, normal_of(mesh, t));
    for (const int p : t) append_floats(bytes, mesh.points[p]);
    bytes.append(2, '\0');
  }
  return bytes;
}

void append_line(std::string& text, const char* words, const Xyz& p) {
  text += words;
  for (const double x : p) {
    text += ' ';
    append_shortest(text, x);
  }
  text += '\n';
}

std::string ascii(const TriangleMesh& mesh) {
  std::string text = "solid geovor\n";
  for (const auto& t : mesh.triangles) {
    append_line(text, "facet normal", normal_of(mesh, t));
    text += "outer loop\n";
    for (const int p : t) append_line(text, "vertex", mesh.points[p]);
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid geovor\n";
}

}  // namespace

std::string to_stl(const TriangleMesh& mesh, StlForm form) {
  return form == StlForm::Binary ? binary(mesh) : ascii(mesh);
}

void write_stl(const TriangleMesh& mesh, const std::string& path, StlForm form) {
  write_file(path, to_stl(mesh, form));
}

}  // namespace geovor
