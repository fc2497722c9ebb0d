// geovor voronoi: the geodesic Voronoi diagram of sites on one face.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "certificate_report.h"
#include "commands.h"
#include "context.h"
#include "diagram_json.h"
#include "face_list.h"
#include "io/diagram_html.h"
#include "io/diagram_svg.h"
#include "io/diagram_vtp.h"
#include "occ_adapter/read_cad.h"
#include "occ_adapter/write_cells.h"
#include "outputs.h"
#include "pipeline/cad_cells.h"
#include "pipeline/cell_mesh.h"
#include "pipeline/voronoi_face.h"
#include "progress.h"
#include "sites_file.h"
#include "stopwatch.h"

namespace geovor {
namespace {

/// Kinds of warnings that say that a part of the diagram is missing.
const std::set<std::string> kIncomplete = {"unresolved", "areas_differ", "cut_locus"};

VoronoiRequest request_of(const VoronoiArguments& arguments, const SitesFile& file) {
  VoronoiRequest request;
  for (const SiteRow& row : file.rows) {
    const auto [a, b, c] = row.values;
    if (file.in_space) {
      request.sites.emplace_back(Xyz(a, b, c));
    } else {
      request.sites.emplace_back(Uv{a, b});
    }
  }
  request.count = arguments.count;
  request.spacing = arguments.spacing;
  request.seed = arguments.seed;
  request.snap = arguments.snap;
  request.certify = arguments.certify;
  request.raster = std::any_of(arguments.outputs.begin(), arguments.outputs.end(),
                               [](const std::string& path) { return ending(path) == ".svg"; });
  return request;
}

/// What is wrong with a site, by the line of the sites file that it came from.
Error error_of_line(const SiteError& error, const std::string& path, const SitesFile& file) {
  const auto line = [&](int site) { return file.rows[static_cast<std::size_t>(site)].line; };
  const std::string where = error.other() < 0
                                ? fmt::format("line {}: the site", line(error.site()))
                                : fmt::format("lines {} and {}: the sites", line(error.site()), line(error.other()));
  return {error.code(), fmt::format("{}: {} {}", path, where, error.reason())};
}

VoronoiResult compute(const CadModel& model, const CadFace& face, const VoronoiArguments& arguments,
                      const SitesFile& file) {
  try {
    VoronoiRequest request = request_of(arguments, file);
    ProgressLine placing(arguments.progress, "sites placed"), progress(arguments.progress, "cells reached");
    request.placing = [&placing](int done, int total) {
      placing.show(done, total);
      return true;
    };
    request.progress = [&progress](int done, int total) {
      progress.show(done, total);
      return true;
    };
    return voronoi_face(model, face, request);
  } catch (const SiteError& error) {
    if (!file.rows.empty()) throw error_of_line(error, arguments.sites, file);
    throw Error(error.code(), fmt::format("{}: {}: {}", model.file, face_label(face.number), error.what()));
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}: {}: {}", model.file, face_label(face.number), error.what()));
  }
}

PageFacts page_facts(const CadModel& model, const CadFace& face, const VoronoiResult& result) {
  const std::string file = std::filesystem::path(model.file).filename().string();
  return {fmt::format("{} {}: {} sites", file, face_label(face.number), result.diagram.sites.size()), model.unit};
}

void write_output(const std::string& path, const std::string& place, const VoronoiArguments& arguments,
                  const CadModel& model, const CadFace& face, const VoronoiResult& result,
                  std::optional<CellMesh>& mesh) {
  const auto cell_mesh = [&]() -> const CellMesh& {
    if (!mesh) mesh = mesh_of_cells(model, face, result.diagram, result.deflection);
    return *mesh;
  };
  if (ending(path) == ".json") {
    write_diagram_json(document_source(model, face, result.parameters), result.diagram, result.dual,
                       result.certificate ? &*result.certificate : nullptr, place);
  } else if (ending(path).starts_with(".st")) {
    const CadSheet sheet = cad_cells(model, face, result.diagram, result.deflection);
    write_step(sheet, {arguments.input, face.number, model.unit}, place);
  } else if (ending(path) == ".vtp") {
    write_diagram_vtp(result.diagram, cell_mesh(), place);
  } else if (ending(path) == ".html") {
    write_diagram_html(result.diagram, cell_mesh(), page_facts(model, face, result), place);
  } else {
    write_diagram_svg(result.diagram, result.dual, result.raster, place);
  }
}

/// Writes all outputs, or none. But where this diagram can't take the form of one of them, the others are written all
/// the same: returned are those that were, and a line on stderr names each of the others.
std::vector<std::string> write_outputs(const VoronoiArguments& arguments, const CadModel& model, const CadFace& face,
                                       const VoronoiResult& result) {
  std::optional<CellMesh> mesh;
  StagedOutputs outputs;
  std::vector<std::string> written, refused;
  for (const std::string& path : arguments.outputs) {
    try {
      outputs.add(path,
                  [&](const std::string& place) { write_output(path, place, arguments, model, face, result, mesh); });
      written.push_back(path);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::FaceRejected) throw;
      refused.push_back(
          fmt::format("geovor: {}: {}: {}: {}\n", model.file, face_label(face.number), path, error.what()));
    }
  }
  outputs.commit();
  for (const std::string& line : refused) fmt::print(stderr, "{}", line);
  return written;
}

std::string warnings_text(const VoronoiDiagram& diagram) {
  std::map<std::string, int> counts;
  for (const DiagramWarning& warning : diagram.warnings) ++counts[warning.kind];
  std::string text;
  for (const auto& [kind, count] : counts) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, kind);
  return text.empty() ? "none" : text;
}

