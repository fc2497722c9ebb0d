#include "voronoi/tie_tree.h"

#include <Eigen/Dense>

#include "voronoi/bisector.h"

namespace geovor {
namespace {

// The point nearest to the origin on the line through p. Where more than three generators meet, each bisector misses
// their common point by a tie: branches that leave it diverge only if they start there, and so they are taken to pass
// through their nodes.
Eigen::Vector2d foot(const Eigen::Vector2d& p, const Eigen::Vector2d& tangent) { return p - tangent.dot(p) * tangent; }

}  // namespace

TieTree::TieTree(const std::vector<SiteRay>& generators, double tie) : tie_(tie) {
  const SiteRay& first = generators.front();
  for (const SiteRay& g : generators) {
    s_.push_back(g.polar.s);
    T_.emplace_back(g.T.dot(first.T), g.T.dot(first.N));
  }
  grow(0, static_cast<int>(generators.size()) - 1, -1);
}

// The edge of generators i and j, and all beyond it, on the side of those in between: what of the polygon of the points
// -T_k lies behind the diagonal (i, j).
void TieTree::grow(int i, int j, int parent) {
  const Eigen::Vector2d across = T_[i] - T_[j];
  Branch branch{i, j, parent, -1, (s_[j] - s_[i]) / across.squaredNorm() * across, {across[1], -across[0]}};
  branch.tangent.normalize();
  const std::size_t self = branches_.size();
  branches_.push_back(branch);
  if (j - i < 2) {
    if (parent >= 0) branches_[self].base = foot(nodes_[parent].p, branch.tangent);
    return;
  }
  const std::vector<int> corners = next_polygon(branch);
  const int node = static_cast<int>(nodes_.size());
  branches_[self].to = node;
  nodes_.push_back({meeting_point(corners), corners});
  branches_[self].base = foot(nodes_[parent >= 0 ? parent : node].p, branch.tangent);
  for (std::size_t k = 0; k + 1 < corners.size(); ++k) grow(corners[k], corners[k + 1], node);
}

// The generators in between lie ahead on the branch: the first one that it meets, and all that tie with it.
std::vector<int> TieTree::next_polygon(const Branch& b) const {
  double first = 0.0;
  for (int k = b.right + 1; k < b.left; ++k) {
    const double a = (distance(k, b.base) - distance(b.right, b.base)) / (T_[b.right] - T_[k]).dot(b.tangent);
    if (k == b.right + 1 || a < first) first = a;
  }
  const Eigen::Vector2d meeting = b.base + first * b.tangent;
  const double reach = distance(b.right, meeting) + tie_;
  std::vector<int> corners = {b.right};
  for (int k = b.right + 1; k < b.left; ++k) {
    if (distance(k, meeting) <= reach) corners.push_back(k);
  }
  corners.push_back(b.left);
  return corners;
}

// d_k + <T_k, p> = radius for all corners, in the sense of least squares: more than three are balanced.
Eigen::Vector2d TieTree::meeting_point(const std::vector<int>& corners) const {
  Eigen::MatrixX3d A(corners.size(), 3);
  Eigen::VectorXd b(corners.size());
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    A.row(row) << T_[corners[k]].transpose(), -1.0;
    b[row] = s_[corners.front()] - s_[corners[k]];
  }
  return A.colPivHouseholderQr().solve(b).head<2>();
}

}  // namespace geovor
