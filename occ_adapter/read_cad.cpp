#include "occ_adapter/read_cad.h"

#include "occ_adapter/occ_private.h"

namespace geovor {

CadModel read_cad(const std::string& path) {
  const CadFormat format = check_cad_file(path);
  const occ::LoadedShape loaded = occ::load_shape(path, format);
  const occ::Silence silence;
  CadModel model = occ::translated(ErrorCode::Unreadable, "OpenCASCADE fails on the shape in the file",
                                   "export it again from the CAD system, or in another format",
                                   [&] { return occ::build_model(loaded); });
  model.file = path;
  return model;
}

}  // namespace geovor
