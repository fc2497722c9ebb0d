// How far the work has got, on stderr.
#pragma once

#include <string>

namespace geovor {

/// What the user said about progress.
enum class ProgressWish { WhereTerminal, Always, Never };

/// On a terminal one line that is rewritten; elsewhere (`Always`) one line a call, for programs that read it.
class ProgressLine {
 public:
  ProgressLine(ProgressWish wish, std::string what);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// `total`: 0 where it is not known.
  void show(int done, int total);

 private:
  std::string what_;
  bool shown_ = false;
  bool wanted_ = false;
  bool terminal_ = false;
};

}  // namespace geovor
