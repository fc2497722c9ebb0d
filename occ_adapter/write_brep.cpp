#include "occ_adapter/write_brep.h"

#include <BRepTools.hxx>
#include <filesystem>
#include <fstream>

#include "occ_adapter/occ_write_private.h"

namespace geovor {

void write_brep(const TriangleMesh& mesh, const std::string& path) {
  namespace fs = std::filesystem;
  const std::string beside = path + ".part";
  const auto fail = [] {
    throw Error(ErrorCode::Unwritable, "can't write here; check folder, permissions and free space");
  };
  std::error_code failed;
  try {
    occ::translated(ErrorCode::Unwritable, "OpenCASCADE fails to write BREP", "write another format", [&] {
      std::ofstream out(beside);
      BRepTools::Write(occ::facet_shape(mesh), out);
      if (!out.flush().good()) fail();
    });
    fs::rename(beside, path, failed);
    if (failed) fail();
  } catch (...) {
    fs::remove(beside, failed);
    throw;
  }
}

}  // namespace geovor
