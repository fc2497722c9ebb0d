#include "make_cad/write.h"

#include <APIHeaderSection_MakeHeader.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopoDS_Shape.hxx>
#include <fstream>
#include <stdexcept>

namespace make_cad {

namespace {

constexpr const char* kSystem = "geovor samples";
constexpr const char* kStepTime = "2000-01-01T00:00:00";
constexpr const char* kIgesTime = "20000101.000000";
constexpr const char* kEveryDigit = "%.16E";  // 17 significant digits name a double

Handle(TCollection_HAsciiString) text(const std::string& s) { return new TCollection_HAsciiString(s.c_str()); }

void anonymous_header(const Handle(StepData_StepModel) & model, const std::string& name) {
  APIHeaderSection_MakeHeader header(model);
  header.SetName(text(name));
  header.SetTimeStamp(text(kStepTime));
  header.SetAuthorValue(1, text(""));
  header.SetOrganizationValue(1, text(""));
  header.SetPreprocessorVersion(text(kSystem));
  header.SetOriginatingSystem(text(kSystem));
  header.SetAuthorisation(text(""));
}

}  // namespace

void write_step(const TopoDS_Shape& shape, const std::string& name, const std::string& unit, const std::string& path) {
  Message::DefaultMessenger()->ChangePrinters().Clear();  // OpenCASCADE reports every transfer to stdout
  STEPControl_Controller::Init();                         // defines the settings
  Interface_Static::SetCVal("write.step.unit", unit.c_str());
  STEPControl_Writer writer;  // reads the unit here
  Interface_Static::SetCVal("write.step.product.name", name.c_str());
  if (writer.Transfer(shape, STEPControl_AsIs) != IFSelect_RetDone)
    throw std::runtime_error(name + ": not transferred");
  anonymous_header(writer.Model(), name);
  StepData_StepWriter text_writer(writer.Model());
  text_writer.FloatWriter().SetFormat(kEveryDigit);
  text_writer.SendModel(Handle(StepData_Protocol)::DownCast(writer.Model()->Protocol()));
  std::ofstream out(path);
  if (!text_writer.Print(out)) throw std::runtime_error(path + ": not written");
}

void write_iges(const TopoDS_Shape& shape, const std::string& path) {
  constexpr int kBrep = 1;  // faces share their edges (entity 186), instead of loose trimmed surfaces (entity 144)
  IGESControl_Writer writer("MM", kBrep);
  if (!writer.AddShape(shape)) throw std::runtime_error(path + ": not transferred");
  writer.ComputeModel();
  IGESData_GlobalSection global = writer.Model()->GlobalSection();
  for (const auto set : {&IGESData_GlobalSection::SetDate, &IGESData_GlobalSection::SetLastChangeDate})
    (global.*set)(text(kIgesTime));
  for (const auto set : {&IGESData_GlobalSection::SetAuthorName, &IGESData_GlobalSection::SetCompanyName})
    (global.*set)(text(""));
  global.SetFileName(text(path.substr(path.find_last_of('/') + 1)));
  global.SetSystemId(text(kSystem));
  global.SetInterfaceVersion(text(kSystem));
  writer.Model()->SetGlobalSection(global);
  if (!writer.Write(path.c_str())) throw std::runtime_error(path + ": not written");
}

}  // namespace make_cad
