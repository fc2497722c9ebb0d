// Numbers of which several turn out to be one.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

namespace geovor {

/// The sets {0}, {1}, … joined step by step; a set is named by its least number.
class MergedSets {
 public:
  int add() {
    parent_.push_back(count());
    return count() - 1;
  }
  void resize(int count) {
    while (this->count() < count) add();
  }
  int count() const { return static_cast<int>(parent_.size()); }

  int find(int a) const {
    while (parent_[a] != a) a = parent_[a];
    return a;
  }

  /// What was passed on the way up is hung higher, so that later ways are short.
  void merge(int a, int b) {
    const int to = std::min(find(a), find(b));
    for (int i : {a, b}) {
      while (i != to) i = std::exchange(parent_[i], to);
    }
  }

 private:
  std::vector<int> parent_;
};

}  // namespace geovor
