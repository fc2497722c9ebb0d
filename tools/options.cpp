#include "options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "base/error.h"
#include "face_list.h"
#include "outputs.h"

namespace geovor {
namespace {

const std::vector<std::string> kMeshEndings = {".stl", ".step", ".stp", ".obj", ".svg"};

const char* const kFooter =
    "Lengths are in the unit of the input file (geovor info prints it). Faces are numbered as FreeCAD numbers them: "
    "Face1,\n"
    "Face2, ...\n"
    "Exit codes: 0 all done; 1 wrong use; 2 the input can't be read or holds no face; 3 some face was not finished;\n"
    "4 an output can't be written; 70 a fault of geovor; 130 interrupted.";

/// A check that an option's text is a finite number above zero (or not below it, where `zero_too`).
CLI::Validator length_check(bool zero_too) {
  return CLI::Validator(
      [zero_too](std::string& text) -> std::string {
        double value = 0.0;
        const bool is_number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
        if (is_number && (value > 0.0 || (zero_too && value == 0.0))) return {};
        return fmt::format("'{}' won't do; give a number {}", text, zero_too ? "of 0 or more" : "greater than 0");
      },
      "");
}

CLI::Validator whole_number_check(int least) {
  return CLI::Validator(
      [least](std::string& text) -> std::string {
        int value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= least) return {};
        return fmt::format("'{}' won't do; give a whole number of {} or more", text, least);
      },
      "");
}

/// -o takes one path each time it is written, so that the input may follow it.
CLI::Option* add_outputs(CLI::App& command, std::vector<std::string>& outputs, const std::string& formats) {
  return command
      .add_option("-o,--output", outputs, "Output, may be given several times; the ending says what: " + formats)
      ->required()
      ->allow_extra_args(false)
      ->type_name("FILE");
}

CLI::Option* add_input(CLI::App& command, std::string& input) {
  return command.add_option("INPUT", input, "CAD file: .step .stp .p21 .iges .igs .brep")->required()->type_name("");
}

void add_info(CLI::App& app, InfoRequest& request) {
  CLI::App* command = app.add_subcommand("info", "Print what is in a CAD file, one row a face");
  add_input(*command, request.input);
  command->add_flag("--json", request.json, "Print JSON");
}

void add_mesh(CLI::App& app, MeshRequest& request, std::string& faces, bool& progress) {
  CLI::App* command = app.add_subcommand("mesh", "Mesh the faces of a CAD file with triangles");
  add_input(*command, request.input);
  add_outputs(*command, request.outputs, ".stl .step .stp .obj .svg (a picture)");
  const auto length = [&](const char* name, double& value, const char* help, bool zero_too = false) {
    return command->add_option(name, value, help)->check(length_check(zero_too))->type_name("LENGTH");
  };
  length("--size", request.size, "The length that an edge is to have")->required();
  length("--min-size", request.min_size, "No rule asks for less than this (default: a twentieth of --size)");
  length("--deflection", request.deflection, "Largest distance from a triangle to the face (default: no limit)");
  length("--angle", request.angle, "Largest turn of the normal across an edge, degrees (default: 15)")
      ->type_name("DEG");
  length("--gradation", request.gradation, "How fast the size may grow with distance (default: 0.5)")->type_name("G");
  command->add_option("--faces", faces, "Faces to mesh, such as 1,4-9,Face12 (default: all)")->type_name("LIST");
  command->add_option("--threads", request.threads, "Threads to use (default: all cores)")
      ->check(whole_number_check(1))
      ->type_name("N");
  command->add_option("--report", request.report, "Write what was done, face by face, as JSON")->type_name("FILE.json");
  command->add_flag("--progress,!--no-progress", progress, "Progress on stderr (default: where that is a terminal)");
  command->add_flag("--ascii", request.ascii, "Write .stl as text");
  command->add_flag("--strict", request.strict, "Write nothing unless every face was meshed");
}

/// CLI11's messages run over several lines and end in full stops; ours are one line.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text;
}

[[noreturn]] void fail(const CLI::App& app, const std::string& message) {
  const auto commands = app.get_subcommands();
  const std::string command = commands.empty() ? "" : " " + commands.front()->get_name();
  throw Error(ErrorCode::Usage, fmt::format("{}; see geovor{} --help", one_line(message), command));
}

Request checked(MeshRequest request, const std::string& faces, const CLI::Option& progress, bool wants_progress) {
  check_endings(request.outputs, kMeshEndings);
  if (!faces.empty()) request.faces = parse_face_list(faces);
  if (progress.count() > 0) request.progress = wants_progress ? ProgressWish::Always : ProgressWish::Never;
  if (request.min_size > request.size) {
    throw Error(ErrorCode::Usage,
                fmt::format("--min-size {} is above --size {}; lower it", request.min_size, request.size));
  }
  return request;
}

}  // namespace

Request parse_command_line(int argc, const char* const* argv) {
  CLI::App app("geovor: geodesic Voronoi diagrams and Delaunay meshes on CAD surfaces", "geovor");
  app.set_version_flag("--version", "geovor " GEOVOR_VERSION);
  app.footer(kFooter);
  app.require_subcommand(1);
  InfoRequest info;
  MeshRequest mesh;
  std::string mesh_faces;
  bool wants_progress = false;
  add_info(app, info);
  add_mesh(app, mesh, mesh_faces, wants_progress);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) fail(app, error.what());
    app.exit(error);  // help or version
    return NothingRequest{};
  }
  if (app.got_subcommand("info")) return info;
  return checked(mesh, mesh_faces, *app.get_subcommand("mesh")->get_option("--progress"), wants_progress);
}

}  // namespace geovor
