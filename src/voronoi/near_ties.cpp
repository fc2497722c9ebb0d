#include "voronoi/near_ties.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "surface/forms.h"
#include "voronoi/tie_tree.h"

namespace geovor {
namespace {

using Eigen::Vector2d;
constexpr double kInf = std::numeric_limits<double>::infinity();

// A place is where the tangent plane says if it is no farther from there than this part of the radius; beside a pole
// of the parameters it is not.
constexpr double kInPlane = 1e-14;

// What is left of a segment of the border for the direction in which it ends.
constexpr double kBeforeEnd = 1e-9;

double cross(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

/// The border as the disk sees it: a straight line, or two half lines that meet in a corner.
class StraightBorder {
 public:
  struct Line {
    Vector2d q, e;  ///< passes q in the direction e, the face to the left
    double lo, hi;  ///< from and to which length
    BorderPlace place;
    double rate;  ///< of the place's parameter per length
  };

  StraightBorder(const FaceBorder& border, const SiteRay& frame, double disk) : border_(border), frame_(frame) {
    if (border.cycle_count() == 0 || !border.near_border(frame.x, disk)) return;
    const auto near = border.nearest(border.domain().to_principal(frame.uv));
    if (!near) return;
    const int n = border.segment_count(near->cycle), k = static_cast<int>(near->parameter) % n;
    const Line here = line({near->cycle, near->parameter}, {near->cycle, near->parameter});
    if (!(std::abs(cross(here.q, here.e)) <= disk)) return;
    const double before = (near->parameter - std::floor(near->parameter)) / here.rate,
                 after = (1.0 - (near->parameter - std::floor(near->parameter))) / here.rate;
    lines_ = {here};
    if (before < disk && before <= after) {
      lines_[0].lo = -before;
      const double end = k == 0 ? n : k;
      lines_.insert(lines_.begin(), line({near->cycle, end}, {near->cycle, end - kBeforeEnd}));
      lines_[0].hi = 0.0;
    } else if (after < disk) {
      lines_[0].hi = after;
      const double start = k + 1 == n ? 0 : k + 1;
      lines_.push_back(line({near->cycle, start}, {near->cycle, start}));
      lines_[1].lo = 0.0;
    }
  }

  const std::vector<Line>& lines() const { return lines_; }

  bool inside(const Vector2d& p) const {
    const auto left_of = [&](const Line& l) { return cross(l.e, p - l.q) > 0.0; };
    if (lines_.size() < 2) return lines_.empty() || left_of(lines_[0]);
    const bool convex = cross(lines_[0].e, lines_[1].e) > 0.0;
    return convex ? left_of(lines_[0]) && left_of(lines_[1]) : left_of(lines_[0]) || left_of(lines_[1]);
  }

  /// Where p lies on the border, if it does to within `near`.
  std::optional<BorderPlace> place_of(const Vector2d& p, double near) const {
    for (const Line& l : lines_) {
      const double along = std::clamp(l.e.dot(p - l.q), l.lo, l.hi);
      if ((l.q + along * l.e - p).norm() <= near) return place(l, along);
    }
    return std::nullopt;
  }

  BorderPlace place(const Line& l, double along) const {
    const double n = border_.segment_count(l.place.cycle), t = l.place.parameter + l.rate * along;
    return {l.place.cycle, t - n * std::floor(t / n)};
  }

 private:
  // The place whose segment tells the direction may lie a little before the other.
  Line line(BorderPlace at, BorderPlace tells) const {
    const Xyz d = push_forward(border_.domain().surface().jet(border_.uv(tells)), border_.direction(tells));
    const Xyz way = border_.xyz(at) - frame_.x;
    const Vector2d e(d.dot(frame_.T), d.dot(frame_.N));
    return {{way.dot(frame_.T), way.dot(frame_.N)}, e.normalized(), -kInf, kInf, at, 1.0 / e.norm()};
  }

  const FaceBorder& border_;
  const SiteRay& frame_;
  std::vector<Line> lines_;
};

class KnotMaker {
 public:
  KnotMaker(const FaceBorder& border, const SiteRays& rays, const std::vector<SiteRay>& generators)
      : rays_(rays),
        g_(generators),
        disk_(kTiedDisk * generators.front().polar.s),
        tie_(kOneVertex * generators.front().polar.s),
        tree_(generators, tie_),
        border_(border, generators.front(), disk_) {}

  Knot make() {
    for (const TieTree::Branch& b : tree_.branches()) cut(b);
    add_nodes();
    for (const Piece& piece : pieces_) {
      const int from = vertex_at(piece.start), to = vertex_at(piece.end);
      if (from >= 0 && to >= 0) knot_.edges.push_back({from, to, piece.branch->left, piece.branch->right});
    }
    return std::move(knot_);
  }

 private:
  /// Where a piece of a branch in the face ends: at a node, at the border, or where the disk does.
  struct End {
    double a;
    int node = -1, crossing = -1;
  };
  struct Piece {
    const TieTree::Branch* branch;
    End start, end;
  };

  bool in_disk(int node) const { return node >= 0 && tree_.nodes()[node].p.norm() <= disk_; }

  void cut(const TieTree::Branch& b) {
    const double half2 = disk_ * disk_ - b.base.squaredNorm();
    if (!(half2 > 0.0)) return;
    const double half = std::sqrt(half2);
    const auto along = [&](int node) { return b.tangent.dot(tree_.nodes()[node].p - b.base); };
    End lo{-half}, hi{half};
    if (b.from >= 0 && along(b.from) > lo.a) lo.a = along(b.from), lo.node = in_disk(b.from) ? b.from : -1;
    if (b.to >= 0 && along(b.to) < hi.a) hi.a = along(b.to), hi.node = in_disk(b.to) ? b.to : -1;
    if (!(lo.a < hi.a)) {
      // Two nodes in one place, or one on the rim.
      if (lo.node < 0 && hi.node < 0) return;
      (lo.node >= 0 ? hi : lo).a = (lo.node >= 0 ? lo : hi).a;
    }
    std::vector<End> ends = {lo};
    for (const auto& [a, place] : crossings(b, lo, hi)) {
      ends.push_back({a, -1, static_cast<int>(places_.size())});
      places_.push_back(place);
    }
    ends.push_back(hi);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      if (border_.inside(b.base + 0.5 * (ends[i].a + ends[i + 1].a) * b.tangent)) add(b, ends[i], ends[i + 1]);
    }
  }

  // A node on the border is itself where its branches cross it.
  std::vector<std::pair<double, BorderPlace>> crossings(const TieTree::Branch& b, const End& lo, const End& hi) const {
    std::vector<std::pair<double, BorderPlace>> found;
    const auto taken = [&](const End& end, const Vector2d& p) {
      return end.node >= 0 && on_border(end.node) && (tree_.nodes()[end.node].p - p).norm() < kNodeReach * tie_;
    };
    for (const auto& l : border_.lines()) {
      const double sine = cross(b.tangent, l.e);
      const double a = cross(l.q - b.base, l.e) / sine, along = cross(l.q - b.base, b.tangent) / sine;
      const Vector2d p = b.base + a * b.tangent;
      if (!(a > lo.a && a < hi.a && along >= l.lo && along < l.hi) || taken(lo, p) || taken(hi, p)) continue;
      found.emplace_back(a, border_.place(l, along));
    }
    std::sort(found.begin(), found.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    return found;
  }

  bool on_border(int node) const { return border_.place_of(tree_.nodes()[node].p, tie_).has_value(); }

  // A piece starts, or ends, on the border in a vertex of its own.
  void add(const TieTree::Branch& b, End start, End end) {
    for (End* e : {&start, &end}) {
      if (e->crossing < 0) continue;
      // Seen on the way into the face.
      const std::vector<int> pair = e == &start ? std::vector<int>{b.right, b.left} : std::vector<int>{b.left, b.right};
      e->crossing = add_vertex(pair, b.base + e->a * b.tangent, places_[e->crossing]);
    }
    pieces_.push_back({&b, start, end});
  }

  void add_nodes() {
    of_node_.assign(tree_.nodes().size(), -1);
    for (int i = 0; i < static_cast<int>(tree_.nodes().size()); ++i) {
      if (!in_disk(i)) continue;
      const TieTree::Node& node = tree_.nodes()[i];
      const std::vector<int> fan = fan_of(i);
      if (fan.size() < 2) continue;
      const bool whole = fan.size() == node.corners.size() + 1;
      const auto place = whole ? std::nullopt : border_.place_of(node.p, tie_);
      if (whole || place) of_node_[i] = add_vertex(whole ? node.corners : fan, node.p, place);
    }
  }

  /// The generators of a node's edges into the face, counter-clockwise; the first again at the end if all edges are.
  std::vector<int> fan_of(int node) const {
    const std::vector<int>& corners = tree_.nodes()[node].corners;
    const int n = static_cast<int>(corners.size());
    std::vector<bool> kept(n, false);
    for (const Piece& piece : pieces_) {
      const TieTree::Branch& b = *piece.branch;
      for (int k = 0; k < n; ++k) {
        const int right = corners[k], left = corners[(k + 1) % n];
        kept[k] = kept[k] || (piece.start.node == node && right == b.right && left == b.left) ||
                  (piece.end.node == node && right == b.left && left == b.right);
      }
    }
    const int gap = static_cast<int>(std::find(kept.begin(), kept.end(), false) - kept.begin());
    std::vector<int> fan;
    for (int k = 0, at = gap + 1; k < n; ++k, ++at) {
      if (!kept[at % n]) continue;
      if (fan.empty()) fan.push_back(corners[at % n]);
      fan.push_back(corners[(at + 1) % n]);
    }
    return fan;
  }

  int vertex_at(const End& end) const { return end.node >= 0 ? of_node_[end.node] : end.crossing; }

  int add_vertex(const std::vector<int>& which, const Vector2d& p, std::optional<BorderPlace> place) {
    const SiteRay& g = g_.front();
    const Xyz way = p[0] * g.T + p[1] * g.N;
    Uv m = g.uv + tangent_components(rays_.surface().jet(g.uv), way);
    if (!((rays_.surface().position(m) - g.x - way).norm() <= kInPlane * g.polar.s)) {
      if (const auto ray = rays_.at(g.site, carry(g, g.x + way))) m = ray->uv;
    }
    const SurfaceJet j = rays_.surface().jet(m);
    Knot::Vertex vertex;
    vertex.place = place;
    for (int k : which) vertex.generators.push_back(moved(g_[k], m, j));
    knot_.vertices.push_back(std::move(vertex));
    return static_cast<int>(knot_.vertices.size()) - 1;
  }

  // A node on the border within the tie of it crosses at a flat angle farther off.
  static constexpr double kNodeReach = 1e2;

  const SiteRays& rays_;
  const std::vector<SiteRay>& g_;
  double disk_, tie_;
  TieTree tree_;
  StraightBorder border_;
  std::vector<BorderPlace> places_;
  std::vector<Piece> pieces_;
  std::vector<int> of_node_;
  Knot knot_;
};

}  // namespace

Knot resolve_ties(const FaceBorder& border, const SiteRays& rays, const std::vector<SiteRay>& generators) {
  return KnotMaker(border, rays, generators).make();
}

void sort_around(std::vector<SiteRay>& g) {
  const Xyz first = -g.front().T, n = g.front().T.cross(g.front().N);
  const auto angle = [&](const SiteRay& ray) { return turn_between(first, -ray.T, n); };
  std::stable_sort(g.begin() + 1, g.end(), [&](const auto& a, const auto& b) { return angle(a) < angle(b); });
}

}  // namespace geovor
