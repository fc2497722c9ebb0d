#include "check_report.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "context.h"
#include "document.h"
#include "table.h"

namespace geovor {
namespace {

std::string face_name(const CheckSummary& s, int face) {
  return face < 0 ? "no face" : face_label(s.model->faces[static_cast<std::size_t>(face)].number);
}

std::string place(const Xyz& x) { return fmt::format("({:.6g} {:.6g} {:.6g})", x.x(), x.y(), x.z()); }

/// Triangles are numbered from 1 in the order of the file.
std::string triangle_name(int t) { return fmt::format("triangle {}", t + 1); }

Xyz middle(const TriangleMesh& mesh, int t) {
  const auto& [a, b, c] = mesh.triangles[static_cast<std::size_t>(t)];
  return (mesh.points[static_cast<std::size_t>(a)] + mesh.points[static_cast<std::size_t>(b)] +
          mesh.points[static_cast<std::size_t>(c)]) /
         3.0;
}

/// A line for people; the picture leaves out what its panels show.
struct Line {
  const char* name;
  std::string value, more;
};

Line distance_line(const CheckSummary& s, const char* name, const DistanceFigures& d) {
  return {name, fmt::format("{:.4g} {} at most, mean {:.3g}, rms {:.3g}", d.largest, s.model->unit, d.mean, d.rms),
          fmt::format("; the largest at {}, {}, {}", place(d.from), face_name(s, d.face), triangle_name(d.triangle))};
}

std::string closed_text(const MeshCheck& c) {
  const MeshFaults& f = c.faults;
  std::string text = c.topology.closed() ? "yes" : fmt::format("no, {} open edges", f.open.size());
  text += f.manifold() ? "; manifold"
                       : fmt::format("; not manifold: {} edges of more than two triangles, {} points between fans",
                                     f.crowded.size(), f.pinched.size());
  return text + fmt::format("; Euler number {}, components {}", c.topology.euler(), c.topology.components);
}

Line vertices_line(const CheckSummary& s) {
  const CheckedVertices& v = s.check->vertices;
  return {"vertices",
          fmt::format("{:.3g} {} from the CAD at most ({:.2g} of the diagonal); {} beyond {:.3g}", v.largest,
                      s.model->unit, v.largest / s.model->diagonal(), v.beyond, v.tolerance),
          fmt::format(", which is {:.0g} of the diagonal and the file's rounding ({})", kOnCad, s.loaded->precision)};
}

std::string narrow_text(const CheckedAngles& a) {
  std::string text;
  for (const NarrowTriangles& n : a.narrow) {
    text += fmt::format("{}{} below {:g} deg", text.empty() ? "" : ", ", n.count, n.limit);
    if (n.at_sharper_corners > 0)
      text += fmt::format(" ({} in corners of the CAD that are sharper)", n.at_sharper_corners);
  }
  return text;
}

double face_area_of(const MeshCheck& c) {
  double area = 0.0;
  for (const CheckedFace& f : c.faces) area += f.face_area;
  return area;
}

double percent(double mesh, double cad) { return cad > 0.0 ? 100.0 * (mesh / cad - 1.0) : 0.0; }

std::vector<Line> lines_of(const CheckSummary& s) {
  const MeshCheck& c = *s.check;
  const std::string& unit = s.model->unit;
  const EdgeLengths& e = c.edges;
  return {
      {"mesh",
       fmt::format("{} ({} triangles, {} vertices, {})", s.mesh_file, c.topology.triangles, c.topology.vertices,
                   s.loaded->precision),
       ""},
      {"against",
       fmt::format("{} ({} faces, diagonal {:.6g} {})", s.model->file, s.model->faces.size(), s.model->diagonal(),
                   unit),
       ""},
      {"closed", closed_text(c), ""},
      {"orientation",
       fmt::format("{} triangles inverted, {} without area, {} edges where neighbours disagree",
                   c.normals.inverted.size(), c.faults.without_area.size(), c.faults.disagreeing.size()),
       ""},
      distance_line(s, "mesh to CAD", c.on_cad.distance),
      distance_line(s, "CAD to mesh", c.on_mesh.distance),
      vertices_line(s),
      {"angles",
       fmt::format("{:.2f} to {:.2f} deg, mean of the triangles' smallest {:.2f}", c.angles.smallest, c.angles.largest,
                   c.angles.mean_smallest),
       ""},
      {"narrow", narrow_text(c.angles), ""},
      {"normals",
       fmt::format("{:.2f} deg from the face's at most, mean {:.2f}, rms {:.2f}", c.normals.largest, c.normals.mean,
                   c.normals.rms),
       ""},
      {"edge lengths",
       fmt::format("{:.4g} {:.4g} {:.4g} {:.4g} {:.4g} {}", e.at(0.0), e.at(0.05), e.at(0.5), e.at(0.95), e.at(1.0),
                   unit),
       " (shortest, 5 %, median, 95 %, longest)"},
      {"area", fmt::format("{:.8g} {}^2, {:+.4f} % beside the CAD's", c.area, unit, percent(c.area, face_area_of(c))),
       ""},
  };
}

std::string face_table(const CheckSummary& s) {
  Table table(
      {"face", "triangles", "area", "of the CAD", "%", "to CAD", "to mesh", "normal", "smallest", "inverted", ""},
      {Align::Left, Align::Right, Align::Right, Align::Right, Align::Right, Align::Right, Align::Right, Align::Right,
       Align::Right, Align::Right, Align::Left});
  for (std::size_t f = 0; f < s.check->faces.size(); ++f) {
    const CheckedFace& c = s.check->faces[f];
    const bool meshed = c.triangles > 0;
    table.add({face_name(s, static_cast<int>(f)), fmt::format("{}", c.triangles), fmt::format("{:.6g}", c.mesh_area),
               fmt::format("{:.6g}", c.face_area),
               meshed ? fmt::format("{:+.4f}", percent(c.mesh_area, c.face_area)) : "-",
               meshed ? fmt::format("{:.3g}", c.to_cad) : "-", fmt::format("{:.3g}", c.to_mesh),
               meshed ? fmt::format("{:.1f}", c.normal_deviation) : "-",
               meshed ? fmt::format("{:.1f}", c.smallest_angle) : "-", fmt::format("{}", c.inverted), c.why_not});
  }
  return table.text();
}

std::string group_table(const CheckSummary& s) {
  Table table({"group", "triangles", "stands for", "elsewhere"},
              {Align::Left, Align::Right, Align::Left, Align::Right});
  for (std::size_t g = 0; g < s.check->groups.size(); ++g) {
    const CheckedGroup& group = s.check->groups[g];
    table.add({s.loaded->groups[g], fmt::format("{}", group.triangles),
               group.face < 0 ? "several faces" : face_name(s, group.face),
               group.face < 0 ? "-" : fmt::format("{}", group.elsewhere)});
  }
  return table.text();
}

Json triangles_json(const std::vector<int>& triangles) {
  return each(triangles, [](std::size_t, int t) { return Json(t + 1); });
}

Json distance_json(const CheckSummary& s, const DistanceFigures& d) {
  return {{"largest", d.largest},
          {"mean", d.mean},
          {"rms", d.rms},
          {"from", triple(d.from)},
          {"to", triple(d.to)},
          {"face", d.face < 0 ? Json(nullptr) : Json(s.model->faces[static_cast<std::size_t>(d.face)].number)},
          {"triangle", d.triangle + 1},
          {"samples", d.samples}};
}

Json edges_json(const CheckSummary& s, const std::vector<MeshEdge>& edges) {
  return each(edges, [&](std::size_t, const MeshEdge& e) {
    const auto& points = s.loaded->mesh.points;
    return Json{{"from", triple(points[static_cast<std::size_t>(e.from)])},
                {"to", triple(points[static_cast<std::size_t>(e.to)])},
                {"triangles", triangles_json(e.triangles)}};
  });
}

Json topology_json(const CheckSummary& s) {
  const MeshCheck& c = *s.check;
  return {{"vertices", c.topology.vertices},
          {"edges", c.topology.edges},
          {"triangles", c.topology.triangles},
          {"components", c.topology.components},
          {"closed", c.topology.closed()},
          {"manifold", c.faults.manifold()},
          {"euler_number", c.topology.euler()},
          {"open_edges", edges_json(s, c.faults.open)},
          {"crowded_edges", edges_json(s, c.faults.crowded)},
          {"disagreeing_edges", edges_json(s, c.faults.disagreeing)},
          {"pinched_points", each(c.faults.pinched, [&](std::size_t, int p) {
             return triple(s.loaded->mesh.points[static_cast<std::size_t>(p)]);
           })}};
}

Json angles_json(const CheckSummary& s) {
  const CheckedAngles& a = s.check->angles;
  Json narrow = Json::array();
  for (const NarrowTriangles& n : a.narrow) {
    narrow.push_back({{"below", n.limit}, {"triangles", n.count}, {"at_sharper_corners", n.at_sharper_corners}});
  }
  return {{"smallest", a.smallest},
          {"smallest_at", a.smallest_at + 1},
          {"smallest_elsewhere", a.smallest_elsewhere},
          {"largest", a.largest},
          {"mean_smallest", a.mean_smallest},
          {"narrow", narrow},
          {"at_sharper_corners", each(a.at_sharper_corners, [&](std::size_t, const TriangleNote& n) {
             return Json{{"triangle", n.triangle + 1},
                         {"angle", n.value},
                         {"face", s.model->faces[static_cast<std::size_t>(n.face)].number},
                         {"at", triple(middle(s.loaded->mesh, n.triangle))}};
           })}};
}

Json faces_json(const CheckSummary& s) {
  return each(s.check->faces, [&](std::size_t i, const CheckedFace& f) {
    const CadFace& face = s.model->faces[i];
    return Json{{"face", face.number},
                {"name", face.name},
                {"triangles", f.triangles},
                {"mesh_area", f.mesh_area},
                {"face_area", f.face_area},
                {"mesh_to_cad", f.to_cad},
                {"cad_to_mesh", f.to_mesh},
                {"normal_deviation", f.normal_deviation},
                {"smallest_angle", f.smallest_angle},
                {"inverted", f.inverted},
                {"why_not", f.why_not}};
  });
}

Json groups_json(const CheckSummary& s) {
  return each(s.check->groups, [&](std::size_t i, const CheckedGroup& g) {
    return Json{{"name", s.loaded->groups[i]},
                {"triangles", g.triangles},
                {"face", g.face < 0 ? Json(nullptr) : Json(s.model->faces[static_cast<std::size_t>(g.face)].number)},
                {"elsewhere", g.elsewhere}};
  });
}

CheckPlace triangle_place(const CheckSummary& s, const std::string& title, const std::string& figure, int t) {
  const TriangleMesh& mesh = s.loaded->mesh;
  const auto& [a, b, c] = mesh.triangles[static_cast<std::size_t>(t)];
  const auto point = [&mesh](int p) { return mesh.points[static_cast<std::size_t>(p)]; };
  const int face = s.check->face_of[static_cast<std::size_t>(t)];
  const Xyz n = (point(b) - point(a)).cross(point(c) - point(a));
  return {title,
          fmt::format("{}, {}, {}", figure, triangle_name(t), face_name(s, face)),
          middle(mesh, t),
          n.norm() > 0.0 ? Xyz(n.stableNormalized()) : Xyz(Xyz::Zero()),
          {t},
          {}};
}

CheckPlace distance_place(const CheckSummary& s, const std::string& title, const DistanceFigures& d) {
  const std::string figure = fmt::format("{:.4g} {}", d.largest, s.model->unit);
  CheckPlace p = triangle_place(s, title, figure, d.triangle);
  p.at = 0.5 * (d.from + d.to);
  p.lines = {{d.from, d.to}};
  return p;
}

CheckPlace edges_place(const CheckSummary& s, const std::string& title, const std::vector<MeshEdge>& edges) {
  const auto& points = s.loaded->mesh.points;
  const MeshEdge& first = edges.front();
  CheckPlace p = triangle_place(s, title, fmt::format("{} of them; here", edges.size()), first.triangles.front());
  p.at = 0.5 * (points[static_cast<std::size_t>(first.from)] + points[static_cast<std::size_t>(first.to)]);
  for (const MeshEdge& e : edges) {
    const Xyz &a = points[static_cast<std::size_t>(e.from)], &b = points[static_cast<std::size_t>(e.to)];
    if (&e == &first || (0.5 * (a + b) - p.at).norm() < 2.0 * (b - a).norm()) p.lines.push_back({a, b});
  }
  return p;
}

/// The worst kinds first.
std::vector<CheckPlace> worst_places(const CheckSummary& s) {
  const MeshCheck& c = *s.check;
  std::vector<CheckPlace> places;
  places.push_back(distance_place(s, "farthest from the CAD", c.on_cad.distance));
  if (c.on_mesh.distance.triangle >= 0)
    places.push_back(distance_place(s, "CAD farthest from the mesh", c.on_mesh.distance));
  places.push_back(
      triangle_place(s, "smallest angle", fmt::format("{:.2f} deg", c.angles.smallest), c.angles.smallest_at));
  if (!c.normals.inverted.empty()) {
    places.push_back(triangle_place(s, "inverted triangles", fmt::format("{} of them; here", c.normals.inverted.size()),
                                    c.normals.inverted.front()));
  } else if (c.normals.largest_at >= 0) {
    places.push_back(triangle_place(s, "largest turn from the face's normal",
                                    fmt::format("{:.2f} deg", c.normals.largest), c.normals.largest_at));
  }
  if (!c.faults.open.empty()) places.push_back(edges_place(s, "open edges", c.faults.open));
  if (!c.faults.crowded.empty()) {
    places.push_back(edges_place(s, "edges of more than two triangles", c.faults.crowded));
  } else if (!c.faults.disagreeing.empty()) {
    places.push_back(edges_place(s, "edges where neighbours disagree", c.faults.disagreeing));
  }
  return places;
}

}  // namespace

std::vector<std::string> check_warnings(const LoadedMesh& loaded, const CadModel& model, const MeshCheck& check) {
  std::vector<std::string> warnings;
  Xyz lower = loaded.mesh.points.front(), upper = lower;
  for (const Xyz& p : loaded.mesh.points) lower = lower.cwiseMin(p), upper = upper.cwiseMax(p);
  const double ratio = (upper - lower).norm() / model.diagonal();
  constexpr double kOtherUnit = 5.0;  // units differ by 10, 25.4 or more; a part of the faces is seldom that small
  if (!(ratio < kOtherUnit && ratio > 1.0 / kOtherUnit)) {
    warnings.push_back(
        fmt::format("the mesh is {:.4g} times as large as the CAD, whose lengths are in {}; the units may "
                    "differ",
                    ratio, model.unit));
  }
  for (std::size_t f = 0; f < check.faces.size(); ++f) {
    if (check.faces[f].why_not.empty()) continue;
    warnings.push_back(
        fmt::format("{} is left out of the distances: {}", face_label(model.faces[f].number), check.faces[f].why_not));
  }
  const auto bare = std::count_if(check.faces.begin(), check.faces.end(),
                                  [](const CheckedFace& f) { return f.triangles == 0 && f.why_not.empty(); });
  if (bare > 0) warnings.push_back(fmt::format("{} faces of the CAD have no triangle", bare));
  return warnings;
}

std::string check_text(const CheckSummary& s) {
  std::string text;
  for (const Line& line : lines_of(s)) text += fmt::format("{:<17} {}{}\n", line.name, line.value, line.more);
  for (const std::string& w : s.warnings) text += fmt::format("{:<17} {}\n", "warning", w);
  text += "\n" + face_table(s);
  if (!s.check->groups.empty()) text += "\n" + group_table(s);
  return text;
}

std::string check_json(const CheckSummary& s) {
  const MeshCheck& c = *s.check;
  const CheckedVertices& v = c.vertices;
  const EdgeLengths& e = c.edges;
  const Json document = {
      {"format", "geovor-check"},
      {"version", 1},
      {"generator", "geovor " GEOVOR_VERSION},
      {"mesh", s.mesh_file},
      {"against", s.model->file},
      {"unit", s.model->unit},
      {"diagonal", s.model->diagonal()},
      {"file",
       {{"precision", s.loaded->precision},
        {"rounding", s.loaded->rounding},
        {"other_elements", s.loaded->other_elements},
        {"polygons_cut", s.loaded->split}}},
      {"warnings", s.warnings},
      {"distances",
       {{"mesh_to_cad", distance_json(s, c.on_cad.distance)},
        {"cad_to_mesh", distance_json(s, c.on_mesh.distance)},
        {"hausdorff", c.hausdorff()}}},
      {"vertices",
       {{"largest", v.largest},
        {"of_diagonal", v.largest / s.model->diagonal()},
        {"at",
         v.largest_at < 0 ? Json(nullptr) : triple(s.loaded->mesh.points[static_cast<std::size_t>(v.largest_at)])},
        {"tolerance", v.tolerance},
        {"beyond", v.beyond}}},
      {"angles", angles_json(s)},
      {"topology", topology_json(s)},
      {"orientation",
       {{"inverted", triangles_json(c.normals.inverted)}, {"without_area", triangles_json(c.faults.without_area)}}},
      {"normals",
       {{"largest", c.normals.largest},
        {"at", c.normals.largest_at + 1},
        {"mean", c.normals.mean},
        {"rms", c.normals.rms}}},
      {"edge_lengths",
       {{"shortest", e.at(0.0)},
        {"percent_5", e.at(0.05)},
        {"median", e.at(0.5)},
        {"percent_95", e.at(0.95)},
        {"longest", e.at(1.0)},
        {"mean", e.mean()}}},
      {"area", {{"mesh", c.area}, {"cad", face_area_of(c)}}},
      {"volume", c.topology.closed() ? Json(c.volume) : Json(nullptr)},
      {"faces", faces_json(s)},
      {"groups", groups_json(s)}};
  return document_text(document);
}

CheckSheet check_sheet(const CheckSummary& s) {
  CheckSheet sheet;
  const auto name = [](const std::string& path) { return std::filesystem::path(path).filename().string(); };
  sheet.title = fmt::format("{} against {}", name(s.mesh_file), name(s.model->file));
  for (const Line& line : lines_of(s)) sheet.facts.push_back({line.name, line.value});
  sheet.distance = s.check->on_cad.largest;
  sheet.distance_unit = s.model->unit;
  sheet.places = worst_places(s);
  return sheet;
}

}  // namespace geovor
