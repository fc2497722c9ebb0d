#include "occ_adapter/write_step.h"

#include "occ_adapter/occ_write_private.h"

namespace geovor {
namespace {

void require_writable(const CadCurve& curve) {
  for (const Xyz& pole : curve.poles) {
    if (!pole.allFinite()) {
      throw Error(ErrorCode::Unwritable, "the curve '" + curve.name + "' has a pole that is no finite point");
    }
  }
}

}  // namespace

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
