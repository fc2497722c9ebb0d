#include <cstdint>
#include <cstring>

#include "io/binary_numbers.h"
#include "io/mesh_builder.h"
#include "io/mesh_readers.h"
#include "io/mesh_text.h"

namespace geovor {
namespace {

constexpr std::size_t kHeader = 80, kCount = 4, kTriangle = 50, kNormal = 12;

/// The number of triangles that a binary file of this length states, or -1 where length and number don't fit.
long binary_triangles(std::string_view bytes) {
  if (bytes.size() < kHeader + kCount) return -1;
  const auto n = read_little<std::uint32_t>(bytes.data() + kHeader);
  return bytes.size() == kHeader + kCount + kTriangle * n ? static_cast<long>(n) : -1;
}

LoadedMesh read_binary(std::string_view bytes, long triangles) {
  MeshBuilder builder;
  const char* at = bytes.data() + kHeader + kCount;
  for (long t = 0; t < triangles; ++t, at += kTriangle) {
    const int first = builder.points();
    for (int corner = 0; corner < 3; ++corner) {
      Xyz x;
      for (int i = 0; i < 3; ++i) x[i] = read_little<float>(at + kNormal + 4 * (3 * corner + i));
      builder.point(x);
    }
    builder.polygon({first, first + 1, first + 2}, -1);
  }
  builder.weld();
  return builder.finish(MeshBuilder::kSingle);
}

// Several solids are groups; one alone says nothing.
LoadedMesh read_text(std::string_view bytes) {
  MeshBuilder builder;
  MeshText text(bytes);
  std::vector<int> corners, group_of;
  int group = -1, solids = 0;
  bool ended = false;
  while (text.next_line()) {
    const std::string word = lower_case(text.word());
    if (word == "solid") {
      ++solids;
      const std::string name(text.word());
      group = builder.group(name.empty() ? "solid " + std::to_string(solids) : name);
    } else if (word == "vertex") {
      corners.push_back(builder.points());
      builder.point(text.point());
    } else if (word == "endfacet") {
      if (corners.size() != 3) text.fail("a facet has not three corners; export the mesh anew");
      builder.polygon(corners, group);
      corners.clear();
    }
    ended = word == "endsolid";
  }
  if (!ended)
    fail_to_read(0,
                 "the text ends before 'endsolid', or the length of a binary file does not fit its number of "
                 "triangles; export the mesh anew");
  if (solids < 2) {
    for (int t = 0; t < builder.triangles(); ++t) builder.set_group(t, -1);
  }
  builder.weld();
  return builder.finish(text.digits());
}

}  // namespace

LoadedMesh read_stl(std::string_view bytes) {
  const long triangles = binary_triangles(bytes);
  return triangles >= 0 ? read_binary(bytes, triangles) : read_text(bytes);
}

}  // namespace geovor
