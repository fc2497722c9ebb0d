#include "io/face_groups.h"
#include "io/mesh_writers.h"

namespace geovor {

void put_obj(const LabelledMesh& labelled, ByteStream& out) {
  const TriangleMesh& mesh = labelled.mesh;
  out << "# geovor " << mesh.points.size() << " points, " << mesh.triangles.size() << " triangles\n";
  for (const Xyz& p : mesh.points) out << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  // A group's name ends at white space.
  const FaceGroups groups(labelled, NameAlphabet::Word);
  for (const FaceGroup& group : groups) {
    out << "g " << group.name << '\n';
    for (const int t : group.triangles) {
      const auto& [a, b, c] = mesh.triangles[t];
      out << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';  // OBJ counts from 1
    }
  }
}

}  // namespace geovor
