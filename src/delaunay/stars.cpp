#include "delaunay/stars.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "delaunay/close_gaps.h"
#include "delaunay/place_order.h"
#include "delaunay/space_grid.h"

namespace geovor {
namespace {

// Neighbours are looked for so many sizes away. Where sizes differ a circle may reach farther: then again, so many
// times as far, up to the last.
constexpr double kReach = 2.2, kFarther = 1.8, kFarthest = 30.0;
// A neighbour's normal turns by less than about 78 degrees.
constexpr double kLeastCosine = 0.2;
// Triangles thinner than this are none.
constexpr double kThin = 1e-9;
// Circles whose centres agree this well, in parts of the side that they share, are one.
constexpr double kOneCircle = 1e-7;

using Flat = Eigen::Vector2d;

double cross(const Flat& a, const Flat& b) { return a[0] * b[1] - a[1] * b[0]; }

struct Neighbour {
  int v;
  Flat y;  ///< in the tangent plane
};

class Stars {
 public:
  Stars(const std::vector<MeshVertex>& points, const MeshBorder& border, double size)
      : points_(points), border_(border), order_(size) {
    for (const MeshVertex& p : points) grid_.add(p.x);
  }

  std::optional<HalfEdges> run() {
    begin_.push_back(0);
    for (int i = 0; i < static_cast<int>(points_.size()); ++i) {
      find_star(i);
      begin_.push_back(static_cast<int>(link_.size()));
    }
    std::vector<std::array<int, 3>> agreed;
    std::vector<Disputed> disputed;
    for (int i = 0; i < static_cast<int>(points_.size()); ++i) {
      for (int k = begin_[i]; k < begin_[i + 1]; ++k) count_votes({i, link_[k][0], link_[k][1]}, agreed, disputed);
    }
    std::sort(disputed.begin(), disputed.end());
    std::vector<std::array<int, 3>> candidates;
    for (const Disputed& d : disputed) candidates.push_back(d.triangle);
    return close_gaps(points_, border_, std::move(agreed), candidates);
  }

 private:
  struct Disputed {
    int against;
    PlaceOrder::Key place;
    std::array<int, 3> triangle;
    bool operator<(const Disputed& o) const {
      return std::tie(against, place, triangle) < std::tie(o.against, o.place, o.triangle);
    }
  };

  bool is_border(int i) const { return border_.on_border(i); }
  bool is_fixed(int i) const { return i < static_cast<int>(border_.points.size()); }

  bool has(int i, int j, int k) const {
    return std::find(link_.begin() + begin_[i], link_.begin() + begin_[i + 1], std::array<int, 2>{j, k}) !=
           link_.begin() + begin_[i + 1];
  }

  // Each triangle once, when its voter with the smallest number comes. At a tip its own star alone decides: seen from
  // its neighbours, whose tangent planes turn about it, the order around it is lost.
  void count_votes(const std::array<int, 3>& t, std::vector<std::array<int, 3>>& agreed,
                   std::vector<Disputed>& disputed) {
    const bool second = has(t[1], t[2], t[0]), third = has(t[2], t[0], t[1]);
    if ((second && t[1] < t[0]) || (third && t[2] < t[0])) return;
    const std::array<bool, 3> votes = {true, second, third};
    for (int k = 0; k < 3; ++k) {
      if (!is_fixed(t[k]) || !border_.is_tip[t[k]]) continue;
      if (votes[k]) agreed.push_back(t);
      return;
    }
    if (second && third) {
      agreed.push_back(t);
      return;
    }
    const Xyz middle = points_[t[0]].x + points_[t[1]].x + points_[t[2]].x;
    disputed.push_back({second || third ? 1 : 2, order_.key(middle), t});
  }

  // Seen from the point, in the direction of the chord, as far away as along the surface.
  void find_neighbours(int i, double reach) {
    const MeshVertex& a = points_[i];
    const Xyz e1 = a.n.unitOrthogonal(), e2 = a.n.cross(e1);
    near_.clear();
    grid_.each_near(a.x, reach, [&](int j) {
      const MeshVertex& b = points_[j];
      const Xyz chord = b.x - a.x;
      const double d2 = chord.squaredNorm();
      if (j == i || !(d2 < reach * reach) || !(d2 > 0.0) || !faces(i, j)) return;
      const Flat flat(chord.dot(e1), chord.dot(e2));
      if (!(flat.norm() > 0.0)) return;
      near_.push_back({j, geodesic_estimate(a, b) / flat.norm() * flat});
    });
    leave_hidden_out(i);
  }

  // On one side of the face, and of the border where that passes a place more than once.
  bool faces(int i, int j) const {
    if (is_fixed(j) && border_.is_one_of_many[j] && !border_.sees(j, points_[i].x)) return false;
    if ((is_fixed(i) && border_.is_tip[i]) || (is_fixed(j) && border_.is_tip[j])) return true;
    return points_[i].n.dot(points_[j].n) > kLeastCosine;
  }

