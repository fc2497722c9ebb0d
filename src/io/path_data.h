// The "d" of a path of SVG, short: steps from point to point in tenths of a page unit.
#pragma once

#include <string>

#include "io/picture_projection.h"

namespace geovor {

class PathData {
 public:
  /// A new subpath.
  void move(const PagePoint& to);
  /// On from the last point; nothing where that rounds to the same tenths.
  void line(const PagePoint& to);
  void close();

  bool empty() const { return text_.empty(); }
  const std::string& text() const { return text_; }

 private:
  void append(long tenths);

  std::string text_;
  char command_ = 0;                ///< the last one: it need not be said again
  long x_ = 0, y_ = 0;              ///< the last point, tenths
  long start_x_ = 0, start_y_ = 0;  ///< of the subpath
};

}  // namespace geovor
