// geovor mesh: from a CAD file to a triangle mesh.
#include <fmt/format.h>

#include <chrono>
#include <numbers>

#include "base/error.h"
#include "commands.h"
#include "context.h"
#include "face_list.h"
#include "io/atomic_file.h"
#include "io/mesh_picture.h"
#include "io/write_obj.h"
#include "io/write_stl.h"
#include "mesh_report.h"
#include "occ_adapter/read_cad.h"
#include "occ_adapter/write_step.h"
#include "outputs.h"
#include "parallel.h"

namespace geovor {
namespace {

/// Seconds since the last call or the construction.
class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

MeshOptions mesh_options(const MeshRequest& request, ProgressLine& progress) {
  MeshOptions options;
  options.size = request.size;
  options.min_size = request.min_size;
  options.deflection = request.deflection;
  options.angle = request.angle * std::numbers::pi / 180.0;
  options.gradation = request.gradation;
  options.faces = request.faces;
  options.for_each = for_each_on(request.threads);
  options.progress = [&progress](int done, int total) {
    progress.show(done, total);
    return true;
  };
  return options;
}

void write_mesh(const TriangleMesh& mesh, const std::string& unit, bool ascii, const std::string& path) {
  const std::string format = ending(path);
  if (format == ".stl") {
    write_stl(mesh, path, ascii ? StlForm::Ascii : StlForm::Binary);
  } else if (format == ".obj") {
    write_obj(mesh, path);
  } else if (format == ".svg") {
    write_mesh_picture(mesh, path);
  } else {
    write_step(mesh, unit, path);
  }
}

void write_outputs(MeshSummary& summary, Stopwatch& watch) {
  const MeshRequest& request = *summary.request;
  StagedOutputs outputs;
  for (const std::string& path : request.outputs) {
    if (summary.result->mesh.triangles.empty()) break;
    outputs.add(path, [&](const std::string& place) {
      write_mesh(summary.result->mesh, summary.model->unit, request.ascii, place);
    });
  }
  summary.seconds_write = watch.lap();
  if (!request.report.empty()) {
    outputs.add(request.report, [&](const std::string& place) { write_file(place, report_json(summary)); });
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

int run(const MeshRequest& request) {
  std::vector<std::string> paths = request.outputs;
  if (!request.report.empty()) paths.push_back(request.report);
  check_outputs(paths, request.input);
  Stopwatch watch;
  const CadModel model = in_context(request.input, [&] {
    CadModel read = read_cad(request.input);
    check_faces_exist(request.faces, static_cast<int>(read.faces.size()));
    return read;
  });
  const double seconds_read = watch.lap();
  const MeshResult result = in_context(request.input, [&] {
    ProgressLine progress(request.progress, "faces meshed");
    return mesh_model(model, mesh_options(request, progress));
  });
  watch.lap();
  MeshSummary summary = summarize(model, request, result);
  summary.seconds_read = seconds_read;
  summary.seconds_checks = watch.lap();
  name_failures(summary);
  const bool wanted = summary.complete() || !request.strict;
  if (wanted) write_outputs(summary, watch);
  fmt::print("{}", summary_text(summary));
  const bool has_mesh = !result.mesh.triangles.empty();
  for (const std::string& path : paths) {
    if (wanted && (has_mesh || path == request.report)) fmt::print("{:<17} {}\n", "wrote", path);
  }
  return summary.complete() ? 0 : static_cast<int>(ErrorCode::FaceRejected);
}

}  // namespace geovor
