#include "occ_adapter/write_step.h"

#include <filesystem>

#include "occ_adapter/occ_write_private.h"

namespace geovor {
namespace {

void require_writable(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw Error(ErrorCode::Unwritable, "the mesh has no triangle; nothing to write");
  const int count = static_cast<int>(mesh.points.size());
  for (const auto& triangle : mesh.triangles) {
    for (const int corner : triangle) {
      if (corner < 0 || corner >= count || !mesh.points[static_cast<std::size_t>(corner)].allFinite()) {
        throw Error(ErrorCode::Unwritable, "a triangle has a corner that is no finite point; mesh again");
      }
    }
  }
}

void require_writable(const CadCurve& curve) {
  for (const Xyz& pole : curve.poles) {
    if (!pole.allFinite()) {
      throw Error(ErrorCode::Unwritable, "the curve '" + curve.name + "' has a pole that is no finite point");
    }
  }
}

}  // namespace

void write_step(const TriangleMesh& mesh, const std::string& unit, const std::string& path) {
  require_writable(mesh);
  occ::write_step_file({path, unit, "faceted boundary representation"}, [&] {
    const std::string name = std::filesystem::path(path).stem().string();
    return std::vector<occ::NamedShape>{{occ::facet_shape(mesh), name, {}}};
  });
}

void write_step(const std::vector<CadCurve>& curves, const std::string& unit, const std::string& path) {
  if (curves.empty()) throw Error(ErrorCode::Unwritable, "there is no curve; nothing to write");
  for (const CadCurve& curve : curves) require_writable(curve);
  occ::write_step_file({path, unit, "curves", true}, [&] {
    std::vector<occ::NamedShape> shapes;
    for (const CadCurve& curve : curves) shapes.push_back({occ::edge_of(curve), curve.name, {}});
    return shapes;
  });
}

}  // namespace geovor
