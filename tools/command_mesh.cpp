// geovor mesh: from a CAD file to a triangle mesh.
#include <fmt/format.h>

#include <filesystem>
#include <numbers>

#include "base/error.h"
#include "commands.h"
#include "context.h"
#include "face_list.h"
#include "io/atomic_file.h"
#include "mesh_formats.h"
#include "mesh_report.h"
#include "occ_adapter/read_cad.h"
#include "outputs.h"
#include "parallel.h"
#include "pipeline/face_labels.h"
#include "sizes_file.h"
#include "stopwatch.h"

namespace geovor {
namespace {

MeshOptions mesh_options(const MeshArguments& arguments, const std::vector<FaceRule>& rules, ProgressLine& progress) {
  MeshOptions options;
  options.size = arguments.size;
  options.min_size = arguments.min_size;
  options.deflection = arguments.deflection;
  options.angle = arguments.angle * std::numbers::pi / 180.0;
  options.gradation = arguments.gradation;
  options.face_rules = rules;
  options.faces = arguments.faces;
  options.for_each = for_each_on(arguments.threads);
  options.progress = [&progress](int done, int total) {
    progress.show(done, total);
    return true;
  };
  return options;
}

void write_outputs(MeshSummary& summary, Stopwatch& watch) {
  const MeshArguments& arguments = *summary.arguments;
  const std::string title = std::filesystem::path(arguments.input).filename().string();
  const LabelledMesh mesh{summary.result->mesh, face_labels(*summary.model), title, summary.model->unit};
  StagedOutputs outputs;
  for (const std::string& path : arguments.outputs) {
    if (mesh.mesh.triangles.empty()) break;
    outputs.add(path, [&](const std::string& place) { write_mesh(mesh, arguments, place); });
  }
  summary.seconds_write = watch.lap();
  if (!arguments.report.empty()) {
    outputs.add(arguments.report, [&](const std::string& place) { write_file(place, report_json(summary)); });
  }
  outputs.commit();
}

/// A line on stderr for every face that was not meshed whole.
void name_failures(const MeshSummary& summary) {
  for (const FaceReport& face : summary.result->faces) {
    if (face.status == FaceStatus::Meshed) continue;
    fmt::print(stderr, "geovor: {}: {}: {}\n", summary.model->file, face_label(face.face), face.why);
  }
}

}  // namespace

int run(const MeshArguments& arguments) {
  std::vector<std::string> paths = arguments.outputs;
  if (!arguments.report.empty()) paths.push_back(arguments.report);
  check_outputs(paths, arguments.input, arguments.sizes, "sizes file");
  Stopwatch watch;
  const CadModel model = in_context(arguments.input, [&] {
    CadModel read = read_cad(arguments.input);
    check_faces_exist(arguments.faces, static_cast<int>(read.faces.size()));
    return read;
  });
  const std::vector<FaceRule> rules =
      arguments.sizes.empty() ? std::vector<FaceRule>{} : read_sizes_file(arguments.sizes, model);
  const double seconds_read = watch.lap();
  const MeshResult result = in_context(arguments.input, [&] {
    ProgressLine progress(arguments.progress, "faces meshed");
    return mesh_model(model, mesh_options(arguments, rules, progress));
  });
  watch.lap();
  MeshSummary summary = summarize(model, arguments, result);
  summary.seconds_read = seconds_read;
  summary.seconds_checks = watch.lap();
  name_failures(summary);
  const bool wanted = summary.complete() || !arguments.strict;
  if (wanted) write_outputs(summary, watch);
  fmt::print("{}", summary_text(summary));
  const bool has_mesh = !result.mesh.triangles.empty();
  for (const std::string& path : paths) {
    if (wanted && (has_mesh || path == arguments.report)) fmt::print("{:<17} {}\n", "wrote", path);
  }
  return summary.complete() ? 0 : static_cast<int>(ErrorCode::FaceRejected);
}

}  // namespace geovor
