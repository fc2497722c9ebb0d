#include "io/length_unit.h"

#include <map>

#include "base/error.h"

namespace geovor {

double metres_of(const std::string& unit) {
  static const std::map<std::string, double> metres = {{"mm", 1e-3}, {"m", 1.0},     {"cm", 1e-2},   {"km", 1e3},
                                                       {"um", 1e-6}, {"in", 0.0254}, {"ft", 0.3048}, {"mi", 1609.344}};
  const auto found = metres.find(unit);
  if (found == metres.end()) {
    throw Error(ErrorCode::Unwritable, "there is no unit of length '" + unit +
                                           "' in this format; use mm, m, cm, km, um, "
                                           "in, ft or mi");
  }
  return found->second;
}

}  // namespace geovor
