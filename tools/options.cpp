#include "options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "context.h"
#include "face_list.h"
#include "mesh_formats.h"
#include "numbers.h"
#include "outputs.h"

namespace geovor {
namespace {

const std::vector<std::string> kVoronoiEndings = {".json", ".step", ".stp", ".svg", ".vtp", ".html"};
const std::vector<std::string> kDistanceEndings = {".json", ".step", ".stp", ".svg"};
const std::vector<std::string> kCheckEndings = {".svg", ".html", ".json"};
const std::vector<std::string> kReportEndings = {".json"};

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
        return fmt::format("'{}' won't do; give a whole number from {} to {}", text, least,
                           std::numeric_limits<int>::max());
      },
      "");
}

const std::string kFaceted = "faceted", kTessellated = "tessellated";

CLI::Validator step_form_check() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        if (text == kFaceted || text == kTessellated) return {};
        return fmt::format("'{}' won't do; give {} or {}", text, kFaceted, kTessellated);
      },
      "");
}

CLI::Option* add_face(CLI::App& command, std::string& face) {
  return command.add_option("--face", face, "The face, such as 3 or Face3 (not needed where the file has one)")
      ->type_name("N");
}

/// -o takes one path each time it is written, so that the input may follow it.
CLI::Option* add_outputs(CLI::App& command, std::vector<std::string>& outputs, const std::string& formats) {
  return command
      .add_option("-o,--output", outputs, "Output, may be given several times; the ending says what: " + formats)
      ->allow_extra_args(false)
      ->type_name("FILE");
}

CLI::Option* add_input(CLI::App& command, std::string& input) {
  return command.add_option("INPUT", input, "CAD file: .step .stp .p21 .iges .igs .brep")->required()->type_name("");
}

void add_progress(CLI::App& command) {
  CLI::Option* always =
      command.add_flag("--progress")->description("Progress on stderr, even where that is no terminal");
  command.add_flag("--no-progress")->description("No progress on stderr")->excludes(always);
}

ProgressWish progress_wish(const CLI::App& command) {
  if (command.count("--progress") > 0) return ProgressWish::Always;
  return command.count("--no-progress") > 0 ? ProgressWish::Never : ProgressWish::WhereTerminal;
}

void add_info(CLI::App& app, InfoArguments& arguments) {
  CLI::App* command = app.add_subcommand("info", "Print what is in a CAD file, one row a face");
  add_input(*command, arguments.input);
  command->add_flag("--json", arguments.json, "Print JSON");
}

void add_mesh(CLI::App& app, MeshArguments& arguments, std::string& faces) {
  CLI::App* command = app.add_subcommand("mesh", "Mesh the faces of a CAD file with triangles");
  add_input(*command, arguments.input);
  add_outputs(*command, arguments.outputs, mesh_format_list())->required();
  const auto length = [&](const char* name, double& value, const char* help, bool zero_too = false) {
    return command->add_option(name, value, help)->check(length_check(zero_too))->type_name("LENGTH");
  };
  length("--size", arguments.size, "The length that an edge is to have")->required();
  length("--min-size", arguments.min_size,
         "No rule asks for less than this (default: a twentieth of --size, or of a tenth of the part where --size is "
         "more)");
  length("--deflection", arguments.deflection, "Largest distance from a triangle to the face (default: no limit)");
  length("--angle", arguments.angle, "Largest turn of the normal across an edge, degrees (default: 15)")
      ->type_name("DEG");
  length("--gradation", arguments.gradation, "How fast the size may grow with distance (default: 0.5)")->type_name("G");
  command->add_option("--sizes", arguments.sizes, "CSV file face,size[,deflection,angle]: rules of single faces")
      ->type_name("FILE");
  command->add_option("--faces", faces, "Faces to mesh, such as 1,4-9,Face12 (default: all)")->type_name("LIST");
  command->add_option("--threads", arguments.threads, "Threads to use (default: all cores)")
      ->check(whole_number_check(1))
      ->type_name("N");
  command->add_option("--report", arguments.report, "Write what was done, face by face, as JSON")
      ->type_name("FILE.json");
  add_progress(*command);
  command
      ->add_option_function<std::string>(
          "--step-form",
          [&arguments](const std::string& form) {
            arguments.step_form = form == kTessellated ? StepForm::Tessellated : StepForm::Faceted;
          },
          "How .step holds triangles: faceted (a planar face each; the default) or tessellated (AP242, short)")
      ->check(step_form_check())
      ->type_name("FORM");
  command->add_flag("--ascii", arguments.ascii, "Write .stl as text");
  command->add_flag("--strict", arguments.strict, "Write nothing unless every face was meshed");
}

void add_voronoi(CLI::App& app, VoronoiArguments& arguments, std::string& face) {
  CLI::App* command = app.add_subcommand("voronoi", "Compute the geodesic Voronoi diagram of sites on one face");
  add_input(*command, arguments.input);
  add_outputs(*command, arguments.outputs, ".json .step .stp (cells as faces) .svg .vtp (ParaView) .html")->required();
  add_face(*command, face);
  CLI::Option* sites =
      command->add_option("--sites", arguments.sites, "CSV file with the header u,v or x,y,z")->type_name("FILE");
  CLI::Option* count = command->add_option("--count", arguments.count, "Place so many sites, evenly")
                           ->check(whole_number_check(1))
                           ->type_name("N");
  CLI::Option* spacing = command->add_option("--spacing", arguments.spacing, "Place sites about so far apart")
                             ->check(length_check(false))
                             ->type_name("LENGTH");
  command->add_option("--seed", arguments.seed, "Another number places other sites (default: 0)")
      ->check(whole_number_check(0))
      ->excludes(sites)
      ->type_name("S");
  command->add_flag("--snap", arguments.snap, "Move sites in space onto the face, however far they are")->needs(sites);
  command->add_flag("--certify", arguments.certify, "Prove the diagram, or say what is wrong with it");
  add_progress(*command);
  sites->excludes(count)->excludes(spacing);
  count->excludes(spacing);
}

