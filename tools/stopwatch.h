// Time for reports; no result depends on it.
#pragma once

#include <chrono>

namespace geovor {

class Stopwatch {
 public:
  /// Seconds since the last call, or the construction.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace geovor
