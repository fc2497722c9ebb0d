#include <Eigen/Geometry>
#include <limits>

#include "base/error.h"
#include "io/mesh_writers.h"

namespace geovor {
namespace {

constexpr std::size_t kHeaderBytes = 80;

Xyz normal_of(const TriangleMesh& mesh, const std::array<int, 3>& t) {
  const Xyz n = (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]);
  // stableNormalized: the cross product of a tiny triangle may underflow when it is squared.
  return n.isZero(0.0) ? Xyz(Xyz::Zero()) : n.stableNormalized();
}

void put_floats(const Xyz& p, ByteStream& out) {
  for (const double x : p) out.real(static_cast<float>(x));
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

void put_binary(const TriangleMesh& mesh, ByteStream& out) {
  check_fits(mesh);
  // The first word must not be "solid": readers would take the file for text.
  std::string header = "geovor binary STL";
  header.resize(kHeaderBytes, ' ');
  out << header;
  out.word(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    put_floats(normal_of(mesh, t), out);
    for (const int p : t) put_floats(mesh.points[p], out);
    out.byte(0), out.byte(0);
  }
}

void put_line(const char* words, const Xyz& p, ByteStream& out) {
  out << words << ' ' << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
}

void put_ascii(const TriangleMesh& mesh, ByteStream& out) {
  out << "solid geovor\n";
  for (const auto& t : mesh.triangles) {
    put_line("facet normal", normal_of(mesh, t), out);
    out << "outer loop\n";
    for (const int p : t) put_line("vertex", mesh.points[p], out);
    out << "endloop\nendfacet\n";
  }
  out << "endsolid geovor\n";
}

}  // namespace

void put_stl(const TriangleMesh& mesh, StlForm form, ByteStream& out) {
  if (form == StlForm::Binary) {
    put_binary(mesh, out);
  } else {
    put_ascii(mesh, out);
  }
}

}  // namespace geovor
