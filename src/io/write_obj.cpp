#include "io/write_obj.h"

#include "io/atomic_file.h"
#include "io/number_text.h"

namespace geovor {

std::string to_obj(const TriangleMesh& mesh) {
  std::string text = "# geovor " + std::to_string(mesh.points.size()) + " points, " +
                     std::to_string(mesh.triangles.size()) + " triangles\n";
  for (const Xyz& p : mesh.points) {
    text += 'v';
    for (const double x : p) {
      text += ' ';
      append_shortest(text, x);
    }
    text += '\n';
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (t == 0 || mesh.face_of[t] != mesh.face_of[t - 1]) text += "g Face" + std::to_string(mesh.face_of[t]) + '\n';
    text += 'f';
    for (const int p : mesh.triangles[t]) {
      text += ' ';
      text += std::to_string(p + 1);  // OBJ counts from 1
    }
    text += '\n';
  }
  return text;
}

void write_obj(const TriangleMesh& mesh, const std::string& path) { write_file(path, to_obj(mesh)); }

}  // namespace geovor
