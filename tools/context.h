// Where an error happened: the words in front of its one line.
#pragma once

#include <string>
#include <utility>

#include "base/error.h"

namespace geovor {

/// "Face7": how FreeCAD, the messages and the reports call a face.
inline std::string face_label(int number) { return "Face" + std::to_string(number); }

/// Runs `work`; an Error that leaves it gets "`where`: " in front of its message.
template <typename Work>
decltype(auto) in_context(const std::string& where, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const Error& error) {
    throw Error(error.code(), where + ": " + error.what());
  }
}

}  // namespace geovor
