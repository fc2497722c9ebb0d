#include "io/face_groups.h"
#include "io/mesh_writers.h"
#include "io/number_text.h"

namespace geovor {
namespace {

/// CalculiX reads the first 20 characters of a number, and Abaqus promises no more: a cut exponent would be fatal.
constexpr std::size_t kLongestNumber = 20;

void put_point(const Xyz& p, ByteStream& out) {
  std::string text;
  for (const double x : p) text += ", ", append_within(text, x, kLongestNumber);
  out << text << '\n';
}

}  // namespace

void put_inp(const LabelledMesh& labelled, ByteStream& out) {
  const TriangleMesh& mesh = labelled.mesh;
  out << "*HEADING\ngeovor, lengths in " << labelled.unit << "\n*NODE\n";
  for (std::size_t i = 0; i < mesh.points.size(); ++i) out << i + 1, put_point(mesh.points[i], out);
  const FaceGroups groups(labelled, NameAlphabet::Plain);
  std::size_t element = 0;
  for (const FaceGroup& group : groups) {
    out << "*ELEMENT, TYPE=S3, ELSET=" << group.name << '\n';
    for (const int t : group.triangles) {
      const auto& [a, b, c] = mesh.triangles[t];
      out << ++element << ", " << a + 1 << ", " << b + 1 << ", " << c + 1 << '\n';
    }
  }
}

}  // namespace geovor
