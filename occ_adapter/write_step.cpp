#include "occ_adapter/write_step.h"

#include <APIHeaderSection_MakeHeader.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_StepModel.hxx>
#include <TCollection_HAsciiString.hxx>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "occ_adapter/occ_write_private.h"

namespace geovor {
namespace {

namespace fs = std::filesystem;

/// OpenCASCADE's word for a unit of length.
std::string occ_unit(const std::string& unit) {
  static const std::map<std::string, std::string> names = {{"mm", "MM"}, {"m", "M"},     {"cm", "CM"}, {"km", "KM"},
                                                           {"um", "UM"}, {"in", "INCH"}, {"ft", "FT"}, {"mi", "MI"}};
  const auto found = names.find(unit);
  if (found == names.end()) {
    throw Error(ErrorCode::Unwritable,
                "STEP knows no unit of length '" + unit + "'; use mm, m, cm, km, um, in, ft or mi");
  }
  return found->second;
}

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

/// Header and product name, without the clock and without OpenCASCADE's running number: the same mesh gives the same
/// bytes.
void fill_header(STEPControl_Writer& writer, const std::string& path) {
  const Handle(TCollection_HAsciiString) product = new TCollection_HAsciiString(fs::path(path).stem().string().c_str());
  for (int i = 1; i <= writer.Model()->NbEntities(); ++i) {
    const auto named = Handle(StepBasic_Product)::DownCast(writer.Model()->Value(i));
    if (!named.IsNull()) named->SetName(product), named->SetId(product);
  }
  const auto text = [](const char* s) { return new TCollection_HAsciiString(s); };
  APIHeaderSection_MakeHeader header(writer.Model());
  header.SetName(new TCollection_HAsciiString(fs::path(path).filename().string().c_str()));
  header.SetTimeStamp(text("1970-01-01T00:00:00"));
  header.SetAuthorValue(1, text(""));
  header.SetOrganizationValue(1, text(""));
  header.SetOriginatingSystem(text("geovor"));
  header.SetDescriptionValue(1, text("faceted boundary representation"));
}

void write_shape(const TopoDS_Shape& shape, const std::string& name, const std::string& path) {
  STEPControl_Writer writer;
  if (writer.Transfer(shape, STEPControl_AsIs) != IFSelect_RetDone) {
    throw Error(ErrorCode::Unwritable, "OpenCASCADE can't turn the mesh into STEP; write .stl or .obj");
  }
  fill_header(writer, name);
  if (writer.Write(path.c_str()) != IFSelect_RetDone) {
    throw Error(ErrorCode::Unwritable, "can't write here; check folder, permissions and free space");
  }
}

}  // namespace

void write_step(const TriangleMesh& mesh, const std::string& unit, const std::string& path) {
  require_writable(mesh);
  const std::string length_unit = occ_unit(unit);
  const std::string beside = path + ".part";
  std::error_code failed;
  try {
    occ::translated(ErrorCode::Unwritable, "OpenCASCADE fails to write STEP", "write .stl or .obj", [&] {
      const occ::Silence silence;
      STEPControl_Controller::Init();
      // Both units alike: OpenCASCADE then writes the numbers of the mesh as they are. It reads them when the writer is
      // made, not when it writes.
      const occ::StaticParameter model_unit("xstep.cascade.unit", length_unit);
      const occ::StaticParameter file_unit("write.step.unit", length_unit);
      const occ::StaticParameter schema("write.step.schema", "AP214IS");
      // Planes and lines need no curves in the parameter plane, and without them the file is half as long.
      const occ::StaticParameter no_pcurves("write.surfacecurve.mode", "0");
      write_shape(occ::facet_shape(mesh), path, beside);
    });
    fs::rename(beside, path, failed);
    if (failed) throw Error(ErrorCode::Unwritable, "can't write here; check folder, permissions and free space");
  } catch (...) {
    fs::remove(beside, failed);
    throw;
  }
}

}  // namespace geovor
