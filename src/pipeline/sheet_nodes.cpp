#include "pipeline/sheet_nodes.h"

#include <algorithm>
#include <cmath>

namespace geovor {

int MergedVertices::add(const Xyz& x) {
  points_.push_back(x);
  return sets_.add();
}

SheetNodes::SheetNodes(const CadModel& model, const FaceOutline& outline, double merge)
    : outline_(outline), merge_(merge) {
  const auto& sides = outline.sides();
  raw_.resize(sides.size());
  std::map<int, int> of_model;
  for (int i = 0; i < static_cast<int>(sides.size()); ++i) {
    const OutlineSide& s = sides[i];
    const CadEdge& edge = model.edges[s.edge];
    for (bool at_end : {false, true}) {
      const int named = at_end ? edge.last_vertex : edge.first_vertex;
      const double t = at_end ? s.t.back() : s.t.front();
      const auto known = of_model.find(named);
      if (named >= 0 && known != of_model.end()) {
        add_place(i, t, known->second);
        continue;
      }
      const int made = vertices_.add(named >= 0 ? model.vertices[named].position
                                                : outline.surface().position(at_end ? s.uv.back() : s.uv.front()));
      if (named >= 0) of_model[named] = made;
      add_place(i, t, made);
    }
  }
}

int SheetNodes::key(int side) const {
  const int partner = outline_.sides()[side].partner;
  return partner >= 0 ? std::min(side, partner) : side;
}

int SheetNodes::diagram_vertex(int index, const Xyz& x) {
  const auto [at, is_new] = of_diagram_.try_emplace(index, -1);
  if (is_new) at->second = vertices_.add(x);
  return at->second;
}

void SheetNodes::add_place(int side, double t, int vertex) {
  if (vertex < 0) vertex = vertices_.add(outline_.surface().position(outline_.sides()[side].at(t)));
  raw_[key(side)].push_back({t, vertex});
}

void SheetNodes::settle() {
  constexpr double kSameMeridian = 1e-9;  // of the length of a pole's p-curve
  const auto& sides = outline_.sides();
  const int n = static_cast<int>(sides.size());
  places_.assign(n, {}), place_vertex_.assign(n, {});
  for (int i = 0; i < n; ++i) {
    auto& list = raw_[i];
    std::stable_sort(list.begin(), list.end(), [](const Place& a, const Place& b) { return a.t < b.t; });
    const OutlineSide& s = sides[i];
    for (const Place& p : list) {
      if (s.pole) vertices_.merge(list.front().vertex, p.vertex);
      const double before = places_[i].empty() ? 0.0 : places_[i].back();
      const bool same =
          !places_[i].empty() &&
          (s.pole ? p.t - before <= kSameMeridian * (s.t.back() - s.t.front())
                  : p.t == before ||
                        (outline_.surface().position(s.at(p.t)) - outline_.surface().position(s.at(before))).norm() <=
                            merge_);
      // The last place is the side's end: it takes the place of one just before it, unless that is the beginning.
      const bool is_end = p.t == s.t.back();
      if (same && !(is_end && places_[i].size() == 1)) {
        vertices_.merge(place_vertex_[i].back(), p.vertex);
        if (is_end) places_[i].back() = p.t;
        continue;
      }
      places_[i].push_back(p.t), place_vertex_[i].push_back(p.vertex);
    }
  }
  // A side's last node, in the direction of the loop, is the first of the next side.
  first_node_.assign(n, 0);
  for (int i = 0; i < n; ++i) {
    first_node_[i] = node_count_;
    node_count_ += static_cast<int>(places(i).size()) - 1;
  }
  node_vertex_.assign(node_count_, -1);
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < static_cast<int>(places(i).size()); ++k) {
      int& vertex = node_vertex_[node_at(i, k)];
      const int here = place_vertex_[key(i)][k];
      if (vertex >= 0) vertices_.merge(vertex, here);
      vertex = here;
    }
  }
}

int SheetNodes::node_at(int side, int k) const {
  const OutlineSide& s = outline_.sides()[side];
  const int last = static_cast<int>(places(side).size()) - 1;
  const int step = s.reversed ? last - k : k;
  return step == last ? first_node_[s.next] : first_node_[side] + step;
}

int SheetNodes::node(int side, double t) const {
  const auto& list = places(side);
  const auto above = std::lower_bound(list.begin(), list.end(), t);
  int k = static_cast<int>(above - list.begin());
  if (above == list.end() || (k > 0 && t - list[k - 1] < *above - t)) --k;
  return node_at(side, k);
}

}  // namespace geovor
