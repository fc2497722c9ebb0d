#include "io/depth_map.h"

#include <algorithm>
#include <cmath>

namespace geovor {

// A square counts as covered if its middle lies in the triangle.
void DepthMap::add_triangle(const PagePoint& a, const PagePoint& b, const PagePoint& c) {
  const double det = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  if (!(std::abs(det) > 0.0)) return;
  const auto clamp = [](double x, int n) { return std::clamp(static_cast<int>(std::floor(x)), 0, n - 1); };
  const auto [left, right] = std::minmax({a.x, b.x, c.x});
  const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
  for (int row = clamp(top, height_); row <= clamp(bottom, height_); ++row) {
    for (int column = clamp(left, width_); column <= clamp(right, width_); ++column) {
      const double x = column + 0.5 - a.x, y = row + 0.5 - a.y;
      const double k = (x * (c.y - a.y) - (c.x - a.x) * y) / det, l = ((b.x - a.x) * y - x * (b.y - a.y)) / det;
      if (!(k >= 0.0 && l >= 0.0 && k + l <= 1.0)) continue;
      double& depth = depth_[static_cast<std::size_t>(row) * width_ + column];
      depth = std::max(depth, a.depth + k * (b.depth - a.depth) + l * (c.depth - a.depth));
    }
  }
}

// The squares around have a say too, so that a pinhole between two patches shows nothing of what is behind.
bool DepthMap::hides(const PagePoint& p, double slack) const {
  const int row = static_cast<int>(std::floor(p.y)), column = static_cast<int>(std::floor(p.x));
  int squares = 0, hiding = 0;
  for (int r = std::max(row - 1, 0); r <= std::min(row + 1, height_ - 1); ++r) {
    for (int c = std::max(column - 1, 0); c <= std::min(column + 1, width_ - 1); ++c) {
      ++squares;
      hiding += depth_[static_cast<std::size_t>(r) * width_ + c] > p.depth + slack ? 1 : 0;
    }
  }
  return 2 * hiding > squares;
}

}  // namespace geovor
