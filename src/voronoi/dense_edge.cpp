#include "voronoi/dense_edge.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "surface/forms.h"
#include "surface/pole_chart.h"
#include "voronoi/edge_piece.h"

namespace geovor {
namespace {

// Nodes of an interpolant, two conditions each.
constexpr int kMostNodes = 8;
constexpr int kMostTerms = 2 * kMostNodes;

// Over a window of nodes the edge is a graph over the chord: it may turn away from it by 60 degrees.
constexpr double kLeastAdvance = 0.5;

// With each node the polynomial changes by a falling amount; what the last one leaves is guessed from the last two
// changes, times this.
constexpr double kMargin = 300.0;

// An error of an angle counts by this part of the arc that it makes.
constexpr double kAngleShare = 0.03;

// A piece is halved at most so often, and gets no more points than this between two nodes.
constexpr int kMostHalvings = 12;
constexpr int kMostBetween = 1024;

// A point between two nodes lies no farther from them than this times their distance.
constexpr double kFar = 1.5;

// Nearer to a pole than this part of the radius, the parameters tell no direction.
constexpr double kAtPole = 1e-6;

/// u, v and the point in the normal coordinates (r cos t, r sin t) of both sites. Radius and angles themselves have a
/// singularity near by, as sqrt(c^2 + x^2) has at x = ic.
using Values = Eigen::Matrix<double, 6, 1>;

Eigen::Vector2d normal_coordinates(double r, double t) { return {r * std::cos(t), r * std::sin(t)}; }

Eigen::Vector2d normal_slope(double r, double t, double dr, double dt) {
  return {dr * std::cos(t) - r * dt * std::sin(t), dr * std::sin(t) + r * dt * std::cos(t)};
}

/// Radius and angle with their slopes; the angle next to `near`.
struct PolarSlope {
  double r, t, dr, dt;
  PolarSlope(const Eigen::Vector2d& x, const Eigen::Vector2d& d, double near)
      : r(x.norm()),
        t(near + wrap_angle(std::atan2(x[1], x[0]) - near)),
        dr(x.dot(d) / r),
        dt((x[0] * d[1] - x[1] * d[0]) / (r * r)) {}
};

struct Node {
  BisectorPoint m;
  Values f, slope;  ///< by arc length
  Xyz x, tangent, Su, Sv;
  double stretch = 1.0;   ///< length in space per length in the normal coordinates, at most
  bool free_end = false;  ///< of a cut locus
  bool smooth = true;     ///< false at a free end, and where the surface has no coordinates: at poles
};

// Parameters run on from the node before.
Node node_of(const SiteRays& rays, const BisectorPoint& m, const Node* before) {
  Node node;
  node.m = m;
  Uv uv = m.left.uv;
  if (before != nullptr) {
    const Uv last{before->f[0], before->f[1]};
    uv = last + nearest_copy(rays.surface(), last, uv);
  }
  const double r = m.radius(), left = m.left.polar.t, right = m.right.polar.t;
  node.f << uv.u, uv.v, normal_coordinates(r, left), normal_coordinates(r, right);
  node.x = m.position();
  node.tangent = m.tangent();
  node.stretch = std::max({1.0, std::abs(m.left.y) / r, std::abs(m.right.y) / r});
  const SurfaceJet j = rays.surface().jet(uv);
  const UvVec d = tangent_components(j, node.tangent);
  const BisectorSlope slope = bisector_slope(m);
  node.slope << d.u, d.v, normal_slope(r, left, slope.radius, slope.left_angle),
      normal_slope(r, right, slope.radius, slope.right_angle);
  node.Su = j.Su;
  node.Sv = j.Sv;
  node.free_end = m.left.y == 0.0;
  const auto at_it = [&](const auto& chart) { return (node.x - chart->pole()).norm() <= kAtPole * r; };
  const PoleCharts& poles = rays.surface().poles();
  node.smooth = !node.free_end && node.slope.allFinite() && std::none_of(poles.begin(), poles.end(), at_it);
  return node;
}

/// Newton's form of the polynomial with the values and slopes of some nodes, over their places along a chord.
class Interpolant {
 public:
  /// `advance`: how fast a node's edge goes along the chord.
  void add(double place, const Node& node, double advance) {
    append(place, node.f, node.slope / advance);
    append(place, node.f, node.slope / advance);
  }
  int nodes() const { return count_ / 2; }

  struct Result {
    Values f, slope;
  };
  Result at(double p) const {
    Result r{top_[count_ - 1], Values::Zero()};
    for (int k = count_ - 2; k >= 0; --k) {
      r.slope = r.f + (p - place_[k]) * r.slope;
      r.f = top_[k] + (p - place_[k]) * r.f;
    }
    return r;
  }
  /// What the node of this number changes at p.
  Values change_by(int node, double p) const {
    double product = 1.0;
    for (int k = 0; k < 2 * node; ++k) product *= p - place_[k];
    return product * (top_[2 * node] + (p - place_[2 * node]) * top_[2 * node + 1]);
  }

