#include "delaunay/space_grid.h"

#include <cmath>

namespace geovor {

SpaceGrid::Cube SpaceGrid::Level::cube(const Xyz& x) const {
  Cube c;
  for (int k = 0; k < 3; ++k) {
    const double q = x[k] / edge, whole = std::floor(q);
    c.i[k] = static_cast<long>(whole);
    c.side[k] = q - whole < 0.5 ? -1 : 1;
  }
  return c;
}

void SpaceGrid::Level::add(const Xyz& x, int number) {
  const auto [place, is_new] = last.try_emplace(key(cube(x).i), -1);
  before.push_back(place->second);
  place->second = number;
}

// Cubes that share a key are only looked at for nothing.
std::uint64_t SpaceGrid::key(const std::array<long, 3>& cube) {
  constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15ull;
  std::uint64_t h = 0;
  for (const long i : cube) {
    h = (h ^ static_cast<std::uint64_t>(i)) * kGolden;
    h ^= h >> 29;
  }
  return h;
}

void SpaceGrid::add(const Xyz& x) {
  for (auto& [power, level] : levels_) level.add(x, static_cast<int>(points_.size()));
  points_.push_back(x);
}

const SpaceGrid::Level& SpaceGrid::level_for(double reach) {
  const int power = std::ilogb(2.0 * reach) + 1;
  const auto [place, is_new] = levels_.try_emplace(power);
  Level& level = place->second;
  if (is_new) {
    level.edge = std::ldexp(1.0, power);
    for (size_t i = 0; i < points_.size(); ++i) level.add(points_[i], static_cast<int>(i));
  }
  return level;
}

}  // namespace geovor
