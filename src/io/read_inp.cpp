#include <algorithm>
#include <map>

#include "io/mesh_builder.h"
#include "io/mesh_readers.h"
#include "io/mesh_text.h"

namespace geovor {
namespace {

/// The corners of a surface element of this type (S3, STRI65, CPS4R, …); 0 for elements of other kinds.
int corners_of(const std::string& type) {
  static const std::map<std::string, int> corners = {
      {"S3", 3},    {"S3R", 3},   {"S3RS", 3},   {"STRI3", 3}, {"STRI65", 3}, {"S6", 3},   {"CPS3", 3},
      {"CPE3", 3},  {"CPS6", 3},  {"CPE6", 3},   {"CAX3", 3},  {"CAX6", 3},   {"M3D3", 3}, {"M3D6", 3},
      {"DS3", 3},   {"R3D3", 3},  {"SFM3D3", 3}, {"S4", 4},    {"S4R", 4},    {"S8", 4},   {"S8R", 4},
      {"CPS4", 4},  {"CPS4R", 4}, {"CPE4", 4},   {"CPE4R", 4}, {"CPS8", 4},   {"CPE8", 4}, {"M3D4", 4},
      {"M3D4R", 4}, {"M3D8", 4},  {"DS4", 4},    {"R3D4", 4},  {"SFM3D4", 4}, {"T3D3", 0}};
  const auto found = corners.find(type);
  return found == corners.end() ? 0 : found->second;
}

/// The value of NAME=value on a keyword line; empty where there is none.
std::string option(std::string_view line, const std::string& name) {
  MeshText words(line, ",");
  words.any_line();
  for (std::string_view w = words.word(); !w.empty(); w = words.word()) {
    const std::size_t equals = w.find('=');
    if (equals == w.npos || lower_case(w.substr(0, equals)) != name) continue;
    const std::string_view value = w.substr(equals + 1);
    return std::string(value.empty() ? words.word() : value);
  }
  return {};
}

std::string upper_case(std::string text) {
  for (char& c : text) c = static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
  return text;
}

}  // namespace

// Nodes and surface elements; assemblies of instances are not followed. An element may run over several lines.
LoadedMesh read_inp(std::string_view bytes) {
  enum class Part { Other, Nodes, Elements } part = Part::Other;
  MeshBuilder builder;
  MeshText text(bytes, ",");
  std::map<long, int> point_of;
  int corners = 0, group = -1;
  while (text.next_line()) {
    const std::string_view line = text.line();
    if (line.starts_with("**")) continue;
    if (line.starts_with("*")) {
      const std::string keyword = lower_case(text.word());
      part = keyword == "*node" ? Part::Nodes : keyword == "*element" ? Part::Elements : Part::Other;
      if (part != Part::Elements) continue;
      corners = corners_of(upper_case(option(line, "type")));
      const std::string set = option(line, "elset");
      group = set.empty() || corners == 0 ? -1 : builder.group(set);
    } else if (part == Part::Nodes) {
      point_of[text.whole()] = builder.points();
      builder.point(text.point());
    } else if (part == Part::Elements && corners == 0) {
      builder.other_element();
    } else if (part == Part::Elements) {
      text.whole();
      std::vector<int> element;
      for (int i = 0; i < corners; ++i) {
        const auto found = point_of.find(text.whole());
        element.push_back(found == point_of.end() ? -1 : found->second);
      }
      while (text.line().find_last_not_of(" \t\r") != std::string_view::npos &&
             text.line()[text.line().find_last_not_of(" \t\r")] == ',' && text.any_line()) {
      }
      builder.polygon(element, group);
    }
  }
  return builder.finish(text.digits());
}

}  // namespace geovor
