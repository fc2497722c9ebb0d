// From a STEP file to a triangle mesh, and what the mesh is like.
//   mesh_a_step_file samples/cad/plate.step
#include <cstdio>

#include "base/error.h"
#include "mesh/mesh_checks.h"
#include "occ_adapter/read_cad.h"
#include "pipeline/mesh_model.h"

int main(int argc, char** argv) try {
  using namespace geovor;
  if (argc != 2) throw Error(ErrorCode::Usage, "usage: mesh_a_step_file PART.step");
  const CadModel model = read_cad(argv[1]);

  MeshOptions options;
  options.size = 0.05 * model.diagonal();
  const MeshResult result = mesh_model(model, options);
  for (const FaceReport& face : result.faces)
    if (face.status != FaceStatus::Meshed) std::printf("Face%d: %s\n", face.face, face.why.c_str());

  const MeshTopology shape = topology(result.mesh);
  const MeshQuality q = quality(result.mesh);
  std::printf("%d triangles, %s, smallest angle %.1f degrees\n", shape.triangles, shape.closed() ? "closed" : "open",
              q.smallest_angle);
  std::printf("area %.6f %s^2, volume %.6f %s^3\n", q.area, model.unit.c_str(), q.volume, model.unit.c_str());
  return shape.triangles > 0 ? 0 : 1;
} catch (const geovor::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return static_cast<int>(error.code());
}
