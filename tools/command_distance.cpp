// geovor distance: the shortest path between two points of one face.
#include <fmt/format.h>

#include <string>
#include <utility>

#include "base/error.h"
#include "commands.h"
#include "context.h"
#include "distance_json.h"
#include "face_list.h"
#include "io/path_svg.h"
#include "occ_adapter/read_cad.h"
#include "occ_adapter/write_step.h"
#include "outputs.h"
#include "pipeline/distance_face.h"

namespace geovor {
namespace {

void line(const std::string& name, const std::string& value) { fmt::print("{:<17} {}\n", name, value); }

std::string words(Uv p) { return fmt::format("u, v = {:.10g}, {:.10g}", p.u, p.v); }
std::string words(const Xyz& x) { return fmt::format("x, y, z = {:.10g}, {:.10g}, {:.10g}", x.x(), x.y(), x.z()); }

PathPicture picture_of(const FaceDistances& face, const FaceDistance& distance) {
  PathPicture picture;
  picture.face = face.patches();
  picture.u_period = face.surface().u_period();
  picture.v_period = face.surface().v_period();
  picture.from = {distance.from.uv, distance.from.xyz};
  picture.to = {distance.to.uv, distance.to.xyz};
  for (const FacePath& path : distance.paths) {
    std::vector<PathPoint> cuts;
    if (path.exit) {
      cuts.push_back(path.exit->out);
      if (path.exit->back) cuts.push_back(*path.exit->back);
    }
    for (const PathPoint& cut : cuts) picture.exits.push_back({cut.uv, cut.xyz});
    PathPicture::Line now;
    for (const PathPoint& p : path.points) {
      now.uv.push_back(p.uv);
      now.xyz.push_back(p.xyz);
      if (cuts.empty() || p.s < cuts.front().s) continue;
      PathPicture::Line next{{p.uv}, {p.xyz}, !now.on_face};
      picture.lines.push_back(std::exchange(now, next));
      cuts.erase(cuts.begin());
    }
    picture.lines.push_back(now);
  }
  return picture;
}

std::vector<CadCurve> curves_of(const FaceDistances& face, const FaceDistance& distance) {
  std::vector<CadCurve> curves;
  for (const FacePath& path : distance.paths) {
    const std::string name = distance.paths.size() == 1 ? "path" : fmt::format("path {}", curves.size() + 1);
    curves.push_back(face.spline(path, name));
  }
  return curves;
}

void write_outputs(const DistanceArguments& arguments, const CadModel& model, const DocumentSource& source,
                   const FaceDistances& face, const FaceDistance& distance) {
  StagedOutputs outputs;
  for (const std::string& path : arguments.outputs) {
    outputs.add(path, [&](const std::string& place) {
      if (ending(path) == ".json") {
        write_distance_json(source, distance, place);
      } else if (ending(path) == ".svg") {
        write_path_svg(picture_of(face, distance), place);
      } else {
        in_context(path, [&] { write_step(curves_of(face, distance), model.unit, place); });
      }
    });
  }
  outputs.commit();
}

void print_end(const char* name, const FacePlace& place, const std::string& unit) {
  line(name, fmt::format("{}; {}", words(place.uv), words(place.xyz)));
  if (place.moved > 0.0) line("  moved by", fmt::format("{:.3g} {} onto the face", place.moved, unit));
}

std::string direction(UvVec uv, const Xyz& tangent) {
  return fmt::format("{:.10g} {:.10g} {:.10g} in space, {:.10g} {:.10g} in u, v", tangent.x(), tangent.y(), tangent.z(),
                     uv.u, uv.v);
}

void print_path(const FacePath& path, const std::string& unit) {
  const Connection& c = path.connection;
  if (c.length == 0.0) return;
  line("  starts along", direction(c.start_direction, path.points.front().tangent));
  line("  ends along", direction(c.end_direction, path.end_tangent));
  line("  y at the end", fmt::format("{} {}", c.y, unit));
  if (!path.exit) return;
  const auto where = [&](const PathPoint& p) {
    return fmt::format("after {:.10g} {} at {}; {}", p.s, unit, words(p.uv), words(p.xyz));
  };
  line("  leaves the face", where(path.exit->out));
  line("  comes back", path.exit->back ? where(*path.exit->back) : "not before its end");
}

void print_summary(const CadModel& model, const CadFace& face, const FaceDistance& distance) {
  line("face", fmt::format("{} ({})", face_label(face.number), to_string(face.surface->kind())));
  print_end("from", distance.from, model.unit);
  print_end("to", distance.to, model.unit);
  // Every digit: the same double is read back.
  line("distance", fmt::format("{} {}", distance.length(), model.unit));
  line("why", explain(distance.result));
  line("shortest paths", std::to_string(distance.paths.size()));
  for (const FacePath& path : distance.paths) print_path(path, model.unit);
  if (distance.stays_on_face) {
    line("stays on face", fmt::format("{} {}: the shortest path found that does", *distance.stays_on_face, model.unit));
  }
  if (distance.warnings.empty()) line("warnings", "none");
  for (const DistanceWarning& warning : distance.warnings) line("warning", warning.text);
}

[[noreturn]] void fail(const std::string& where, const FaceDistance& distance) {
  if (distance.result.status == ConnectStatus::Converged) {
    throw Error(ErrorCode::FaceRejected,
                fmt::format("{}: the distance is {}, but {}; other points, or a repaired face, may mend it", where,
                            distance.length(), distance.warnings.front().text));
  }
  throw Error(ErrorCode::FaceRejected,
              fmt::format("{}: no shortest path was found ({}); other points, or a repaired face, may mend it", where,
                          explain(distance.result)));
}

void require_length_for_curves(const DistanceArguments& arguments, const FaceDistance& distance) {
  if (distance.length() > 0.0) return;
  for (const std::string& path : arguments.outputs) {
    if (!ending(path).starts_with(".st")) continue;
    throw Error(
        ErrorCode::Usage,
        fmt::format("{}: the two points are one, and a path of no length is no curve; leave the output out", path));
  }
}

}  // namespace

int run(const DistanceArguments& arguments) {
  check_outputs(arguments.outputs, arguments.input);
  const CadModel model = in_context(arguments.input, [&] { return read_cad(arguments.input); });
  const CadFace& face =
      in_context(arguments.input, [&]() -> const CadFace& { return chosen_face(model, arguments.face); });
  const std::string where = fmt::format("{}: {}", model.file, face_label(face.number));
  const FaceDistances distances = in_context(where, [&] { return FaceDistances(model, face); });
  const auto place = [&](const char* option, const std::string& text, const FacePoint& point) {
    return in_context(where, [&] {
      return in_context(fmt::format("{} {}", option, text), [&] { return distances.place(point, arguments.snap); });
    });
  };
  const FacePlace from = place("--from", arguments.from_text, arguments.from);
  const FacePlace to = place("--to", arguments.to_text, arguments.to);
  const FaceDistance distance = distances.between(from, to);
  if (distance.paths.empty()) fail(where, distance);
  require_length_for_curves(arguments, distance);
  write_outputs(arguments, model, document_source(model, face, distances.box()), distances, distance);
  if (distance.leaves_face()) {
    fmt::print(stderr, "geovor: {}: {}; measure on a face without that hole or border, or between other points\n",
               where, distance.warnings.front().text);
  }
  print_summary(model, face, distance);
  for (const std::string& path : arguments.outputs) line("wrote", path);
  const bool whole = distance.paths.size() == distance.result.shortest_paths.size();
  return distance.leaves_face() || !whole ? static_cast<int>(ErrorCode::FaceRejected) : 0;
}

}  // namespace geovor
