// Numbers and points as users write them.
#pragma once

#include <string>
#include <vector>

#include "pipeline/face_point.h"

namespace geovor {

/// The text without the blanks around it.
std::string without_blanks(const std::string& text);

/// What stands between the commas of a line, without the blanks around it.
std::vector<std::string> cells_of(const std::string& line);

/// A finite number. Throws Error(Usage).
double parse_number(const std::string& cell);

/// "u,v" or "x,y,z". Throws Error(Usage).
FacePoint parse_point(const std::string& text);

}  // namespace geovor
