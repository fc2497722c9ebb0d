// Reading files through OpenCASCADE's translators.
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>
#include <IGESCAFControl_Reader.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Check.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Controller.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <STEPControl_Reader.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TDF_Label.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopoDS_TShape.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>

#include "occ_adapter/occ_private.h"

namespace geovor::occ {
namespace {

const char* const kExportAgain = "export it again from the CAD system, or in another format";

[[noreturn]] void fail(const std::string& message) { throw Error(ErrorCode::Unreadable, message); }

// ---- names and colours ---------------------------------------------------------------------------------------------

std::optional<Colour> colour_of(const TDF_Label& label) {
  const Handle(XCAFDoc_ColorTool) tool = XCAFDoc_DocumentTool::ColorTool(label);
  Quantity_Color colour;
  for (const XCAFDoc_ColorType type : {XCAFDoc_ColorSurf, XCAFDoc_ColorGen}) {
    if (tool->GetColor(label, type, colour)) return Colour{colour.Red(), colour.Green(), colour.Blue()};
  }
  return std::nullopt;
}

std::string name_of(const TDF_Label& label) {
  Handle(TDataStd_Name) name;
  if (!label.FindAttribute(TDataStd_Name::GetID(), name)) return {};
  const TCollection_ExtendedString& wide = name->Get();
  std::string utf8(static_cast<std::size_t>(wide.LengthOfCString()) + 1, '\0');
  Standard_PCharacter out = utf8.data();
  wide.ToUTF8CString(out);
  utf8.resize(utf8.find('\0'));
  return utf8 == "NONE" ? std::string() : utf8;
}

/// A face takes the colour of the smallest shape around it that has one: part, then solid or shell, then itself.
void label_faces(const TopoDS_Shape& shape, const std::optional<Colour>& colour, FileLabels& labels) {
  if (!colour) return;
  for (const TopoDS_Shape& face : parts_of(shape, TopAbs_FACE)) labels[face.TShape().get()].colour = colour;
}

void label_subshapes(const TDF_Label& part, FileLabels& labels) {
  TDF_LabelSequence subshapes;
  XCAFDoc_ShapeTool::GetSubShapes(part, subshapes);
  for (const bool faces : {false, true}) {
    for (const TDF_Label& label : subshapes) {
      const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(label);
      if (shape.IsNull() || (shape.ShapeType() == TopAbs_FACE) != faces) continue;
      label_faces(shape, colour_of(label), labels);
      if (faces) labels[shape.TShape().get()].name = name_of(label);
    }
  }
}

FileLabels read_labels(const Handle(TDocStd_Document) & document) {
  FileLabels labels;
  const Handle(XCAFDoc_ShapeTool) shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  TDF_LabelSequence parts;
  shapes->GetShapes(parts);
  for (const bool assemblies : {true, false}) {
    for (const TDF_Label& part : parts) {
      if (XCAFDoc_ShapeTool::IsAssembly(part) == assemblies) {
        label_faces(XCAFDoc_ShapeTool::GetShape(part), colour_of(part), labels);
      }
    }
  }
  for (const TDF_Label& part : parts) label_subshapes(part, labels);
  return labels;
}

Handle(TDocStd_Document) new_document() {
  Handle(TDocStd_Document) document;
  XCAFApp_Application::GetApplication()->NewDocument("BinXCAF", document);
  return document;
}

void close(const Handle(TDocStd_Document) & document) { XCAFApp_Application::GetApplication()->Close(document); }

// ---- STEP ----------------------------------------------------------------------------------------------------------

std::string step_unit(STEPControl_Reader& reader) {
  TColStd_SequenceOfAsciiString lengths, angles, solid_angles;
  reader.FileUnits(lengths, angles, solid_angles);
  if (lengths.IsEmpty()) return {};
  std::string unit = lengths.First().ToCString();
  std::transform(unit.begin(), unit.end(), unit.begin(), [](unsigned char c) { return std::tolower(c); });
  return unit;
}

/// Whether an entity of geometry or topology lacks what it refers to. OpenCASCADE's translator follows such a reference
/// into a null pointer and takes the program down. A missing name harms nothing.
bool is_damaged(const Handle(Interface_InterfaceModel) & model, int number) {
  const std::string type = model->Value(number)->DynamicType()->Name();
  const bool shapes = type.rfind("StepGeom_", 0) == 0 || type.rfind("StepShape_", 0) == 0 ||
                      type == "StepRepr_DefinitionalRepresentation";
  if (!shapes) return false;
  const Handle(Interface_Check) check = model->Check(number, true);
  for (int i = 1; i <= check->NbFails(); ++i) {
    if (std::string(check->CFail(i)).find("(name)") == std::string::npos) return true;
  }
  return false;
}

void require_sound_entities(STEPControl_Reader& reader) {
  const Handle(Interface_InterfaceModel) model = reader.WS()->Model();
  for (int i = 1; !model.IsNull() && i <= model->NbEntities(); ++i) {
    if (!is_damaged(model, i)) continue;
    const std::string label = model->StringLabel(model->Value(i))->ToCString();
    fail("the STEP entity " + label + " is damaged; " + kExportAgain);
  }
}

void require_step_status(IFSelect_ReturnStatus status) {
  if (status == IFSelect_RetDone) return;
  fail(std::string("OpenCASCADE finds ") + (status == IFSelect_RetVoid ? "no data" : "errors of syntax") +
       " in the STEP file; " + kExportAgain);
}

/// Shape, names and colours by way of a document.
bool load_step_document(const std::string& path, LoadedShape& loaded) {
  const Handle(TDocStd_Document) document = new_document();
  STEPCAFControl_Reader reader;
  reader.SetGDTMode(false);
  reader.SetMatMode(false);
  reader.SetViewMode(false);
  reader.SetPropsMode(false);
  reader.SetLayerMode(false);
  require_step_status(reader.ReadFile(path.c_str()));
  require_sound_entities(reader.ChangeReader());
  const bool transferred = reader.Transfer(const_cast<Handle(TDocStd_Document)&>(document));
  if (transferred) {
    loaded.shape = reader.ChangeReader().OneShape();
    loaded.file_unit = step_unit(reader.ChangeReader());
    loaded.labels = read_labels(document);
  }
  close(document);
  return transferred && !loaded.shape.IsNull();
}

void load_step_shape(const std::string& path, LoadedShape& loaded) {
  STEPControl_Reader reader;
  require_step_status(reader.ReadFile(path.c_str()));
  require_sound_entities(reader);
  const int roots = reader.NbRootsForTransfer();
  const int done = reader.TransferRoots();
  if (done < roots) {
    loaded.warnings.push_back("only " + std::to_string(done) + " of " + std::to_string(roots) +
                              " shapes of the file could be read");
  }
  loaded.shape = reader.OneShape();
  loaded.file_unit = step_unit(reader);
}

/// The reader with names and colours first; a file that trips it up is read for its shape alone.
LoadedShape load_step(const std::string& path) {
  STEPCAFControl_Controller::Init();  // defines the parameter of the face names, which could not be set before
  const StaticParameter millimetres("xstep.cascade.unit", "MM");
  const StaticParameter face_names("read.stepcaf.subshapes.name", "1");
  LoadedShape loaded;
  bool done = false;
  try {
    done = load_step_document(path, loaded);
  } catch (const Standard_Failure&) {
    done = false;
  }
  if (!done) {
    loaded = {};
    load_step_shape(path, loaded);
  }
  return loaded;
}

// ---- IGES ----------------------------------------------------------------------------------------------------------

LoadedShape load_iges(const std::string& path) {
  IGESControl_Controller::Init();
  const StaticParameter millimetres("xstep.cascade.unit", "MM");
  LoadedShape loaded;
  const Handle(TDocStd_Document) document = new_document();
  IGESCAFControl_Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) {
    fail(std::string("OpenCASCADE can't read the IGES file; ") + kExportAgain);
  }
  reader.Transfer(const_cast<Handle(TDocStd_Document)&>(document));
  loaded.shape = reader.OneShape();
  loaded.labels = read_labels(document);
  const Handle(TCollection_HAsciiString) unit = reader.IGESModel()->GlobalSection().UnitName();
  if (!unit.IsNull()) loaded.file_unit = unit->ToCString();
  std::transform(loaded.file_unit.begin(), loaded.file_unit.end(), loaded.file_unit.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  close(document);
  return loaded;
}

// ---- BREP ----------------------------------------------------------------------------------------------------------

LoadedShape load_brep(const std::string& path, CadFormat format) {
  LoadedShape loaded;
  const bool read = format == CadFormat::BinaryBrep ? BinTools::Read(loaded.shape, path.c_str())
                                                    : BRepTools::Read(loaded.shape, path.c_str(), BRep_Builder());
  if (!read) fail(std::string("OpenCASCADE can't read the BREP file; ") + kExportAgain);
  return loaded;
}

void require_faces(const LoadedShape& loaded, const std::string& path, CadFormat format) {
  if (!parts_of(loaded.shape, TopAbs_FACE).empty()) return;
  if (format == CadFormat::Iges && iges_overflows_column_64(path)) {
    fail(
        "no face can be read because data runs beyond column 64 of the parameter section; write the IGES file again "
        "with "
        "at most 64 columns of data a line");
  }
  fail("the file holds no face; export a solid, a shell or surfaces, not curves, points or meshes alone");
}

}  // namespace

LoadedShape load_shape(const std::string& path, CadFormat format) {
  const Silence silence;
  return translated(ErrorCode::Unreadable, "OpenCASCADE fails on the file", kExportAgain, [&] {
    LoadedShape loaded = format == CadFormat::Step   ? load_step(path)
                         : format == CadFormat::Iges ? load_iges(path)
                                                     : load_brep(path, format);
    require_faces(loaded, path, format);
    return loaded;
  });
}

}  // namespace geovor::occ
