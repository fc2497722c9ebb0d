// A set of directed edges between numbered points of which each has few.
#pragma once

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

namespace geovor {

/// Takes 40 bytes a point, and more only for a point with more than ten edges.
class EdgeSet {
 public:
  /// Whether the edge is new.
  bool insert(int from, int to) {
    if (static_cast<size_t>(from) >= of_.size()) of_.resize(from + 1, none());
    for (int& known : of_[from]) {
      if (known == to) return false;
      if (known != kNone) continue;
      known = to;
      return true;
    }
    return rest_.insert({from, to}).second;
  }

  bool has(int from, int to) const {
    if (static_cast<size_t>(from) >= of_.size()) return false;
    const Few& few = of_[from];
    if (std::find(few.begin(), few.end(), to) != few.end()) return true;
    return few.back() != kNone && rest_.count({from, to}) > 0;
  }

 private:
  static constexpr int kNone = -1;
  using Few = std::array<int, 10>;
  static Few none() {
    Few few;
    few.fill(kNone);
    return few;
  }

  std::vector<Few> of_;
  std::set<std::pair<int, int>> rest_;
};

}  // namespace geovor