 private:
  // The lowest diagonal of the table of divided differences, from the value to the highest order, in place.
  void append(double place, const Values& f, const Values& slope) {
    Values next = f;
    for (int k = 1; k <= count_; ++k) {
      const double gap = place - place_[count_ - k];
      const Values above = std::exchange(diagonal_[k - 1], next);
      next = k == 1 && gap == 0.0 ? slope : Values((next - above) / gap);
    }
    diagonal_[count_] = top_[count_] = next;
    place_[count_++] = place;
  }

  std::array<double, kMostTerms> place_{};
  std::array<Values, kMostTerms> diagonal_{}, top_{};
  int count_ = 0;
};

class DenseEdge {
 public:
  DenseEdge(const SiteRays& rays, const std::vector<BisectorPoint>& traced, double sag) : rays_(rays), sag_(sag) {
    for (const BisectorPoint& m : traced) nodes_.push_back(node_of(rays, m, nodes_.empty() ? nullptr : &nodes_.back()));
  }

  std::vector<EdgePoint> points() {
    // A new node changes its neighbours' polynomials too.
    for (size_t before = 0; before != nodes_.size();) {
      before = nodes_.size();
      for (size_t i = 0; i + 1 < nodes_.size(); ++i) settle(i, kMostHalvings);
    }
    for (size_t i = 0; i + 1 < nodes_.size(); ++i) {
      line_.push_back(written(nodes_[i], i == 0));
      const int pieces = pieces_of(i);
      if (pieces == 1) continue;
      const Piece piece = piece_at(i);
      if (!exact_enough(piece)) continue;
      for (int k = 1; k < pieces; ++k) line_.push_back(between(piece, piece.h * k / pieces));
    }
    line_.push_back(written(nodes_.back(), false));
    return std::move(line_);
  }

 private:
  struct Piece {
    Interpolant f;
    double h = 0.0, miss = std::numeric_limits<double>::infinity();
    const Node *a = nullptr, *b = nullptr;
  };

  // Into how many pieces the chord from node i has to be cut: the sag of a circle falls as their square. The edge turns
  // by what both ends are off the chord together, also where it is an S whose ends are parallel.
  int pieces_of(size_t i) const {
    const Node &a = nodes_[i], &b = nodes_[i + 1];
    if (a.free_end || b.free_end) return 1;
    const Xyz chord = b.x - a.x;
    const auto off = [&](const Xyz& tangent) { return std::atan2(tangent.cross(chord).norm(), tangent.dot(chord)); };
    const double sag = chord.norm() * (off(a.tangent) + off(b.tangent)) / 8.0;
    return sag > sag_ ? static_cast<int>(std::min(std::ceil(std::sqrt(sag / sag_)), 1.0 * kMostBetween)) : 1;
  }

  // Across knots a surface has no power series, nor has what depends on rays that cross them; nor have parameters at a
  // pole.
  bool exact_enough(const Piece& piece) const {
    return piece.a->smooth && piece.b->smooth && rays_.surface().continuity() == Surface::kSmooth &&
           piece.miss <= kDensePoint * piece.a->m.radius();
  }

  // The ends of the piece first, then their neighbours as far as the edge goes on over them.
  Piece piece_at(size_t i) const {
    Piece piece;
    piece.a = &nodes_[i];
    piece.b = &nodes_[i + 1];
    const Xyz chord = piece.b->x - piece.a->x, way = chord.normalized();
    piece.h = chord.norm();
    double first = std::numeric_limits<double>::infinity(), last = -first;
    const auto add = [&](size_t k) {
      const Node& node = nodes_[k];
      const double place = way.dot(node.x - piece.a->x), advance = way.dot(node.tangent);
      if (piece.f.nodes() == kMostNodes || !node.smooth || !(advance > kLeastAdvance) ||
          (place >= first && place <= last))
        return;
      piece.f.add(place, node, advance);
      first = std::min(first, place);
      last = std::max(last, place);
    };
    add(i);
    add(i + 1);
    const auto more = [&](size_t k) {
      const Interpolant before = piece.f;
      const double miss = piece.miss;
      add(k);
      piece.miss = miss_of(piece);
      if (piece.miss <= miss) return;
      piece.f = before;
      piece.miss = miss;
    };
    for (size_t k = 1; k < kMostNodes && !exact_enough(piece); ++k) {
      if (i >= k) more(i - k);
      if (i + 1 + k < nodes_.size() && !exact_enough(piece)) more(i + 1 + k);
    }
    return piece;
  }

