#include "delaunay/half_edges.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace geovor {

HalfEdges::HalfEdges(int vertices, const std::vector<std::array<int, 3>>& triangles) : out_(vertices, kNone) {
  origin_.reserve(3 * triangles.size());
  for (const auto& corners : triangles) {
    for (int v : corners) {
      out_[v] = static_cast<int>(origin_.size());
      origin_.push_back(v);
    }
  }
  twin_.assign(origin_.size(), kNone);
  fixed_.assign(origin_.size(), 0);

  std::vector<int> order(origin_.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [this](int e) {
    const int a = origin(e), b = target(e);
    return std::array<int, 3>{std::min(a, b), std::max(a, b), a < b ? 0 : 1};
  };
  std::sort(order.begin(), order.end(), [&key](int e, int f) { return key(e) < key(f); });
  for (size_t i = 0; i + 1 < order.size(); ++i) {
    const int e = order[i];
    const int f = order[i + 1];
    if (origin(e) == target(f) && target(e) == origin(f)) link(e, f);
  }
}

void HalfEdges::set_fixed(int e) {
  fixed_[e] = 1;
  if (twin_[e] != kNone) fixed_[twin_[e]] = 1;
}

void HalfEdges::link(int e, int f) {
  twin_[e] = f;
  if (f != kNone) twin_[f] = e;
}

std::vector<int> HalfEdges::star(int v) const {
  std::vector<int> result;
  const int start = out_[v];
  if (start == kNone) return result;
  int first = start;  // turn clockwise to the border, or once around
  while (twin_[first] != kNone) {
    first = next(twin_[first]);
    if (first == start) break;
  }
  int e = first;
  do {
    result.push_back(e);
    e = twin_[prev(e)];
  } while (e != kNone && e != first);
  return result;
}

bool HalfEdges::on_border(int v) const {
  const int start = out_[v];
  if (start == kNone) return true;
  int e = start;
  do {
    if (twin_[e] == kNone) return true;
    e = next(twin_[e]);
  } while (e != start);
  return false;
}

int HalfEdges::find(int a, int b) const {
  for (int e : star(a)) {
    if (target(e) == b) return e;
  }
  return kNone;
}

int HalfEdges::add_vertex() {
  out_.push_back(kNone);
  return vertex_count() - 1;
}

int HalfEdges::add_triangle() {
  origin_.insert(origin_.end(), 3, kNone);
  twin_.insert(twin_.end(), 3, kNone);
  fixed_.insert(fixed_.end(), 3, 0);
  return triangle_count() - 1;
}

void HalfEdges::set_triangle(int t, int a, int b, int c) {
  origin_[3 * t] = a;
  origin_[3 * t + 1] = b;
  origin_[3 * t + 2] = c;
  for (int i = 0; i < 3; ++i) {
    twin_[3 * t + i] = kNone;
    fixed_[3 * t + i] = 0;
    out_[origin_[3 * t + i]] = 3 * t + i;
  }
}

namespace {

// What has to be remembered of an outer edge while its triangle is made anew.
struct Outside {
  int twin;
  char fixed;
};

}  // namespace

void HalfEdges::flip(int e) {
  assert(!fixed(e));
  const int f = twin_[e];
  const int a = origin(e), b = target(e), c = apex(e), d = apex(f);
  const auto keep = [this](int x) { return Outside{twin_[x], fixed_[x]}; };
  const Outside bc = keep(next(e)), ca = keep(prev(e)), ad = keep(next(f)), db = keep(prev(f));
  const int t = triangle(e), s = triangle(f);
  const int shift_e = e - 3 * t, shift_f = f - 3 * s;
  // The two new triangles (d, c, a) and (c, d, b), turned so that e and f keep their places.
  const auto place = [this](int tri, int shift, std::array<int, 3> v) {
    std::array<int, 3> turned{};
    for (int i = 0; i < 3; ++i) turned[(i + shift) % 3] = v[i];
    set_triangle(tri, turned[0], turned[1], turned[2]);
  };
  place(t, shift_e, {d, c, a});
  place(s, shift_f, {c, d, b});
  link(e, f);
  const auto restore = [this](int x, Outside o) {
    link(x, o.twin);
    fixed_[x] = o.fixed;
  };
  restore(next(e), ca);
  restore(prev(e), ad);
  restore(next(f), db);
  restore(prev(f), bc);
}

void HalfEdges::split_triangle(int t, int v) {
  const auto [a, b, c] = corners(t);
  std::array<Outside, 3> outside{};
  for (int i = 0; i < 3; ++i) outside[i] = {twin_[3 * t + i], fixed_[3 * t + i]};
  const std::array<int, 3> tri = {t, add_triangle(), add_triangle()};
  set_triangle(tri[0], a, b, v);
  set_triangle(tri[1], b, c, v);
  set_triangle(tri[2], c, a, v);
  for (int i = 0; i < 3; ++i) {
    link(3 * tri[i], outside[i].twin);
    fixed_[3 * tri[i]] = outside[i].fixed;
    link(3 * tri[i] + 1, 3 * tri[(i + 1) % 3] + 2);
  }
}

void HalfEdges::split_edge(int e, int v) {
  // One side: (a, b, c) becomes (a, v, c) in its old place and (v, b, c) as a new triangle.
  const auto split_side = [this, v](int edge) {
    const int a = origin(edge), b = target(edge), c = apex(edge);
    const Outside bc{twin_[next(edge)], fixed_[next(edge)]};
    const Outside ca{twin_[prev(edge)], fixed_[prev(edge)]};
    const char edge_fixed = fixed_[edge];
    const int t = triangle(edge), s = add_triangle();
    set_triangle(t, a, v, c);
    set_triangle(s, v, b, c);
    link(3 * t + 1, 3 * s + 2);
    link(3 * t + 2, ca.twin);
    fixed_[3 * t + 2] = ca.fixed;
    link(3 * s + 1, bc.twin);
    fixed_[3 * s + 1] = bc.fixed;
    fixed_[3 * t] = fixed_[3 * s] = edge_fixed;
    return std::array<int, 2>{3 * t, 3 * s};  // a -> v, v -> b
  };
  const int f = twin_[e];
  const auto [av, vb] = split_side(e);
  if (f == kNone) return;
  const auto [bv, va] = split_side(f);
  link(av, va);
  link(vb, bv);
}

bool HalfEdges::can_collapse(int e) const {
  const int u = origin(e), w = target(e);
  if (twin_[e] == kNone || fixed(e) || on_border(u)) return false;
  std::vector<int> around;
  for (int f : star(u)) {
    if (fixed_[f]) return false;
    around.push_back(target(f));
  }
  if (around.size() < 4) return false;
  std::sort(around.begin(), around.end());
  if (std::adjacent_find(around.begin(), around.end()) != around.end()) return false;
  int common = 0;
  const std::vector<int> star_w = star(w);
  for (int f : star_w) common += std::binary_search(around.begin(), around.end(), target(f));
  // A border vertex has one neighbour at which no half-edge of its star ends with the target: the last prev.
  if (!star_w.empty() && twin_[prev(star_w.back())] == kNone) {
    common += std::binary_search(around.begin(), around.end(), origin(prev(star_w.back())));
  }
  return common == 2;
}

void HalfEdges::collapse(int e) {
  assert(can_collapse(e));
  const int f = twin_[e];
  const int u = origin(e), w = target(e), c = apex(e), d = apex(f);
  for (int x : star(u)) origin_[x] = w;
  const int bc = twin_[next(e)], ca = twin_[prev(e)], ad = twin_[next(f)], db = twin_[prev(f)];
  const char keep_c = fixed_[next(e)], keep_d = fixed_[prev(f)];
  const auto join = [this](int x, int y, char is_fixed) {
    if (x != kNone) twin_[x] = y;
    if (y != kNone) twin_[y] = x;
    if (x != kNone) fixed_[x] = is_fixed;
    if (y != kNone) fixed_[y] = is_fixed;
  };
  join(bc, ca, keep_c);
  join(ad, db, keep_d);
  for (int t : {triangle(e), triangle(f)}) {
    for (int i = 0; i < 3; ++i) origin_[3 * t + i] = twin_[3 * t + i] = kNone;
  }
  out_[u] = kNone;
  // ca now runs from w to c seen from outside: its origin was c's side; pick living half-edges for the three that stay.
  const auto repair = [this](int v, std::initializer_list<int> nearby) {
    for (int x : nearby) {
      if (x == kNone) continue;
      for (int y : {x, next(x)}) {
        if (origin_[y] == v) {
          out_[v] = y;
          return;
        }
      }
    }
  };
  repair(w, {bc, ca, ad, db});
  repair(c, {bc, ca});
  repair(d, {ad, db});
}

void HalfEdges::sew(int e, int f) {
  assert(twin_[e] == kNone && twin_[f] == kNone);
  link(e, f);
  fixed_[e] = fixed_[f] = static_cast<char>(fixed_[e] || fixed_[f]);
}

void HalfEdges::compact() {
  std::vector<int> renumbered(triangle_count(), kNone);
  int count = 0;
  for (int t = 0; t < triangle_count(); ++t) {
    if (alive(t)) renumbered[t] = count++;
  }
  const auto moved = [&renumbered](int e) { return e == kNone ? kNone : 3 * renumbered[e / 3] + e % 3; };
  for (int t = 0; t < triangle_count(); ++t) {
    if (renumbered[t] == kNone) continue;
    for (int i = 0; i < 3; ++i) {
      const int to = 3 * renumbered[t] + i;
      origin_[to] = origin_[3 * t + i];
      twin_[to] = moved(twin_[3 * t + i]);
      fixed_[to] = fixed_[3 * t + i];
    }
  }
  origin_.resize(3 * count);
  twin_.resize(3 * count);
  fixed_.resize(3 * count);
  std::fill(out_.begin(), out_.end(), kNone);
  for (int e = 3 * count - 1; e >= 0; --e) out_[origin_[e]] = e;
}

std::optional<std::string> HalfEdges::first_fault() const {
  const auto say = [](const char* what, int e) { return std::string("half-edge ") + std::to_string(e) + ": " + what; };
  for (int e = 0; e < 3 * triangle_count(); ++e) {
    if (!alive(triangle(e))) continue;
    if (origin_[e] < 0 || origin_[e] >= vertex_count()) return say("its origin is no vertex", e);
    if (origin_[e] == target(e)) return say("it ends where it starts", e);
    const int f = twin_[e];
    if (f == kNone) continue;
    if (!alive(triangle(f))) return say("its twin was removed", e);
    if (twin_[f] != e) return say("its twin's twin is another", e);
    if (origin(f) != target(e) || target(f) != origin(e)) return say("its twin has other ends", e);
    if (fixed_[e] != fixed_[f]) return say("it is fixed on one side only", e);
  }
  for (int v = 0; v < vertex_count(); ++v) {
    const int e = out_[v];
    if (e == kNone) continue;
    if (!alive(triangle(e)) || origin_[e] != v) return "vertex " + std::to_string(v) + ": its half-edge is not its own";
  }
  return std::nullopt;
}

}  // namespace geovor