void add_distance(CLI::App& app, DistanceArguments& arguments, std::string& face) {
  CLI::App* command = app.add_subcommand("distance", "Compute the shortest path between two points of one face");
  add_input(*command, arguments.input);
  add_outputs(*command, arguments.outputs, ".json .step .stp (curves) .svg (a picture)");
  add_face(*command, face);
  const auto point = [&](const char* name, std::string& text, const char* help) {
    command->add_option(name, text, help)->required()->type_name("P");
  };
  point("--from", arguments.from_text, "Where the path starts: u,v or x,y,z");
  point("--to", arguments.to_text, "Where it ends: u,v or x,y,z");
  command->add_flag("--snap", arguments.snap, "Move points that are off the face onto it, however far they are");
}

void add_check(CLI::App& app, CheckArguments& arguments) {
  CLI::App* command = app.add_subcommand("check", "Measure a mesh, also another program's, against its CAD file");
  command->add_option("MESH", arguments.mesh, "Mesh: .stl .obj .ply .off .vtp .msh .inp")->required()->type_name("");
  command->add_option("--against", arguments.against, "CAD file that the mesh stands for")
      ->required()
      ->type_name("INPUT");
  command->add_flag("--json", arguments.json, "Print JSON");
  add_outputs(*command, arguments.outputs, ".svg .html (a sheet of the worst places) .json");
  command->add_option("--threads", arguments.threads, "Threads to use (default: all cores)")
      ->check(whole_number_check(1))
      ->type_name("N");
  command->footer(
      "The exit code is 0 where the mesh was measured, good or bad; 2 where it or the CAD file can't be read; 3 where "
      "no\n"
      "face of the CAD can be used. Lengths are in the unit of the CAD file as geovor info prints it: the mesh's "
      "numbers\n"
      "are taken to be in the same unit.");
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
  if (const auto rest = app.remaining(); commands.empty() && !rest.empty()) {
    throw Error(ErrorCode::Usage, fmt::format("'{}' is no command; see geovor --help", rest.front()));
  }
  const std::string command = commands.empty() ? "" : " " + commands.front()->get_name();
  throw Error(ErrorCode::Usage, fmt::format("{}; see geovor{} --help", one_line(message), command));
}

std::optional<int> face_of(const std::string& text, const std::string& input, const CLI::App& command) {
  if (command.count("--face") == 0) return std::nullopt;
  return in_context(input, [&] { return parse_face(text); });
}

CommandLine checked(MeshArguments arguments, const std::string& faces, const CLI::App& command) {
  check_endings(arguments.outputs, mesh_format_endings());
  if (command.count("--report") > 0) check_endings({arguments.report}, kReportEndings);
  if (command.count("--faces") > 0) {
    arguments.faces = in_context(arguments.input, [&] { return parse_face_list(faces); });
  }
  arguments.progress = progress_wish(command);
  if (command.count("--sizes") > 0 && arguments.sizes.empty()) {
    throw Error(ErrorCode::Usage, "--sizes names no file; give it the path of a CSV file");
  }
  if (arguments.min_size > arguments.size) {
    throw Error(ErrorCode::Usage,
                fmt::format("--min-size {} is above --size {}; lower it", arguments.min_size, arguments.size));
  }
  return arguments;
}

CommandLine checked(VoronoiArguments arguments, const std::string& face, const CLI::App& command) {
  check_endings(arguments.outputs, kVoronoiEndings);
  arguments.face = face_of(face, arguments.input, command);
  arguments.progress = progress_wish(command);
  if (arguments.sites.empty() && arguments.count == 0 && arguments.spacing == 0.0) {
    throw Error(ErrorCode::Usage, "voronoi needs sites; give --sites FILE, --count N or --spacing LENGTH");
  }
  return arguments;
}

CommandLine checked(DistanceArguments arguments, const std::string& face, const CLI::App& command) {
  check_endings(arguments.outputs, kDistanceEndings);
  arguments.face = face_of(face, arguments.input, command);
  arguments.from = in_context("--from", [&] { return parse_point(arguments.from_text); });
  arguments.to = in_context("--to", [&] { return parse_point(arguments.to_text); });
  return arguments;
}

CommandLine checked(CheckArguments arguments) {
  check_endings(arguments.outputs, kCheckEndings);
  return arguments;
}

}  // namespace

CommandLine parse_command_line(int argc, const char* const* argv) {
  CLI::App app("geovor: geodesic Voronoi diagrams and Delaunay meshes on CAD surfaces", "geovor");
  app.set_version_flag("--version", "geovor " GEOVOR_VERSION);
  app.footer(kFooter);
  app.require_subcommand(1);
  InfoArguments info;
  MeshArguments mesh;
  VoronoiArguments voronoi;
  DistanceArguments distance;
  CheckArguments check;
  std::string mesh_faces, face;
  add_info(app, info);
  add_mesh(app, mesh, mesh_faces);
  add_voronoi(app, voronoi, face);
  add_distance(app, distance, face);
  add_check(app, check);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) fail(app, error.what());
    app.exit(error);  // help or version
    return NoArguments{};
  }
  if (app.got_subcommand("info")) return info;
  if (app.got_subcommand("voronoi")) return checked(voronoi, face, *app.get_subcommand("voronoi"));
  if (app.got_subcommand("distance")) return checked(distance, face, *app.get_subcommand("distance"));
  if (app.got_subcommand("check")) return checked(check);
  return checked(mesh, mesh_faces, *app.get_subcommand("mesh"));
}

}  // namespace geovor
