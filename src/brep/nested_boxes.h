// Boxes around the pieces of a chain, and around runs of them: what lies far away is passed over at a glance.
#pragma once

#include <vector>

namespace geovor {

/// Boxes nested by halving their list again and again: neighbours in the list should be neighbours in place. `Box` has
/// `void include(const Box&)`.
template <typename Box>
class NestedBoxes {
 public:
  NestedBoxes() = default;
  explicit NestedBoxes(const std::vector<Box>& leaves) {
    nodes_.reserve(2 * leaves.size());
    if (!leaves.empty()) add(leaves, 0, static_cast<int>(leaves.size()));
  }

  /// Calls visit(i) for the leaves that can't be passed over, in their order; what enter(box) declines is passed over.
  template <typename Enter, typename Visit>
  void walk(Enter&& enter, Visit&& visit) const {
    const int n = static_cast<int>(nodes_.size());
    for (int i = 0; i < n;) {
      const Node& node = nodes_[i];
      if (!enter(node.box)) {
        i = node.skip;
        continue;
      }
      if (node.leaf >= 0) visit(node.leaf);
      ++i;
    }
  }

 private:
  struct Node {
    Box box;
    int skip = 0;   ///< the node after all that lie in this one
    int leaf = -1;  ///< its place in the list; -1: a run of leaves
  };

  void add(const std::vector<Box>& leaves, int first, int last) {
    const int here = static_cast<int>(nodes_.size());
    nodes_.push_back({leaves[first], 0, last - first == 1 ? first : -1});
    for (int i = first + 1; i < last; ++i) nodes_[here].box.include(leaves[i]);
    if (last - first > 1) {
      const int middle = first + (last - first) / 2;
      add(leaves, first, middle);
      add(leaves, middle, last);
    }
    nodes_[here].skip = static_cast<int>(nodes_.size());
  }

  std::vector<Node> nodes_;
};

}  // namespace geovor
