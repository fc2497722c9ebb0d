#include "mesh_formats.h"

#include <fmt/format.h>

#include "io/mesh_picture.h"
#include "io/mesh_writers.h"
#include "occ_adapter/write_brep.h"
#include "outputs.h"

namespace geovor {
namespace {

/// A writer that puts bytes into a stream, as one of the table.
template <void (*Put)(const LabelledMesh&, ByteStream&)>
void streamed(const LabelledMesh& mesh, const MeshArguments&, const std::string& path) {
  write_file(path, [&](ByteStream& out) { Put(mesh, out); });
}

void stl(const LabelledMesh& mesh, const MeshArguments& arguments, const std::string& path) {
  const StlForm form = arguments.ascii ? StlForm::Ascii : StlForm::Binary;
  write_file(path, [&](ByteStream& out) { put_stl(mesh.mesh, form, out); });
}

void step(const LabelledMesh& mesh, const MeshArguments& arguments, const std::string& path) {
  if (arguments.step_form == StepForm::Tessellated) {
    streamed<put_step_tessellation>(mesh, arguments, path);
    return;
  }
  // Files of this size take CAD systems minutes to open.
  constexpr std::size_t kManyFacets = 50'000;
  if (mesh.mesh.triangles.size() > kManyFacets) {
    fmt::print(
        stderr,
        "geovor: warning: {} triangles are many for a faceted .step; --step-form tessellated writes a short one, "
        "a larger --size fewer triangles\n",
        mesh.mesh.triangles.size());
  }
  streamed<put_step_facets>(mesh, arguments, path);
}

void brep(const LabelledMesh& mesh, const MeshArguments&, const std::string& path) { write_brep(mesh.mesh, path); }

void picture(const LabelledMesh& mesh, const MeshArguments&, const std::string& path) {
  write_mesh_picture(mesh.mesh, path);
}

}  // namespace

const std::vector<MeshFormat>& mesh_formats() {
  static const std::vector<MeshFormat> formats = {
      {".stl", "", stl},
      {".step", "", step},
      {".stp", "", step},
      {".brep", "", brep},
      {".obj", "", streamed<put_obj>},
      {".ply", "", streamed<put_ply>},
      {".vtp", "(ParaView)", streamed<put_mesh_vtp>},
      {".msh", "(Gmsh)", streamed<put_msh>},
      {".inp", "(Abaqus)", streamed<put_inp>},
      {".unv", "", streamed<put_unv>},
      {".glb", "", streamed<put_glb>},
      {".html", "(a page that turns)", streamed<put_mesh_html>},
      {".svg", "(a picture)", picture},
  };
  return formats;
}

std::vector<std::string> mesh_format_endings() {
  std::vector<std::string> endings;
  for (const MeshFormat& format : mesh_formats()) endings.emplace_back(format.ending);
  return endings;
}

std::string mesh_format_list() {
  std::string text;
  for (const MeshFormat& format : mesh_formats()) {
    text += fmt::format("{}{}{}{}", text.empty() ? "" : " ", format.ending, *format.note ? " " : "", format.note);
  }
  return text;
}

void write_mesh(const LabelledMesh& mesh, const MeshArguments& arguments, const std::string& path) {
  const std::string format = ending(path);
  for (const MeshFormat& known : mesh_formats()) {
    if (format == known.ending) known.write(mesh, arguments, path);
  }
}

}  // namespace geovor
