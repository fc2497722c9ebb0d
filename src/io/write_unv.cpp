#include <algorithm>
#include <charconv>

#include "io/face_groups.h"
#include "io/mesh_writers.h"

namespace geovor {
namespace {

constexpr int kThinShellTriangle = 91;
constexpr int kElementEntity = 8;  // what a group may hold, of the format's kinds
constexpr std::size_t kNameBytes = 40;

/// FORTRAN's I10.
void put_ints(ByteStream& out, std::initializer_list<long> numbers) {
  for (const long number : numbers) {
    const std::string text = std::to_string(number);
    out << std::string_view("          ").substr(0, 10 - std::min<std::size_t>(text.size(), 10)) << text;
  }
  out << '\n';
}

/// FORTRAN's 1PD25.16: 17 digits name a double.
void put_reals(ByteStream& out, std::initializer_list<double> numbers) {
  constexpr std::size_t kWidth = 25;
  constexpr int kDecimals = 16;
  for (const double number : numbers) {
    char text[kWidth];
    char* const last = std::to_chars(text, text + kWidth, number, std::chars_format::scientific, kDecimals).ptr;
    std::replace(text, last, 'e', 'D');
    const auto length = static_cast<std::size_t>(last - text);
    out << std::string(kWidth - length, ' ') << std::string_view(text, length);
  }
  out << '\n';
}

/// A dataset: its number between lines of -1.
void begin(ByteStream& out, const char* number) { out << "    -1\n" << number << '\n'; }
void end(ByteStream& out) { out << "    -1\n"; }

void put_groups(const FaceGroups& groups, ByteStream& out) {
  begin(out, "  2467");
  long element = 0, number = 0;
  for (const FaceGroup& group : groups) {
    put_ints(out, {++number, 0, 0, 0, 0, 0, 0, static_cast<long>(group.triangles.size())});
    out << group.name << '\n';
    for (std::size_t i = 0; i < group.triangles.size(); i += 2) {
      ++element;
      if (i + 1 < group.triangles.size()) {
        put_ints(out, {kElementEntity, element, 0, 0, kElementEntity, element + 1, 0, 0});
        ++element;
      } else {
        put_ints(out, {kElementEntity, element, 0, 0});
      }
    }
  }
  end(out);
}

}  // namespace

void put_unv(const LabelledMesh& labelled, ByteStream& out) {
  const TriangleMesh& mesh = labelled.mesh;
  const FaceGroups groups(labelled, NameAlphabet::Plain, kNameBytes);
  begin(out, "  2411");
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Xyz& p = mesh.points[i];
    put_ints(out, {static_cast<long>(i) + 1, 1, 1, 11});
    put_reals(out, {p.x(), p.y(), p.z()});
  }
  end(out);
  begin(out, "  2412");
  long element = 0;
  for (const FaceGroup& group : groups) {
    for (const int t : group.triangles) {
      const auto& [a, b, c] = mesh.triangles[t];
      put_ints(out, {++element, kThinShellTriangle, 1, 1, 7, 3});
      put_ints(out, {a + 1L, b + 1L, c + 1L});
    }
  }
  end(out);
  put_groups(groups, out);
}

}  // namespace geovor
