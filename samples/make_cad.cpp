// Writes the sample CAD files: make_samples DIRECTORY. What they hold is told in README.md beside this file.
#include <Standard_Failure.hxx>
#include <TopoDS_Shape.hxx>
#include <iostream>

#include "make_cad/shapes.h"
#include "make_cad/write.h"

namespace {

struct Sample {
  const char* name;
  TopoDS_Shape (*make)();
  const char* unit = "MM";
};

constexpr Sample kStepFiles[] = {
    {"wave", make_cad::wave},
    {"paraboloid", make_cad::paraboloid},
    {"bumps", make_cad::bumps},
    {"freeform", make_cad::freeform},
    {"freeform_refined", make_cad::freeform_refined},
    {"freeform_swapped", make_cad::freeform_swapped},
    {"freeform_moebius", make_cad::freeform_moebius},
    {"freeform_trimmed", make_cad::freeform_trimmed},
    {"cylinder", make_cad::cylinder},
    {"cylinder_tube", make_cad::cylinder_tube},
    {"sphere", make_cad::sphere},
    {"torus", make_cad::torus},
    {"cone", make_cad::cone},
    {"plate", make_cad::plate},
    {"plate_inch", make_cad::plate, "INCH"},
    {"plate_metre", make_cad::plate, "M"},
    {"bracket", make_cad::bracket},
    {"flat", make_cad::flat},
};

constexpr Sample kIgesFiles[] = {{"wave", make_cad::wave}, {"plate", make_cad::plate}};

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::cerr << "usage: make_samples DIRECTORY\n";
    return 1;
  }
  const std::string folder = std::string(argv[1]) + "/";
  for (const Sample& s : kStepFiles) make_cad::write_step(s.make(), s.name, s.unit, folder + s.name + ".step");
  for (const Sample& s : kIgesFiles) make_cad::write_iges(s.make(), folder + s.name + ".iges");
  return 0;
} catch (const Standard_Failure& fault) {
  std::cerr << "make_samples: " << fault.DynamicType()->Name() << " " << fault.GetMessageString() << "\n";
  return 1;
} catch (const std::exception& fault) {
  std::cerr << "make_samples: " << fault.what() << "\n";
  return 1;
}
