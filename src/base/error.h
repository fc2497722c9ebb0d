// The one exception of the library: the caller's data is wrong and the message says how to mend it.
// An iteration that does not settle is no error but a status in its result; a fault of ours is an assert.
#pragma once

#include <stdexcept>
#include <string>

namespace geovor {

/// What kind of thing went wrong; the values are the program's exit codes.
enum class ErrorCode {
  Usage = 1,         ///< the request itself makes no sense (a negative size, two equal sites)
  Unreadable = 2,    ///< the input can't be read, or holds no face
  FaceRejected = 3,  ///< some face can't be worked on
  Unwritable = 4,    ///< an output can't be written
  Internal = 70,     ///< a fault of geovor
};

/// Thrown for bad input. what() is one line: "what is wrong; what would mend it", without file and face,
/// which the caller that knows them puts in front.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ErrorCode code() const { return code_; }

 private:
  ErrorCode code_;
};

}  // namespace geovor
