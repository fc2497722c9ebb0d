// Faces as the user names them on the command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "brep/model.h"

namespace geovor {

/// "3" or "Face3" (any case) -> 3. Throws Error(Usage).
int parse_face(const std::string& text);

/// "1,4-9,Face12" -> 1 4 5 6 7 8 9 12, ascending, each once. Throws Error(Usage).
std::vector<int> parse_face_list(const std::string& text);

/// Throws Error(Usage) where a number is none of Face1 … Face`count`.
void check_faces_exist(const std::vector<int>& numbers, int count);

/// The face of this number; without one, the only face. Throws Error(Usage).
const CadFace& chosen_face(const CadModel& model, std::optional<int> number);

}  // namespace geovor
