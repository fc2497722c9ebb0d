#include "document.h"

namespace geovor {
namespace {

Json range(const Interval& i) { return Json::array({i.lo, i.hi}); }
Json optional_number(const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); }

}  // namespace

DocumentSource document_source(const CadModel& model, const CadFace& face, const UvBox& parameters) {
  DocumentSource source;
  source.generator = "geovor " GEOVOR_VERSION;
  source.input = model.file;
  source.face = face.number;
  source.unit = model.unit;
  source.surface_type = to_string(face.surface->kind());
  source.parameters = parameters;
  source.u_period = face.surface->u_period();
  source.v_period = face.surface->v_period();
  return source;
}

Json document_head(const std::string& format, const DocumentSource& source) {
  return Json{{"format", format},      {"version", 1},        {"generator", source.generator},
              {"input", source.input}, {"face", source.face}, {"unit", source.unit}};
}

Json surface_json(const DocumentSource& source) {
  return Json{{"type", source.surface_type},
              {"u", range(source.parameters.u)},
              {"v", range(source.parameters.v)},
              {"u_period", optional_number(source.u_period)},
              {"v_period", optional_number(source.v_period)}};
}

Json pair(Uv p) { return Json::array({p.u, p.v}); }
Json pair(UvVec d) { return Json::array({d.u, d.v}); }
Json triple(const Xyz& x) { return Json::array({x.x(), x.y(), x.z()}); }

std::string document_text(const Json& document) {
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace geovor
