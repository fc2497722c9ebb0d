// What the JSON documents of the program share: their head, and points as arrays.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/interval.h"
#include "base/xyz.h"
#include "brep/model.h"

namespace geovor {

/// Members keep their order.
using Json = nlohmann::ordered_json;

/// What a document says about where it comes from.
struct DocumentSource {
  std::string generator;     ///< program and version
  std::string input;         ///< the file, as the user gave it
  int face = 0;              ///< FreeCAD's FaceN
  std::string unit = "mm";   ///< of all lengths
  std::string surface_type;  ///< "plane", "cylinder", …
  UvBox parameters;          ///< the rectangle around the face
  std::optional<double> u_period, v_period;
};

/// `parameters`: the rectangle around the face.
DocumentSource document_source(const CadModel& model, const CadFace& face, const UvBox& parameters);

/// "format", "version" (1), "generator", "input", "face", "unit".
Json document_head(const std::string& format, const DocumentSource& source);
/// {"type", "u", "v", "u_period", "v_period"}.
Json surface_json(const DocumentSource& source);

Json pair(Uv p);
Json pair(UvVec d);
Json triple(const Xyz& x);

/// The list with each element turned into JSON by convert(i, element).
template <class List, class Convert>
Json each(const List& list, const Convert& convert) {
  Json out = Json::array();
  for (size_t i = 0; i < list.size(); ++i) out.push_back(convert(i, list[i]));
  return out;
}

/// The document as text. Numbers read back as the same double; one that is not finite is null; a name that is no UTF-8
/// is written with replacement characters.
std::string document_text(const Json& document);

}  // namespace geovor