  // Distances count in full, angles by a part: those of nodes are less exact.
  double in_space(const Piece& piece, const Values& d) const {
    const auto seen = [&](int k) {
      const Eigen::Vector2d x = piece.a->f.segment<2>(k).normalized(), e = d.segment<2>(k);
      return std::abs(x.dot(e)) + kAngleShare * piece.a->stretch * std::abs(x[0] * e[1] - x[1] * e[0]);
    };
    const auto apart = [&](const Node& node) { return (d[0] * node.Su + d[1] * node.Sv).norm(); };
    return std::max(apart(*piece.a), apart(*piece.b)) + std::max(seen(2), seen(4));
  }

  // In the middle, where it is largest. Changes that fall from node to node by a factor go on to do so; and the two
  // distances, interpolated apart, have to agree.
  double miss_of(const Piece& piece) const {
    const int n = piece.f.nodes();
    if (n < 2) return std::numeric_limits<double>::infinity();
    const double middle = 0.5 * piece.h, last = in_space(piece, piece.f.change_by(n - 1, middle));
    if (n < 3) return last;
    const double before = in_space(piece, piece.f.change_by(n - 2, middle));
    const Values f = piece.f.at(middle).f;
    const double apart = std::abs(f.segment<2>(2).norm() - f.segment<2>(4).norm());
    return std::max(last * std::min(1.0, kMargin * last / before), apart);
  }

  // Halves the piece until its polynomial is exact, or no point is wanted in it.
  void settle(size_t i, int halvings) {
    if (halvings == 0 || pieces_of(i) == 1) return;
    const Piece piece = piece_at(i);
    if (exact_enough(piece)) return;
    auto m = exact(piece, std::min(piece.miss / piece.a->m.radius(), 1.0));
    if (!m && !piece.a->free_end && !piece.b->free_end) m = halfway(rays_, piece.a->m, piece.b->m);
    if (!m) return;
    const Node middle = node_of(rays_, *m, &nodes_[i]);
    nodes_.insert(nodes_.begin() + static_cast<long>(i) + 1, middle);
    settle(i + 1, halvings - 1);
    settle(i, halvings - 1);
  }

  std::optional<BisectorPoint> exact(const Piece& piece, double miss) const {
    if (piece.f.nodes() < 2) return std::nullopt;
    const EdgePoint guess = between(piece, 0.5 * piece.h);
    const Xyz way = (piece.b->x - piece.a->x) / piece.h;
    const auto m = correct_bisector(rays_, piece.a->m.left.site, piece.a->m.right.site,
                                    {guess.radius, guess.left_angle, guess.right_angle},
                                    {way, way.dot(piece.a->x) + 0.5 * piece.h}, miss);
    const bool near = m && (m->position() - piece.a->x).norm() <= kFar * piece.h &&
                      (m->position() - piece.b->x).norm() <= kFar * piece.h;
    return near ? m : std::nullopt;
  }

  EdgePoint between(const Piece& piece, double p) const {
    const auto [f, slope] = piece.f.at(p);
    const SurfaceJet j = rays_.surface().jet({f[0], f[1]});
    const double per_length = 1.0 / push_forward(j, {slope[0], slope[1]}).norm();
    const BisectorPoint& near = piece.a->m;
    const PolarSlope left(f.segment<2>(2), per_length * slope.segment<2>(2), near.left.polar.t),
        right(f.segment<2>(4), per_length * slope.segment<2>(4), near.right.polar.t);
    return {{f[0], f[1]}, j.S,     0.5 * (left.r + right.r), left.t, right.t, 0.5 * (left.dr + right.dr),
            left.dt,      right.dt};
  }

  // At the free end of a cut locus, from which it goes away from the site, the angles change as a square root does;
  // what is written of them is zero.
  EdgePoint written(const Node& node, bool first) const {
    const BisectorPoint& m = node.m;
    const BisectorSlope d = m.left.y == 0.0 ? BisectorSlope{first ? 1.0 : -1.0, 0.0, 0.0} : bisector_slope(m);
    return {{node.f[0], node.f[1]}, node.x,   m.radius(),   m.left.polar.t,
            m.right.polar.t,        d.radius, d.left_angle, d.right_angle};
  }

  const SiteRays& rays_;
  double sag_;
  std::vector<Node> nodes_;
  std::vector<EdgePoint> line_;
};

}  // namespace

std::vector<EdgePoint> dense_edge(const SiteRays& rays, const std::vector<BisectorPoint>& traced, double sag) {
  return DenseEdge(rays, traced, sag).points();
}

}  // namespace geovor
