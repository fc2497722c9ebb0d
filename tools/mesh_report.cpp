#include "mesh_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace geovor {
namespace {

using Json = nlohmann::ordered_json;

const char* status_name(FaceStatus status) {
  switch (status) {
    case FaceStatus::Meshed:
      return "meshed";
    case FaceStatus::Rejected:
      return "rejected";
    case FaceStatus::Partial:
      return "partial";
    case FaceStatus::Stopped:
      return "stopped";
  }
  return "";
}

/// Relative difference of the areas in percent; 0 where there is no area.
double area_difference_percent(const MeshSummary& summary) {
  return summary.face_area > 0.0 ? 100.0 * (summary.mesh_area / summary.face_area - 1.0) : 0.0;
}

std::string closed_text(const MeshSummary& summary) {
  const MeshTopology& t = summary.topology;
  if (t.closed()) return fmt::format("yes, Euler number {}", t.euler());
  std::string text = fmt::format("no, {} border edges", t.border_edges);
  if (t.bad_edges > 0) text += fmt::format(", {} edges used more than twice", t.bad_edges);
  return text;
}

Json options_json(const MeshArguments& arguments, double smallest_size) {
  return {{"size", arguments.size},
          {"min_size", smallest_size},
          {"deflection", std::isfinite(arguments.deflection) ? Json(arguments.deflection) : Json(nullptr)},
          {"angle", arguments.angle},
          {"gradation", arguments.gradation},
          {"sizes", arguments.sizes.empty() ? Json(nullptr) : Json(arguments.sizes)},
          {"faces", arguments.faces},
          {"threads", arguments.threads},
          {"strict", arguments.strict},
          {"outputs", arguments.outputs}};
}

Json face_json(const CadModel& model, const FaceReport& face) {
  return {{"face", face.face},
          {"name", model.faces[static_cast<std::size_t>(face.face - 1)].name},
          {"status", status_name(face.status)},
          {"why", face.why},
          {"size", face.size},
          {"triangles", face.triangles},
          {"inverted", face.inverted},
          {"smallest_angle", face.smallest_angle},
          {"below_30_degrees", face.below_30.all},
          {"below_30_degrees_away_from_sharp_corners", face.below_30.away_from_corners},
          {"largest_distance", face.largest_distance},
          {"mesh_area", face.mesh_area},
          {"face_area", face.face_area},
          {"estimated_lengths", face.estimated_lengths},
          {"seconds", face.seconds}};
}

Json corner_json(const SharpCorner& corner) {
  return {{"face", corner.face},
          {"place", {corner.place.x(), corner.place.y(), corner.place.z()}},
          {"angle", corner.angle}};
}

Json topology_json(const MeshTopology& t) {
  return {{"vertices", t.vertices},         {"edges", t.edges},         {"triangles", t.triangles},
          {"border_edges", t.border_edges}, {"bad_edges", t.bad_edges}, {"components", t.components},
          {"closed", t.closed()},           {"euler_number", t.euler()}};
}

Json quality_json(const MeshQuality& q) {
  return {{"smallest_angle", q.smallest_angle},
          {"largest_angle", q.largest_angle},
          {"mean_smallest_angle", q.mean_smallest_angle},
          {"below_20_degrees", q.below_20},
          {"below_30_degrees", q.below_30},
          {"shortest_edge", q.shortest_edge},
          {"median_edge", q.median_edge},
          {"longest_edge", q.longest_edge},
          {"zero_area", q.zero_area},
          {"area", q.area},
          {"volume", q.volume}};
}

}  // namespace

