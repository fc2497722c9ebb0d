// geovor info: what is in a CAD file, one row a face.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "context.h"
#include "face_facts.h"
#include "occ_adapter/read_cad.h"
#include "parallel.h"
#include "table.h"

namespace geovor {
namespace {

std::string pair_text(int u, int v) { return fmt::format("{}x{}", u, v); }

std::string periodic_text(const FaceFacts& facts) {
  if (facts.u_period && facts.v_period) return "uv";
  return facts.u_period ? "u" : facts.v_period ? "v" : "-";
}

std::string problems_text(const FaceFacts& facts) {
  std::string text;
  for (const std::string& problem : facts.problems) text += (text.empty() ? "" : "; ") + problem;
  return text;
}

std::vector<std::string> row(const FaceFacts& facts) {
  const auto number = [](const std::optional<double>& value, const char* format) {
    return value ? fmt::format(fmt::runtime(format), *value) : std::string("-");
  };
  const auto& spline = facts.spline;
  return {fmt::format("Face{}", facts.number),
          facts.kind,
          spline ? pair_text(spline->u_degree, spline->v_degree) : "-",
          spline ? pair_text(spline->u_poles, spline->v_poles) : "-",
          spline ? (spline->rational ? "yes" : "no") : "-",
          periodic_text(facts),
          number(facts.area, "{:.8g}"),
          fmt::format("{}", facts.holes),
          fmt::format("{}", facts.collapsed),
          number(facts.anisotropy, "{:.3g}"),
          number(facts.smallest_angle, "{:.1f}"),
          problems_text(facts)};
}

std::string shells_text(const CadModel& model) {
  std::size_t closed = 0;
  for (const CadShell& shell : model.shells) closed += shell.closed;
  return fmt::format("{} ({} closed)", model.shells.size(), closed);
}

/// A coordinate for people: rounding errors about zero are not shown.
double shown(double coordinate, const CadModel& model) {
  constexpr double kRounding = 1e-12;  // of the diagonal: a few thousand times the rounding of one coordinate
  return std::abs(coordinate) < kRounding * model.diagonal() ? 0.0 : coordinate;
}

std::string corner_text(const Xyz& corner, const CadModel& model) {
  return fmt::format("{:.8g} {:.8g} {:.8g}", shown(corner.x(), model), shown(corner.y(), model),
                     shown(corner.z(), model));
}

void print_table(const CadModel& model, const std::vector<FaceFacts>& faces) {
  fmt::print("file      {}\n", model.file);
  fmt::print("unit      {}\n", model.unit);
  fmt::print("faces     {}\n", model.faces.size());
  fmt::print("shells    {}\n", shells_text(model));
  fmt::print("box       {} to {}\n", corner_text(model.lower, model), corner_text(model.upper, model));
  fmt::print("diagonal  {:.8g}\n", model.diagonal());
  for (const std::string& warning : model.warnings) fmt::print("warning   {}\n", warning);
  fmt::print("\n");
  Table table({"face", "kind", "degree", "poles", "rational", "periodic", "area", "holes", "collapsed", "stretch",
               "angle", "problems"},
              {Align::Left, Align::Left, Align::Right, Align::Right, Align::Left, Align::Left, Align::Right,
               Align::Right, Align::Right, Align::Right, Align::Right, Align::Left});
  for (const FaceFacts& facts : faces) table.add(row(facts));
  fmt::print("{}", table.text());
}

using Json = nlohmann::ordered_json;

template <typename T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json point(const Xyz& p) { return Json::array({p.x(), p.y(), p.z()}); }

Json face_json(const FaceFacts& facts) {
  const auto& spline = facts.spline;
  return {{"face", facts.number},
          {"name", facts.name},
          {"kind", facts.kind},
          {"degree", spline ? Json{spline->u_degree, spline->v_degree} : Json(nullptr)},
          {"poles", spline ? Json{spline->u_poles, spline->v_poles} : Json(nullptr)},
          {"rational", spline ? Json(spline->rational) : Json(nullptr)},
          {"u_period", or_null(facts.u_period)},
          {"v_period", or_null(facts.v_period)},
          {"area", or_null(facts.area)},
          {"area_error", or_null(facts.area_error)},
          {"holes", facts.holes},
          {"collapsed", facts.collapsed},
          {"stretch", or_null(facts.anisotropy)},
          {"smallest_angle", or_null(facts.smallest_angle)},
          {"tolerance", facts.tolerance},
          {"problems", facts.problems}};
}

void print_json(const CadModel& model, const std::vector<FaceFacts>& faces) {
  Json shells = Json::array();
  for (const CadShell& shell : model.shells) {
    Json numbers = Json::array();
    for (const int index : shell.faces) numbers.push_back(model.faces[static_cast<std::size_t>(index)].number);
    shells.push_back({{"faces", numbers}, {"closed", shell.closed}});
  }
  Json rows = Json::array();
  for (const FaceFacts& facts : faces) rows.push_back(face_json(facts));
  const Json document = {{"format", "geovor-info"},
                         {"version", 1},
                         {"generator", "geovor " GEOVOR_VERSION},
                         {"input", model.file},
                         {"unit", model.unit},
                         {"box", {{"lower", point(model.lower)}, {"upper", point(model.upper)}}},
                         {"diagonal", model.diagonal()},
                         {"shells", shells},
                         {"warnings", model.warnings},
                         {"faces", rows}};
  // Names come from the file in whatever encoding that has: what is no UTF-8 is replaced, not fatal.
  fmt::print("{}\n", document.dump(2, ' ', false, Json::error_handler_t::replace));
}

}  // namespace

int run(const InfoArguments& arguments) {
  const CadModel model = in_context(arguments.input, [&] { return read_cad(arguments.input); });
  std::vector<FaceFacts> faces(model.faces.size());
  for_each_on(0)(static_cast<int>(faces.size()), [&](int i) {
    faces[static_cast<std::size_t>(i)] = face_facts(model, model.faces[static_cast<std::size_t>(i)]);
  });
  if (arguments.json) {
    print_json(model, faces);
  } else {
    print_table(model, faces);
  }
  return 0;
}

}  // namespace geovor
