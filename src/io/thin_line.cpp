#include "io/thin_line.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace geovor {
namespace {

double distance_to_segment(const PagePoint& p, const PagePoint& a, const PagePoint& b) {
  const double x = b.x - a.x, y = b.y - a.y, square = x * x + y * y;
  const double k = square > 0.0 ? std::clamp(((p.x - a.x) * x + (p.y - a.y) * y) / square, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - k * x, p.y - a.y - k * y);
}

}  // namespace

std::vector<PagePoint> thin_line(const std::vector<PagePoint>& line, double tolerance) {
  if (line.size() < 3) return line;
  std::vector<char> keep(line.size(), 0);
  keep.front() = keep.back() = 1;
  std::vector<std::pair<std::size_t, std::size_t>> pieces = {{0, line.size() - 1}};
  while (!pieces.empty()) {
    const auto [first, last] = pieces.back();
    pieces.pop_back();
    std::size_t farthest = first;
    double most = tolerance;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double off = distance_to_segment(line[i], line[first], line[last]);
      if (off > most) most = off, farthest = i;
    }
    if (farthest == first) continue;
    keep[farthest] = 1;
    pieces.emplace_back(first, farthest);
    pieces.emplace_back(farthest, last);
  }
  std::vector<PagePoint> thin;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (keep[i]) thin.push_back(line[i]);
  }
  return thin;
}

}  // namespace geovor
