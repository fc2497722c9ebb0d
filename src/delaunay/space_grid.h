// Points by where they are in space, among neighbours of all sizes.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/xyz.h"

namespace geovor {

/// Points in cubes whose edges are powers of two; one set of cubes for each power that was asked for, made when it is.
class SpaceGrid {
 public:
  /// Points are numbered in the order in which they come.
  void add(const Xyz& x);

  /// Calls f(i) for every point i nearer to x than `reach`, and for some that are farther away.
  template <typename F>
  void each_near(const Xyz& x, double reach, const F& f) {
    const Level& level = level_for(reach);
    const Cube c = level.cube(x);
    // The half of the cube in which x lies tells which neighbour the ball can reach.
    for (int k = 0; k < 8; ++k) {
      const auto found = level.last.find(
          key({c.i[0] + (k & 1) * c.side[0], c.i[1] + (k >> 1 & 1) * c.side[1], c.i[2] + (k >> 2) * c.side[2]}));
      if (found == level.last.end()) continue;
      for (int i = found->second; i >= 0; i = level.before[i]) f(i);
    }
  }

 private:
  struct Cube {
    std::array<long, 3> i;
    std::array<int, 3> side;  ///< -1 or 1: the nearer neighbour
  };
  struct Level {
    double edge = 1.0;
    std::unordered_map<std::uint64_t, int> last;  ///< of a cube: its last point
    std::vector<int> before;                      ///< of a point: the one before it in its cube, or -1

    Cube cube(const Xyz& x) const;
    void add(const Xyz& x, int number);
  };

  static std::uint64_t key(const std::array<long, 3>& cube);
  /// The level whose cubes are at least twice as large as `reach`.
  const Level& level_for(double reach);

  std::vector<Xyz> points_;
  std::unordered_map<int, Level> levels_;  ///< by the power
};

}  // namespace geovor
