#include "distance_json.h"

#include "io/atomic_file.h"

namespace geovor {
namespace {

Json place_json(const FacePlace& place) {
  return Json{{"uv", pair(place.uv)}, {"xyz", triple(place.xyz)}, {"moved", place.moved}};
}

Json point_json(const PathPoint& p) { return Json{{"s", p.s}, {"uv", pair(p.uv)}, {"xyz", triple(p.xyz)}}; }

/// null for a path of no length.
Json direction_json(double length, UvVec uv, const Xyz& tangent) {
  if (length == 0.0) return nullptr;
  return Json{{"uv", pair(uv)}, {"xyz", triple(tangent)}};
}

Json exit_json(const std::optional<FaceExit>& exit) {
  if (!exit) return nullptr;
  Json out = point_json(exit->out);
  out["back"] = exit->back ? point_json(*exit->back) : Json(nullptr);
  return out;
}

Json path_json(const FacePath& path) {
  const Connection& c = path.connection;
  return Json{{"length", c.length},
              {"start_direction", direction_json(c.length, c.start_direction, path.points.front().tangent)},
              {"end_direction", direction_json(c.length, c.end_direction, path.end_tangent)},
              {"y", c.y},
              {"residual", c.residual},
              {"points", each(path.points, [](size_t, const PathPoint& p) { return point_json(p); })},
              {"leaves_face", exit_json(path.exit)}};
}

}  // namespace

std::string distance_json(const DocumentSource& source, const FaceDistance& distance) {
  Json document = document_head("geovor-distance", source);
  document["surface"] = surface_json(source);
  document["from"] = place_json(distance.from);
  document["to"] = place_json(distance.to);
  document["length"] = distance.length();
  document["certain"] = distance.result.certainty != Certainty::None;
  document["why"] = explain(distance.result);
  document["stays_on_face"] = distance.stays_on_face ? Json(*distance.stays_on_face) : Json(nullptr);
  document["paths"] = each(distance.paths, [](size_t, const FacePath& path) { return path_json(path); });
  document["warnings"] = each(distance.warnings, [](size_t, const DistanceWarning& w) {
    return Json{{"kind", w.kind}, {"text", w.text}};
  });
  return document_text(document);
}

void write_distance_json(const DocumentSource& source, const FaceDistance& distance, const std::string& path) {
  write_file(path, distance_json(source, distance));
}

}  // namespace geovor