  // Behind an edge of the border there may be other parts of the face: they are no neighbours.
  void leave_hidden_out(int i) {
    walls_.clear();
    for (const Neighbour& n : near_) {
      if (!is_border(n.v) || border_.next[n.v] == i || n.v == i) continue;
      const auto b =
          std::find_if(near_.begin(), near_.end(), [&](const Neighbour& m) { return m.v == border_.next[n.v]; });
      if (b != near_.end()) walls_.push_back({n, *b});
    }
    if (walls_.empty()) return;
    const auto hidden = [this](const Neighbour& n) {
      return std::any_of(walls_.begin(), walls_.end(), [&n](const auto& wall) {
        const auto& [a, b] = wall;
        if (a.v == n.v || b.v == n.v) return false;
        const Flat side = b.y - a.y;
        // The ways to n and along the wall meet inside of both.
        return cross(n.y, a.y) * cross(n.y, b.y) < 0.0 && cross(side, -a.y) * cross(side, n.y - a.y) < 0.0;
      });
    };
    near_.erase(std::remove_if(near_.begin(), near_.end(), hidden), near_.end());
  }

  const Neighbour* first_neighbour(int i) const {
    const Neighbour* first = nullptr;
    for (const Neighbour& n : near_) {
      if (is_border(i)) {
        if (n.v == border_.next[i]) return &n;
      } else if (!first || n.y.squaredNorm() < first->y.squaredNorm()) {
        first = &n;
      }
    }
    return is_border(i) ? nullptr : first;
  }

  // Gift wrapping: from neighbour to neighbour counter-clockwise, each time to the one whose circle lies lowest.
  void find_star(int i) {
    const size_t begin = link_.size();
    for (double reach = kReach; reach < kFarthest; reach *= kFarther) {
      link_.resize(begin);
      if (wrap(i, reach * points_[i].h)) return;
    }
  }

  // Whether the star is the same however many more neighbours are looked at: all its circles lie within `reach`.
  bool wrap(int i, double reach) {
    find_neighbours(i, reach);
    const Neighbour* const first = first_neighbour(i);
    const int last = is_border(i) ? border_.before[i] : -1;
    const Neighbour* now = first;
    bool lies_within = true;
    for (size_t guard = 0; now && guard < near_.size(); ++guard) {
      double radius = 0.0;
      const Neighbour* next = next_neighbour(i, *now, radius);
      if (!next) return false;
      link_.push_back({now->v, next->v});
      lies_within = lies_within && 2.0 * radius < reach;
      if (next == first || next->v == last) return lies_within;
      now = next;
    }
    return false;
  }

  // The circle through the point, `now` and n has its centre at now / 2 + height * (now turned by 90 degrees).
  const Neighbour* next_neighbour(int i, const Neighbour& now, double& radius) {
    const double c = now.y.norm();
    const auto height = [&](const Neighbour& n, double s) { return (n.y.squaredNorm() - n.y.dot(now.y)) / (2.0 * s); };
    const Neighbour* best = nullptr;
    double least = 0.0;
    for (const Neighbour& n : near_) {
      const double s = cross(now.y, n.y);
      if (!(s > kThin * c * c)) continue;
      const double h = height(n, s);
      if (best && !(h < least)) continue;
      best = &n, least = h;
    }
    if (!best) return nullptr;
    radius = c * std::hypot(0.5, least);
    circle_.clear();
    for (const Neighbour& n : near_) {
      const double s = cross(now.y, n.y);
      if (s > kThin * c * c && height(n, s) <= least + kOneCircle * (1.0 + std::abs(least))) circle_.push_back(&n);
    }
    return circle_.size() == 1 ? best : of_one_circle(i, now);
  }

  // A polygon on one circle is a fan about its corner that comes first in space; so all its corners see it.
  const Neighbour* of_one_circle(int i, const Neighbour& now) {
    std::sort(circle_.begin(), circle_.end(),
              [](const Neighbour* a, const Neighbour* b) { return cross(a->y, b->y) > 0.0; });
    const auto key = [this](int v) { return order_.key(points_[v].x); };
    const auto corner = std::min_element(circle_.begin(), circle_.end(),
                                         [&](const Neighbour* a, const Neighbour* b) { return key(a->v) < key(b->v); });
    const PlaceOrder::Key least = key((*corner)->v), own = key(i), side = key(now.v);
    if (least < own && least < side) return *corner;
    return own < side ? circle_.front() : circle_.back();
  }

  const std::vector<MeshVertex>& points_;
  const MeshBorder& border_;
  PlaceOrder order_;
  SpaceGrid grid_;
  std::vector<std::array<int, 2>> link_;  ///< of all stars: the sides that face their points
  std::vector<int> begin_;                ///< of a star in link_
  std::vector<Neighbour> near_;
  std::vector<std::array<Neighbour, 2>> walls_;  ///< edges of the border near by
  std::vector<const Neighbour*> circle_;
};

}  // namespace

std::optional<HalfEdges> triangulate_by_stars(const std::vector<MeshVertex>& points, const MeshBorder& border,
                                              double size) {
  return Stars(points, border, size).run();
}

}  // namespace geovor
