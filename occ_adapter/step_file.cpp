// The part of writing STEP that is the same for meshes and curves: units, header, names, and a file that is complete or
// absent.
#include <APIHeaderSection_MakeHeader.hxx>
#include <STEPConstruct.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TCollection_HAsciiString.hxx>
#include <Transfer_FinderProcess.hxx>
#include <XSControl_TransferWriter.hxx>
#include <XSControl_WorkSession.hxx>
#include <filesystem>
#include <fstream>

#include "occ_adapter/occ_write_private.h"

namespace geovor::occ {
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

Handle(TCollection_HAsciiString) text(const std::string& s) { return new TCollection_HAsciiString(s.c_str()); }

/// Transfers one shape and names its product: OpenCASCADE would give it a running number of its own.
void transfer(STEPControl_Writer& writer, const NamedShape& named) {
  const int before = writer.Model()->NbEntities();
  if (writer.Transfer(named.shape, STEPControl_AsIs) != IFSelect_RetDone) {
    throw Error(ErrorCode::Unwritable, "OpenCASCADE can't turn the shape into STEP; write another format");
  }
  std::vector<Handle(StepBasic_Product)> products;
  for (int i = before + 1; i <= writer.Model()->NbEntities(); ++i) {
    const auto product = Handle(StepBasic_Product)::DownCast(writer.Model()->Value(i));
    if (!product.IsNull()) products.push_back(product);
  }
  // A compound of edges becomes an assembly: its own product, then one an edge.
  const bool assembly = products.size() == 1 + named.parts.size();
  for (std::size_t i = 0; i < products.size(); ++i) {
    const std::string& name = assembly && i > 0 ? named.parts[i - 1].second : named.name;
    products[i]->SetName(text(name)), products[i]->SetId(text(name));
  }
  const Handle(Transfer_FinderProcess) made = writer.WS()->TransferWriter()->FinderProcess();
  for (const auto& [part, name] : named.parts) {
    const Handle(StepRepr_RepresentationItem) item = STEPConstruct::FindEntity(made, part);
    if (!item.IsNull()) item->SetName(text(name));
  }
}

/// Without the clock: the same shapes give the same bytes.
void fill_header(STEPControl_Writer& writer, const std::string& path, const std::string& description) {
  APIHeaderSection_MakeHeader header(writer.Model());
  header.SetName(text(fs::path(path).filename().string()));
  header.SetTimeStamp(text("1970-01-01T00:00:00"));
  header.SetAuthorValue(1, text(""));
  header.SetOrganizationValue(1, text(""));
  header.SetOriginatingSystem(text("geovor"));
  header.SetDescriptionValue(1, text(description));
}

bool write_text(STEPControl_Writer& writer, bool every_digit, const std::string& place) {
  if (!every_digit) return writer.Write(place.c_str()) == IFSelect_RetDone;
  StepData_StepWriter text_writer(writer.Model());
  text_writer.FloatWriter().SetFormat("%.16E");  // 17 significant digits name a double
  text_writer.SendModel(Handle(StepData_Protocol)::DownCast(writer.Model()->Protocol()));
  std::ofstream out(place);
  return text_writer.Print(out) && out.flush().good();
}

void write_shapes(const std::vector<NamedShape>& shapes, const StepFile& file, const std::string& place) {
  STEPControl_Writer writer;
  for (const NamedShape& named : shapes) transfer(writer, named);
  fill_header(writer, file.path, file.description);
  if (!write_text(writer, file.every_digit, place)) {
    throw Error(ErrorCode::Unwritable, "can't write here; check folder, permissions and free space");
  }
}

}  // namespace

void write_step_file(const StepFile& file, const std::function<std::vector<NamedShape>()>& shapes) {
  const std::string length_unit = occ_unit(file.unit);
  const std::string beside = file.path + ".part";
  std::error_code failed;
  try {
    translated(ErrorCode::Unwritable, "OpenCASCADE fails to write STEP", "write another format", [&] {
      const Silence silence;
      STEPControl_Controller::Init();
      // Both units alike: OpenCASCADE then writes the numbers as they are. It reads them when the writer is made, not
      // when it writes.
      const StaticParameter model_unit("xstep.cascade.unit", length_unit);
      const StaticParameter file_unit("write.step.unit", length_unit);
      const StaticParameter schema("write.step.schema", "AP214IS");
      const StaticParameter pcurves("write.surfacecurve.mode", file.pcurves ? "1" : "0");
      write_shapes(shapes(), file, beside);
    });
    fs::rename(beside, file.path, failed);
    if (failed) throw Error(ErrorCode::Unwritable, "can't write here; check folder, permissions and free space");
  } catch (...) {
    fs::remove(beside, failed);
    throw;
  }
}

}  // namespace geovor::occ