MeshSummary summarize(const CadModel& model, const MeshArguments& arguments, const MeshResult& result) {
  MeshSummary summary;
  summary.model = &model;
  summary.arguments = &arguments;
  summary.result = &result;
  summary.topology = topology(result.mesh);
  summary.quality = quality(result.mesh);
  for (const FaceReport& face : result.faces) {
    summary.faces_meshed += face.status == FaceStatus::Meshed;
    summary.faces_partial += face.status == FaceStatus::Partial;
    summary.faces_rejected += face.status == FaceStatus::Rejected || face.status == FaceStatus::Stopped;
    if (face.triangles == 0) continue;
    summary.mesh_area += face.mesh_area;
    summary.face_area += face.face_area;
    summary.small_away_from_corners += face.below_30.away_from_corners;
    summary.largest_distance = std::max(summary.largest_distance, face.largest_distance);
  }
  return summary;
}

std::string summary_text(const MeshSummary& s) {
  const std::string& unit = s.model->unit;
  const MeshResult& result = *s.result;
  std::string faces = fmt::format("{} of {}", s.faces_meshed, result.faces.size());
  if (s.faces_partial > 0) faces += fmt::format(", {} partial", s.faces_partial);
  if (s.faces_rejected > 0) faces += fmt::format(", {} rejected", s.faces_rejected);
  std::string text;
  const auto line = [&text](const char* name, const std::string& value) {
    text += fmt::format("{:<17} {}\n", name, value);
  };
  line("faces", faces);
  line("triangles", fmt::format("{} ({} vertices)", s.topology.triangles, s.topology.vertices));
  line("closed", closed_text(s));
  line("smallest angle",
       fmt::format("{:.1f} deg (mean of the triangles' smallest {:.1f}; {} below 20, {} below 30)",
                   s.quality.smallest_angle, s.quality.mean_smallest_angle, s.quality.below_20, s.quality.below_30));
  line("sharp corners", fmt::format("{} below 30 deg; {} triangles below 30 are in none of them",
                                    result.sharp_corners.size(), s.small_away_from_corners));
  line("edge lengths", fmt::format("{:.4g} {:.4g} {:.4g} {} (shortest, median, longest)", s.quality.shortest_edge,
                                   s.quality.median_edge, s.quality.longest_edge, unit));
  line("largest distance", fmt::format("{:.4g} {} from the surface", s.largest_distance, unit));
  line("area",
       fmt::format("{:.8g} {}^2, {:+.4f} % beside the faces' own", s.mesh_area, unit, area_difference_percent(s)));
  line("seconds", fmt::format("read {:.2f}, borders {:.2f}, faces {:.2f}, checks {:.2f}, write {:.2f}", s.seconds_read,
                              result.seconds_borders, result.seconds_faces, s.seconds_checks, s.seconds_write));
  return text;
}

std::string report_json(const MeshSummary& s) {
  Json faces = Json::array();
  for (const FaceReport& face : s.result->faces) faces.push_back(face_json(*s.model, face));
  Json corners = Json::array();
  for (const SharpCorner& corner : s.result->sharp_corners) corners.push_back(corner_json(corner));
  const Json document = {{"format", "geovor-mesh-report"},
                         {"version", 1},
                         {"generator", "geovor " GEOVOR_VERSION},
                         {"input", s.model->file},
                         {"unit", s.model->unit},
                         {"options", options_json(*s.arguments, s.result->smallest_size)},
                         {"warnings", s.model->warnings},
                         {"totals",
                          {{"faces", s.result->faces.size()},
                           {"meshed", s.faces_meshed},
                           {"partial", s.faces_partial},
                           {"rejected", s.faces_rejected},
                           {"mesh_area", s.mesh_area},
                           {"face_area", s.face_area},
                           {"largest_distance", s.largest_distance},
                           {"below_30_degrees_away_from_sharp_corners", s.small_away_from_corners},
                           {"topology", topology_json(s.topology)},
                           {"quality", quality_json(s.quality)}}},
                         {"seconds",
                          {{"read", s.seconds_read},
                           {"borders", s.result->seconds_borders},
                           {"faces", s.result->seconds_faces},
                           {"checks", s.seconds_checks},
                           {"write", s.seconds_write}}},
                         {"sharp_corners", corners},
                         {"faces", faces}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace geovor