double largest_residual(const VoronoiDiagram& diagram) {
  double largest = 0.0;
  for (const DiagramVertex& vertex : diagram.vertices) largest = std::max(largest, vertex.residual);
  for (const DiagramEdge& edge : diagram.edges) largest = std::max(largest, edge.residual);
  return largest;
}

void print_summary(const CadModel& model, const CadFace& face, const VoronoiResult& result) {
  const VoronoiDiagram& diagram = result.diagram;
  double area = 0.0;
  for (const DiagramCell& cell : diagram.cells) area += cell.area;
  const auto line = [](const char* name, const std::string& value) { fmt::print("{:<17} {}\n", name, value); };
  line("face", fmt::format("{} ({}), area {:.8g} {}^2", face_label(face.number), to_string(result.surface->kind()),
                           result.face_area, model.unit));
  line("sites", std::to_string(diagram.sites.size()));
  line("vertices", std::to_string(diagram.vertices.size()));
  line("edges", std::to_string(diagram.edges.size()));
  line("cells", fmt::format("{}, together {:.6f} of the face", diagram.cells.size(), area / result.face_area));
  line("largest residual", fmt::format("{:.2g}", largest_residual(diagram)));
  line("Delaunay", result.dual.is_triangulation ? fmt::format("{} triangles", result.dual.triangles.size())
                                                : "no triangulation: " + result.dual.why_not);
  line("warnings", warnings_text(diagram));
}

/// A line on stderr where the diagram is not whole, with the first place that tells why; whether it is.
bool name_failure(const CadModel& model, const CadFace& face, const VoronoiDiagram& diagram) {
  const auto& all = diagram.warnings;
  const auto bad = [](const DiagramWarning& w) { return kIncomplete.count(w.kind) > 0; };
  const auto first = std::find_if(all.begin(), all.end(), bad);
  if (first == all.end()) return true;
  fmt::print(
      stderr,
      "geovor: {}: {}: the diagram is not whole ({} places, the first near u = {:.6g}, v = {:.6g}: {}); more sites, or "
      "other ones, may mend it\n",
      model.file, face_label(face.number), std::count_if(all.begin(), all.end(), bad), first->uv.u, first->uv.v,
      first->text);
  return false;
}

/// The claims on stdout; where one fails, a line on stderr that names it. Whether all hold.
bool print_certificate(const CadModel& model, const CadFace& face, const Certificate& certificate) {
  fmt::print("{}", certificate_text(certificate));
  const auto failed = failed_claim(certificate);
  if (failed) fmt::print(stderr, "geovor: {}: {}: {}\n", model.file, face_label(face.number), *failed);
  return !failed;
}

/// Not wrong, but not what was asked either: there the distances are those of the surface beyond the face.
void warn_of_exits(const CadModel& model, const CadFace& face, const VoronoiDiagram& diagram) {
  std::set<int> sites;
  const DiagramWarning* first = nullptr;
  for (const DiagramWarning& warning : diagram.warnings) {
    if (warning.kind != "path_leaves_face") continue;
    if (first == nullptr) first = &warning;
    sites.insert(warning.sites.begin(), warning.sites.end());
  }
  if (first == nullptr) return;
  fmt::print(stderr,
             "geovor: {}: {}: warning: shortest paths leave the face (cells of {} sites, first near u = {:.6g}, v = "
             "{:.6g}); distances there are those of the surface continued, see \"warnings\" in the JSON\n",
             model.file, face_label(face.number), sites.size(), first->uv.u, first->uv.v);
}

}  // namespace

int run(const VoronoiArguments& arguments) {
  check_outputs(arguments.outputs, arguments.input, arguments.sites, "sites file");
  const SitesFile file = arguments.sites.empty() ? SitesFile{} : read_sites_file(arguments.sites);
  if (arguments.snap && !file.in_space) {
    throw Error(ErrorCode::Usage,
                arguments.sites + ": --snap moves sites in space, and these are u,v; leave it out, or give x,y,z");
  }
  Stopwatch watch;
  const CadModel model = in_context(arguments.input, [&] { return read_cad(arguments.input); });
  const double seconds_read = watch.lap();
  const CadFace& face =
      in_context(arguments.input, [&]() -> const CadFace& { return chosen_face(model, arguments.face); });
  const VoronoiResult result = compute(model, face, arguments, file);
  const double seconds_diagram = watch.lap();
  if (!std::isfinite(largest_residual(result.diagram))) {
    throw Error(
        ErrorCode::FaceRejected,
        fmt::format("{}: {}: the diagram of these sites could not be finished; more sites, or other ones, may mend it",
                    model.file, face_label(face.number)));
  }
  const std::vector<std::string> written = write_outputs(arguments, model, face, result);
  const bool complete = name_failure(model, face, result.diagram);
  if (complete) warn_of_exits(model, face, result.diagram);
  print_summary(model, face, result);
  const bool proved = !result.certificate || print_certificate(model, face, *result.certificate);
  fmt::print("{:<17} read {:.2f}, diagram {:.2f}, write {:.2f}\n", "seconds", seconds_read, seconds_diagram,
             watch.lap());
  for (const std::string& path : written) fmt::print("{:<17} {}\n", "wrote", path);
  const bool all = written.size() == arguments.outputs.size();
  return all && complete && proved ? 0 : static_cast<int>(ErrorCode::FaceRejected);
}

}  // namespace geovor
