#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

namespace geovor {

ProgressLine::ProgressLine(ProgressWish wish, std::string what)
    : what_(std::move(what)), terminal_(isatty(STDERR_FILENO) == 1) {
  wanted_ = wish == ProgressWish::Always || (wish == ProgressWish::WhereTerminal && terminal_);
}

ProgressLine::~ProgressLine() {
  // Carriage return and "erase to the end of the line": the results that follow start on a clean line.
  if (shown_ && terminal_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::show(int done, int total) {
  if (!wanted_) return;
  shown_ = true;
  const std::string count = total > 0 ? fmt::format("{}/{}", done, total) : std::to_string(done);
  if (terminal_) {
    fmt::print(stderr, "\rgeovor: {} {}\033[K", what_, count);
  } else {
    fmt::print(stderr, "geovor: {} {}\n", what_, count);
  }
  std::fflush(stderr);
}

}  // namespace geovor
