#include "io/cell_colours.h"

#include <algorithm>
#include <set>

namespace geovor {

std::vector<int> colours_of_cells(const VoronoiDiagram& diagram) {
  const int n = static_cast<int>(diagram.sites.size());
  std::vector<std::set<int>> neighbours(n);
  for (const DiagramEdge& e : diagram.edges) {
    if (e.left != e.right) neighbours[e.left].insert(e.right), neighbours[e.right].insert(e.left);
  }
  // Take away the cell with the fewest neighbours left, again and again; colour in the opposite order.
  std::vector<int> degree(n), order;
  std::set<std::pair<int, int>> queue;
  for (int i = 0; i < n; ++i) degree[i] = static_cast<int>(neighbours[i].size()), queue.insert({degree[i], i});
  while (!queue.empty()) {
    const int i = queue.begin()->second;
    queue.erase(queue.begin());
    order.push_back(i);
    degree[i] = -1;
    for (int k : neighbours[i]) {
      if (degree[k] < 0) continue;
      queue.erase({degree[k], k});
      queue.insert({--degree[k], k});
    }
  }
  std::vector<int> colour(n, -1);
  for (auto i = order.rbegin(); i != order.rend(); ++i) {
    std::set<int> taken;
    for (int k : neighbours[*i]) taken.insert(colour[k]);
    colour[*i] = 0;
    while (taken.count(colour[*i]) > 0) ++colour[*i];
  }
  return colour;
}

}  // namespace geovor
