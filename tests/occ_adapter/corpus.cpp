#include "occ_adapter/corpus.h"

#include <unistd.h>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Reader.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Reader.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>

#include <cstdlib>
#include <filesystem>

namespace geovor::test {

namespace fs = std::filesystem;

std::string shared_file(const std::string& relative) {
  const char* named = std::getenv("GEOVOR_SHARED");
  const fs::path folder = named != nullptr ? fs::path(named) : fs::path(GEOVOR_SOURCE_DIR) / ".." / "shared";
  const fs::path path = folder / relative;
  return fs::exists(path) ? path.string() : std::string();
}

TopoDS_Shape read_by_occ(const std::string& path) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  const std::string ending = fs::path(path).extension().string();
  if (ending == ".step" || ending == ".stp") {
    STEPControl_Reader reader;
    reader.ReadFile(path.c_str());
    reader.TransferRoots();
    return reader.OneShape();
  }
  if (ending == ".iges" || ending == ".igs") {
    IGESControl_Reader reader;
    reader.ReadFile(path.c_str());
    reader.TransferRoots();
    return reader.OneShape();
  }
  TopoDS_Shape shape;
  BRepTools::Read(shape, path.c_str(), BRep_Builder());
  return shape;
}

std::vector<TopoDS_Face> faces_of(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, TopAbs_FACE, map);
  std::vector<TopoDS_Face> faces;
  for (int i = 1; i <= map.Extent(); ++i) faces.push_back(TopoDS::Face(map(i)));
  return faces;
}

std::string scratch_folder(const std::string& name) {
  // Of this process alone, because tests run at the same time; gone when it ends.
  struct Root {
    fs::path path = fs::temp_directory_path() / ("geovor-occ-adapter-" + std::to_string(::getpid()));
    ~Root() {
      std::error_code ignored;
      fs::remove_all(path, ignored);
    }
  };
  static const Root root;
  const fs::path folder = root.path / name;
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder.string();
}

std::vector<std::string> varied_files() {
  return {"corpus/dealii+dealii/tests__opencascade__step_files__wigley.step",
          "corpus/dealii+dealii/examples__step-54__input__DTMB-5415_bulbous_bow.iges",
          "corpus/mathLab+BladeX/tests__test_datasets__tip.iges",
          "corpus/LLNL+axom_data/quest__step__revolved_sphere.step",
          "corpus/Open-Cascade-SAS+OCCT/data__occ__bottle.brep",
          "corpus/Open-Cascade-SAS+OCCT/data__step__linkrods.step",
          "corpus/Open-Cascade-SAS+OCCT/data__occ__Propeller.rle",
          "corpus/Open-Cascade-SAS+OCCT/data__occ__Motor-c.brep",
          "corpus/CadQuery+AnalysisSitus/data__cad__BSplHelix.brep",
          "corpus/debian-netgen-doc/usr__share__doc__netgen__examples__frame.step",
          "corpus/DLR-SC+tigl/tests__TestData__nacelle.stp",
          "corpus/DLR-SC+tigl/tests__TestData__export__D150WithGuides_wing.igs",
          "faces/ftor_nurbsv100.step",
          "faces/fsph_nurbs.step",
          "faces/fsph_tilt.step",
          "faces/oct_axisin.step"};
}

}  // namespace geovor::test
