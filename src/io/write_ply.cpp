#include <algorithm>

#include "io/colours.h"
#include "io/face_groups.h"
#include "io/mesh_writers.h"

namespace geovor {

void put_ply(const LabelledMesh& labelled, ByteStream& out) {
  const TriangleMesh& mesh = labelled.mesh;
  const FaceGroups groups(labelled, NameAlphabet::Text);
  const bool coloured =
      std::any_of(groups.begin(), groups.end(), [](const FaceGroup& g) { return g.colour.has_value(); });
  out << "ply\nformat binary_little_endian 1.0\ncomment geovor, lengths in " << labelled.unit << '\n';
  for (const FaceGroup& group : groups) out << "comment face " << group.face << ' ' << group.name << '\n';
  out << "element vertex " << mesh.points.size() << "\nproperty double x\nproperty double y\nproperty double z\n";
  out << "element face " << mesh.triangles.size() << "\nproperty list uchar int vertex_indices\nproperty int face\n";
  if (coloured) out << "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  out << "end_header\n";
  for (const Xyz& p : mesh.points) {
    for (const double x : p) out.real(x);
  }
  for (const FaceGroup& group : groups) {
    const auto colour = srgb_bytes(group.colour.value_or(kPlainColour));
    for (const int t : group.triangles) {
      out.byte(3);
      for (const int corner : mesh.triangles[t]) out.word(static_cast<std::uint32_t>(corner));
      out.word(static_cast<std::uint32_t>(group.face));
      for (const std::uint8_t part : colour) {
        if (coloured) out.byte(part);
      }
    }
  }
}

}  // namespace geovor
