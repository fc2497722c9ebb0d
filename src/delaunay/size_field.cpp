#include "delaunay/size_field.h"

#include <algorithm>

namespace geovor {
namespace {

// Sources in a leaf of the tree.
constexpr int kLeaf = 8;
// A size this many times as large as it should be is noted …
constexpr double kNoted = 1.02;
// … and this many times as large it is worth another filling.
constexpr double kTooCoarse = 1.2;

}  // namespace

SizeField::SizeField(const SizeRule& rule, const std::vector<MeshVertex>& border)
    : rule_(rule), border_points_(border.size()) {
  for (const MeshVertex& p : border) {
    if (p.h * kNoted < rule.size) sources_.push_back({p.x, p.h});
  }
  build();
}

double SizeField::at(const Xyz& x, double wanted) const {
  double h = wanted;
  if (!tree_.empty()) lower(0, x, h);
  return h;
}

double SizeField::bound(size_t node, const Xyz& x) const {
  const Node& n = tree_[node];
  const Xyz outside = (n.lower - x).cwiseMax(x - n.upper).cwiseMax(0.0);
  return n.least + rule_.gradation * outside.norm();
}

// The nearer child first, so that the farther one is mostly passed by.
void SizeField::lower(size_t node, const Xyz& x, double& h) const {
  if (!(bound(node, x) < h)) return;
  const Node& n = tree_[node];
  if (n.end - n.begin <= kLeaf) {
    for (int i = n.begin; i < n.end; ++i) h = std::min(h, sources_[i].h + rule_.gradation * (sources_[i].x - x).norm());
    return;
  }
  const size_t left = 2 * node + 1, right = left + 1;
  const bool left_first = bound(left, x) <= bound(right, x);
  lower(left_first ? left : right, x, h);
  lower(left_first ? right : left, x, h);
}

void SizeField::build() {
  tree_.clear();
  if (!sources_.empty()) build(0, 0, static_cast<int>(sources_.size()));
}

void SizeField::build(size_t node, int begin, int end) {
  if (tree_.size() <= node) tree_.resize(node + 1);
  Node n;
  n.begin = begin, n.end = end;
  for (int i = begin; i < end; ++i) {
    n.lower = n.lower.cwiseMin(sources_[i].x);
    n.upper = n.upper.cwiseMax(sources_[i].x);
    n.least = std::min(n.least, sources_[i].h);
  }
  tree_[node] = n;
  if (end - begin <= kLeaf) return;
  int widest = 0;
  (n.upper - n.lower).maxCoeff(&widest);
  const int middle = (begin + end) / 2;
  std::nth_element(sources_.begin() + begin, sources_.begin() + middle, sources_.begin() + end,
                   [widest](const Source& a, const Source& b) { return a.x[widest] < b.x[widest]; });
  build(2 * node + 1, begin, middle);
  build(2 * node + 2, middle, end);
}

bool SizeField::learn(const std::vector<MeshVertex>& points) {
  const size_t known = sources_.size();
  for (size_t i = border_points_; i < points.size(); ++i) {
    if (points[i].h * kNoted < rule_.size) sources_.push_back({points[i].x, points[i].h});
  }
  if (sources_.size() == known) return false;
  build();
  double worst = 1.0;
  for (size_t i = border_points_; i < points.size(); ++i)
    worst = std::max(worst, points[i].h / at(points[i].x, rule_.size));
  return worst > kTooCoarse;
}

bool SizeField::learn(const SurfaceTriangulation& mesh) {
  const HalfEdges& topo = mesh.topology();
  double worst = 1.0;
  for (int t = 0; t < topo.triangle_count(); ++t) {
    const auto middle = mesh.middle(t);
    if (!middle) continue;
    const auto [a, b, c] = topo.corners(t);
    const double h = rule_.at(middle->curvature),
                 used = std::max({mesh.vertex(a).h, mesh.vertex(b).h, mesh.vertex(c).h});
    const double excess = used / (h + rule_.gradation * mesh.circumradius(t));
    if (excess > kNoted) sources_.push_back({middle->x, h});
    worst = std::max(worst, excess);
  }
  build();
  return worst > kTooCoarse;
}

}  // namespace geovor
