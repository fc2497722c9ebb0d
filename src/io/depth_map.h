// Which lines of a picture are hidden behind its surfaces.
#pragma once

#include <limits>
#include <vector>

#include "io/picture_projection.h"

namespace geovor {

/// The depth of the nearest surface over each unit square of a page.
class DepthMap {
 public:
  DepthMap(int width, int height)
      : width_(width),
        height_(height),
        depth_(static_cast<std::size_t>(width) * height, -std::numeric_limits<double>::infinity()) {}

  void add_triangle(const PagePoint& a, const PagePoint& b, const PagePoint& c);

  /// Whether a surface lies in front of p by more than `slack`, page units.
  bool hides(const PagePoint& p, double slack) const;

 private:
  int width_, height_;
  std::vector<double> depth_;
};

}  // namespace geovor
